//! Detects the format of a file by its content. EDS and DCF files have almost the same sections, so the extension of
//! the file name distinguishes them. If the extension is neither `.eds` nor `.dcf`, the file is a DCF if it has a
//! section or key that only a DCF has.

use crate::diagnostics::{codes, Diagnostic};
use crate::ir::Format;
use crate::source::{FileId, Source, Span};
use crate::syntax::ini::{Document, Section};

/// Number of bytes at the start of an XML file in which the compiler searches for the root element and its profile.
pub const LOOK_AHEAD: usize = 64 * 1024;

/// Returns the format if the file name or the first key shows that the source is a register table.
pub(super) fn table(source: &Source) -> Option<Format> {
    let start = source.text().trim_start();
    let by_name = source.name().rsplit_once('.').is_some_and(|(_, extension)| extension.eq_ignore_ascii_case("toml"));
    let mut lines = start.lines().map(str::trim).filter(|line| !line.is_empty() && !line.starts_with('#'));
    let first = lines.next().unwrap_or_default();
    let is_table = by_name || first.strip_prefix("lexibus").is_some_and(|rest| rest.trim_start().starts_with('='));
    (is_table && !start.is_empty()).then_some(Format::Table)
}

/// Returns the format if the source is a GSDML file.
pub(super) fn gsdml(source: &Source) -> Option<Format> {
    (root_name(source)? == "ISO15745Profile" && is_gsdml(source.text())).then_some(Format::Gsdml)
}

/// Returns the format if the source is an XDD or XDC file.
pub(super) fn xdd(source: &Source) -> Option<Format> {
    matches!(root_name(source)?, "ISO15745ProfileContainer" | "ISO15745Profile").then_some(Format::Xdd)
}

/// Returns the format if the source is an ESI file. The file may contain only modules, a dictionary or diagnosis messages.
pub(super) fn esi(source: &Source) -> Option<Format> {
    let roots = ["EtherCATInfo", "EtherCATInfoList", "EtherCATModule", "EtherCATDict", "EtherCATDiag"];
    roots.contains(&root_name(source)?).then_some(Format::Esi)
}

/// Returns the format if the source is an EDS or DCF file for CANopen.
pub(super) fn eds(source: &Source) -> Option<Format> {
    if is_xml(source) {
        return None;
    }
    let extension = source.name().rsplit_once('.').map(|(_, extension)| extension.to_ascii_lowercase());
    let by_name = match extension.as_deref() {
        Some("eds") => Some(Format::Eds),
        Some("dcf") => Some(Format::Dcf),
        _ => None,
    };
    // The first section usually identifies a CANopen file, so the rest of the file need not be parsed.
    if by_name.is_some() && starts_as_canopen(source.text()) {
        return by_name;
    }
    let document = Document::parse(source.text(), FileId(0));
    let is_canopen = document.sections().iter().any(|section| is_canopen_section(document.name(section)));
    if !is_canopen && (by_name.is_none() || cip_section(&document).is_some() || source.text().trim_start().is_empty()) {
        return None;
    }
    let is_configuration = |section: &Section| {
        let name = document.name(section);
        ["DeviceComissioning", "DeviceCommissioning", "ConnectedModules"]
            .iter()
            .any(|known| known.eq_ignore_ascii_case(name))
            || (name.eq_ignore_ascii_case("FileInfo")
                && document.entries(section).any(|entry| document.key(&entry).eq_ignore_ascii_case("LastEDS")))
    };
    by_name.or_else(|| Some(if document.sections().iter().any(is_configuration) { Format::Dcf } else { Format::Eds }))
}

/// Returns the error for a file that no front end recognizes. The message names the format of the file if this format
/// is known but not supported.
pub(super) fn unknown(source: &Source, file: FileId) -> Diagnostic {
    let text = source.text();
    let start = text.trim_start();
    let at = (text.len() - start.len()) as u32;
    if start.is_empty() {
        return unknown_format(Span::new(file, at, at), "the file is empty");
    }
    if start.starts_with('<') {
        return unknown_xml(start, Span::new(file, at, at));
    }
    match cip_section(&Document::parse(text, file)) {
        Some(span) => codes::ETHERNET_IP_EDS
            .at(span, "this is an EtherNet/IP EDS, not a CANopen EDS")
            .label("this section belongs to the EDS format of ODVA")
            .help("ask the vendor for the CANopen EDS; the two formats share only the extension .eds"),
        None => unknown_format(Span::new(file, 0, 0), "this is not a device description"),
    }
}

fn unknown_format(span: Span, message: &str) -> Diagnostic {
    codes::UNKNOWN_FORMAT.at(span, message).help(
        "use an EDS or DCF (CiA 306), an XDD or XDC (CiA 311), an ESI (ETG.2000), a GSDML file, or a register table \
             that begins with `lexibus = 1`",
    )
}

fn unknown_xml(text: &str, span: Span) -> Diagnostic {
    let Some((root, offset)) = root_element(text) else {
        return codes::MALFORMED_XML.at(span, "the file has no root element");
    };
    let start = span.start + offset as u32;
    let at = Span::new(span.file, start, start + root.len() as u32);
    match local_name(root) {
        "EtherCATConfig" => {
            let message = "this is an EtherCAT network configuration (ENI), not a device description";
            unknown_format(at, message).label("configuration tools generate this file from ESI files")
        }
        name if name.starts_with("EtherCAT") || name == "SscToolConfiguration" => {
            let message = format!("this is not an ESI file: the root element is <{name}>");
            unknown_format(at, &message).label("expected <EtherCATInfo> or <EtherCATInfoList>")
        }
        other => unknown_format(at, &format!("<{other}> is not the root element of a device description"))
            .label("unknown root element"),
    }
}

fn is_xml(source: &Source) -> bool {
    source.text().trim_start().starts_with('<')
}

/// Returns the name of the root element without its prefix.
fn root_name(source: &Source) -> Option<&str> {
    let start = source.text().trim_start();
    start.starts_with('<').then(|| root_element(start))?.map(|(name, _)| local_name(name))
}

fn local_name(name: &str) -> &str {
    name.rsplit(':').next().unwrap_or(name)
}

/// Returns whether an ISO 15745 profile describes a PROFINET device. The root element does not show this, because
/// CANopen XDD files have the same root element as GSDML files.
fn is_gsdml(text: &str) -> bool {
    let head = head(text);
    ["/GSDML/", "GSDML-DeviceProfile", "<DeviceAccessPointList"].iter().any(|mark| head.contains(mark))
}

/// Returns the first [`LOOK_AHEAD`] bytes of `text`.
fn head(text: &str) -> &str {
    let end = (0..=LOOK_AHEAD.min(text.len())).rev().find(|&end| text.is_char_boundary(end)).unwrap_or(0);
    &text[..end]
}

/// Returns the name and the byte offset of the first element.
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

/// Names of sections that EtherNet/IP EDS files have, and that CiA 306 does not define.
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

/// Returns the span of the first section that only EtherNet/IP EDS files have.
fn cip_section(document: &Document<'_>) -> Option<Span> {
    let mut sections = document.sections().iter();
    let is_cip = |name: &str| CIP_SECTIONS.iter().any(|known| known.eq_ignore_ascii_case(name));
    sections.find(|&section| is_cip(document.name(section))).map(|section| document.name_span(section))
}

/// Returns whether the first section exists only in CANopen files.
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
    use crate::frontend::format;
    use crate::ir::Format;
    use crate::source::{FileId, Source};

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
