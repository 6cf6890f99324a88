//! Which format a file has: by its content, but that EDS and DCF, which share every section, go by the name.

use crate::diagnostics::{codes, Diagnostic};
use crate::ir::Format;
use crate::source::{FileId, Source, Span};
use crate::syntax::ini::Document;

/// How much of a file is looked at to find its root element or first sections.
pub const LOOK_AHEAD: usize = 64 * 1024;

/// The format of `source`, or an error that says what it is instead.
///
/// # Errors
///
/// One diagnostic: an EtherNet/IP EDS, an XML of another kind, or nothing that Lexibus knows.
pub fn format(source: &Source, file: FileId) -> Result<Format, Box<Diagnostic>> {
    let text = source.text();
    let start = text.trim_start();
    let at = (text.len() - start.len()) as u32;
    let whole = Span::new(file, at, at);
    if start.is_empty() {
        return Err(Box::new(unknown(whole, "the file is empty")));
    }
    if is_table(source.name(), start) {
        return Ok(Format::Table);
    }
    if start.starts_with('<') {
        return xml(start, whole);
    }
    ini(source, file)
}

/// Whether a file is a register table: by its name, or by its first key.
fn is_table(name: &str, start: &str) -> bool {
    let by_name = name.rsplit_once('.').is_some_and(|(_, extension)| extension.eq_ignore_ascii_case("toml"));
    let mut lines = start.lines().map(str::trim).filter(|line| !line.is_empty() && !line.starts_with('#'));
    let first = lines.next().unwrap_or_default();
    by_name || first.strip_prefix("lexibus").is_some_and(|rest| rest.trim_start().starts_with('='))
}

/// The error for a format whose front end was left out of the build.
#[cfg(not(all(feature = "eds", feature = "xdd", feature = "esi", feature = "gsdml")))]
pub fn without_feature(format: Format, file: FileId) -> Diagnostic {
    let feature = match format {
        Format::Dcf => "eds",
        _ => format.name(),
    };
    let message = format!("`lexibus-codegen` was built without the feature `{feature}`, which reads this format");
    let help = format!("add it to the dependency: `lexibus-codegen = {{ …, features = [\"{feature}\"] }}`");
    Diagnostic::new(&codes::UNKNOWN_FORMAT, Span::new(file, 0, 0), message).help(help)
}

fn unknown(span: Span, message: &str) -> Diagnostic {
    Diagnostic::new(&codes::UNKNOWN_FORMAT, span, message)
        .help("Lexibus reads EDS and DCF files (CiA 306), XDD and XDC files (CiA 311), ESI (ETG.2000) and GSDML files")
}

fn xml(text: &str, span: Span) -> Result<Format, Box<Diagnostic>> {
    let Some(root) = root_element(text) else {
        return Err(Box::new(Diagnostic::new(&codes::MALFORMED_XML, span, "the file has no root element")));
    };
    let (root, offset) = root;
    let start = span.start + offset as u32;
    let at = Span::new(span.file, start, start + root.len() as u32);
    match root.rsplit(':').next().unwrap_or(root) {
        "ISO15745Profile" if is_gsdml(text) => Ok(Format::Gsdml),
        "ISO15745ProfileContainer" | "ISO15745Profile" => Ok(Format::Xdd),
        "EtherCATInfo" | "EtherCATInfoList" | "EtherCATModule" | "EtherCATDict" | "EtherCATDiag" => Ok(Format::Esi),
        "EtherCATConfig" => {
            let message = "this is the configuration of an EtherCAT network (ENI), not the description of a device";
            Err(Box::new(unknown(at, message).label("made by a master's tool from ESI files")))
        }
        name if name.starts_with("EtherCAT") || name == "SscToolConfiguration" => {
            let message = format!("this is no EtherCAT slave information: the root is <{name}>");
            Err(Box::new(unknown(at, &message).label("expected EtherCATInfo or EtherCATInfoList")))
        }
        other => Err(Box::new(unknown(at, &format!("<{other}> is the root of no device description")).label("here"))),
    }
}

/// Whether an ISO 15745 profile is that of a PROFINET device: a CANopen XDD has the same root element.
fn is_gsdml(text: &str) -> bool {
    let head = head(text);
    ["/GSDML/", "GSDML-DeviceProfile", "<DeviceAccessPointList"].iter().any(|mark| head.contains(mark))
}

/// The start of a text.
fn head(text: &str) -> &str {
    let end = (0..=LOOK_AHEAD.min(text.len())).rev().find(|&end| text.is_char_boundary(end)).unwrap_or(0);
    &text[..end]
}

/// Name of the first element, and where it stands.
fn root_element(text: &str) -> Option<(&str, usize)> {
    let mut at = 0;
    let head = head(text);
    while let Some(open) = head[at..].find('<') {
        let start = at + open + 1;
        let rest = &head[start..];
        let skip = if rest.starts_with("!--") {
            rest.find("-->")? + 3
        } else if rest.starts_with(['?', '!']) {
            rest.find('>')? + 1
        } else {
            let length = rest.find(|c: char| c.is_whitespace() || matches!(c, '>' | '/')).unwrap_or(rest.len());
            return (length > 0).then(|| (&rest[..length], start));
        };
        at = start + skip;
    }
    None
}

/// Sections of ODVA's EDS files, none of which CiA 306 has.
const CIP_SECTIONS: [&str; 9] = [
    "File",
    "Device",
    "Device Classification",
    "Params",
    "Assembly",
    "Connection Manager",
    "Port",
    "IO_Info",
    "ParamClass",
];

fn ini(source: &Source, file: FileId) -> Result<Format, Box<Diagnostic>> {
    let extension = source.name().rsplit_once('.').map(|(_, extension)| extension.to_ascii_lowercase());
    let by_name = match extension.as_deref() {
        Some("eds") => Some(Format::Eds),
        Some("dcf") => Some(Format::Dcf),
        _ => None,
    };
    // Nearly every file says in its first line what it is.
    if let Some(format) = by_name.filter(|_| starts_as_canopen(source.text())) {
        return Ok(format);
    }
    let doc = Document::parse(source.text(), file);
    let mut dcf = false;
    let mut canopen = false;
    let mut cip = None;
    for section in doc.sections() {
        let name = doc.name(section);
        canopen |= is_canopen_section(name);
        if cip.is_none() && CIP_SECTIONS.iter().any(|known| known.eq_ignore_ascii_case(name)) {
            cip = Some(doc.name_span(section));
        }
        dcf |= ["DeviceComissioning", "DeviceCommissioning", "ConnectedModules"]
            .iter()
            .any(|known| known.eq_ignore_ascii_case(name));
        dcf |= name.eq_ignore_ascii_case("FileInfo")
            && doc.entries(section).any(|entry| doc.key(&entry).eq_ignore_ascii_case("LastEDS"));
    }
    if let (Some(span), false) = (cip, canopen) {
        return Err(Box::new(
            Diagnostic::new(&codes::ETHERNET_IP_EDS, span, "this is an EtherNet/IP EDS, not a CANopen one")
                .label("a section of ODVA's format")
                .help("both kinds of file share the ending .eds and nothing else; ask the vendor for the CANopen EDS"),
        ));
    }
    if !canopen && by_name.is_none() {
        return Err(Box::new(unknown(Span::new(file, 0, 0), "this is no device description")));
    }
    Ok(by_name.unwrap_or(if dcf { Format::Dcf } else { Format::Eds }))
}

/// Whether the first section is one that only CANopen has.
fn starts_as_canopen(text: &str) -> bool {
    let mut lines = text.split(['\n', '\r']).take(200).map(str::trim_start);
    let header = lines.find_map(|line| line.strip_prefix('['));
    header.and_then(|header| header.split(']').next()).is_some_and(|name| is_canopen_section(name.trim()))
}

fn is_canopen_section(name: &str) -> bool {
    let known = ["DeviceInfo", "FileInfo", "MandatoryObjects", "OptionalObjects", "ManufacturerObjects", "DummyUsage"];
    known.iter().any(|known| known.eq_ignore_ascii_case(name))
        || (name.len() == 4 && name.bytes().all(|byte| byte.is_ascii_hexdigit()))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn detect(name: &str, text: &str) -> Result<Format, &'static str> {
        let source = Source::new(name, text.as_bytes().to_vec());
        format(&source, FileId(0)).map_err(|diagnostic| diagnostic.code.id)
    }

    #[test]
    fn content_decides_before_the_name() {
        assert_eq!(detect("a.eds", "[DeviceInfo]\n"), Ok(Format::Eds));
        assert_eq!(detect("a.txt", "[1000]\nObjectType=7"), Ok(Format::Eds));
        assert_eq!(detect("a.txt", "[FileInfo]\nLastEDS=x\n"), Ok(Format::Dcf));
        assert_eq!(detect("a.eds", "$ EZ-EDS\n[File]\nDescText=\"x\";\n[Device]\nVendCode=1;"), Err("EDS001"));
        assert_eq!(
            detect("a.eds", " <?xml version=\"1.0\"?><!-- <x> --><c:ISO15745ProfileContainer a=''>"),
            Ok(Format::Xdd)
        );
        for name in ["a.eds", "a.xdd", "GSDML-V2.35-A-B-20200131.xml", "a.toml"] {
            assert_eq!(detect(name, ""), Err("IO002"), "{name} without a byte");
        }
        assert_eq!(detect("a.xdc", "set_max_delay -from [get_pins x]"), Err("IO002"));
        assert_eq!(detect("a.xml", "<html>"), Err("IO002"));
        assert_eq!(detect("a.xml", "<e:EtherCATInfo>"), Ok(Format::Esi));
        assert_eq!(detect("a.xml", "<EtherCATTest>"), Err("IO002"));
        let gsdml = "<ISO15745Profile xmlns='http://www.profibus.com/GSDML/2003/11/DeviceProfile'>";
        assert_eq!(detect("a.xml", gsdml), Ok(Format::Gsdml));
        assert_eq!(detect("a.xml", "<ISO15745Profile>"), Ok(Format::Xdd));
        assert_eq!(detect("a.xml", "<!-- "), Err("XML001"));
    }
}
