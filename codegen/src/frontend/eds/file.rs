//! Reads a file section by section.

use super::keywords::{Key, KEYS};
use super::object::ObjectSections;
use super::reader::Reader;
use super::sections::{classify, Refinement, SectionKind};
use super::{header, lists, modules, sections};
use crate::collections::HashMap;
use crate::diagnostics::{codes, Diagnostics};
use crate::frontend::canopen::object::define_type;
use crate::ir::{Catalog, Device, Extensions};
use crate::limits;
use crate::source::{Encoding, FileId, Origin, Source, Span};
use crate::syntax::ini::{Document, Oddity, Section};

/// Reads the device that `source` describes. Reports repairs to `diagnostics`.
///
/// Returns `None` and reports an error if the file has no CANopen section.
pub fn read(source: &Source, file: FileId, aliases: &[String], diagnostics: &mut Diagnostics) -> Option<Catalog> {
    let doc = Document::parse(source.text(), file);
    report_encoding(source, file, diagnostics);
    let mut reader = Reader {
        doc: &doc,
        diagnostics,
        aliases,
        types: Vec::new(),
        link_spans: Vec::new(),
        orphan_sections: Vec::new(),
        announced_modules: None,
        derived_items: 0,
        copies_left: source.text().len().saturating_mul(limits::MAX_COPIES_PER_BYTE),
        copies_exceeded: false,
        comments: Extensions::new(),
        hex_flags: None,
        next_keys: [Key::ParameterName; KEYS + 1],
    };
    let sorted = Sorted::new(&mut reader);
    if sorted.is_empty() {
        let found = codes::NOT_AN_EDS.at(Span::new(file, 0, 0), "the file has no section that CiA 306 defines");
        reader.diagnostics.push(found.help(
            "check that the file has [FileInfo], [DeviceInfo], object lists, and sections of objects such as [1000]",
        ));
        // Syntax errors are reported because they may explain the missing sections.
        report_oddities(&doc, diagnostics);
        return None;
    }
    let mut device = Device { origin: Origin { span: Span::new(file, 0, 0), line: 1 }, ..Device::default() };
    for comment in doc.preamble() {
        reader.extension(comment, &mut device.extensions);
    }
    let lists = header::read(&mut reader, &sorted.header, &mut device);
    objects(&mut reader, sorted.objects, &mut device);
    let modules = modules::read(&mut reader, sorted.modules, &device);
    lists::check(&mut reader, &lists, &device);
    unknown_sections(&mut reader, &sorted.unknown, &mut device);
    reader.report_hex_flags();
    report_oddities(&doc, diagnostics);
    Some(Catalog::of_device(device, modules))
}

/// Sort rank of the sections `[xxxxName]`, `[xxxxValue]`, `[xxxxDenotation]` and `[xxxxObjectLinks]`. They are sorted
/// after the sections that describe sub-indices.
const REFINEMENT: u16 = 0x200;

/// Sections of a file, grouped by subject.
struct Sorted {
    /// Header sections, in the order of the file.
    header: Vec<(SectionKind, Section)>,
    /// Index, rank and section number of each object section, sorted by index and rank.
    objects: Vec<(u16, u16, u32)>,
    /// Module number, part and section of each module section, sorted by module number.
    modules: Vec<(u32, sections::ModulePart, Section)>,
    /// Unknown sections, in the order of the file.
    unknown: Vec<Section>,
}

impl Sorted {
    fn new(reader: &mut Reader<'_, '_>) -> Self {
        let doc = reader.doc;
        let count = doc.sections().len();
        let mut sorted =
            Sorted { header: Vec::new(), objects: Vec::with_capacity(count), modules: Vec::new(), unknown: Vec::new() };
        for (section, number) in doc.sections().iter().zip(0..) {
            let name = doc.name(section);
            let (kind, legal) = classify(name);
            if !legal {
                illegal_name(reader, section, kind);
            }
            match kind {
                SectionKind::Object(index) => sorted.objects.push((index, 0, number)),
                SectionKind::Sub(index, sub) => sorted.objects.push((index, 1 + u16::from(sub), number)),
                SectionKind::Refinement(index, _) | SectionKind::Links(index) => {
                    sorted.objects.push((index, REFINEMENT, number))
                }
                SectionKind::Module(number, part) => sorted.modules.push((number, part, *section)),
                SectionKind::Unknown => sorted.unknown.push(*section),
                _ => sorted.header.push((kind, *section)),
            }
        }
        if !sorted.objects.is_sorted() {
            sorted.objects.sort_unstable();
        }
        sorted.modules.sort_by_key(|module| module.0);
        sorted
    }

    fn is_empty(&self) -> bool {
        self.header.is_empty() && self.objects.is_empty() && self.modules.is_empty()
    }
}

/// Builds the objects of the device from the sorted sections.
fn objects(reader: &mut Reader<'_, '_>, sorted: Vec<(u16, u16, u32)>, device: &mut Device) {
    let mut sections = ObjectSections::default();
    device.groups.reserve_exact(sorted.chunk_by(|one, other| one.0 == other.0).count());
    for run in sorted.chunk_by(|one, other| one.0 == other.0) {
        let index = run[0].0;
        sections.clear();
        for &(_, rank, number) in run {
            let section = reader.doc.sections()[number as usize];
            match rank {
                0 => sections.object.push(section),
                1..REFINEMENT => sections.subs.push(((rank - 1) as u8, section)),
                _ => match classify(reader.doc.name(&section)).0 {
                    SectionKind::Refinement(_, refinement) => sections.refinements.push((refinement, section)),
                    _ => sections.links.push(section),
                },
            }
        }
        if let Some(group) = reader.object(index, &mut sections) {
            reader.types.extend(define_type(&group, &mut device.types, reader.diagnostics));
            device.groups.push(group);
        }
    }
}

fn illegal_name(reader: &mut Reader<'_, '_>, section: &Section, kind: SectionKind) {
    let fix = match kind {
        SectionKind::Object(index) => format!("{index:04X}"),
        SectionKind::Sub(index, sub) => format!("{index:04X}sub{sub:X}"),
        SectionKind::Refinement(index, Refinement::Name) => format!("{index:04X}Name"),
        SectionKind::Refinement(index, Refinement::Value) => format!("{index:04X}Value"),
        SectionKind::Refinement(index, Refinement::Denotation) => format!("{index:04X}Denotation"),
        SectionKind::Links(index) => format!("{index:04X}ObjectLinks"),
        _ => String::new(),
    };
    let name = reader.doc.name(section);
    let mut diagnostic = codes::ILLEGAL_SECTION_NAME
        .at(reader.doc.name_span(section), format!("the section name `{name}` violates the grammar of CiA 306"));
    if !fix.is_empty() {
        diagnostic = diagnostic.label(format!("read as {fix}")).fix(fix);
    }
    reader.diagnostics.push(diagnostic);
}

/// Reports sections that CiA 306 does not define. Stores their entries as extensions of the device, with keys such as
/// `section/key`. Also stores the entries of sections about undescribed objects.
fn unknown_sections(reader: &mut Reader<'_, '_>, unknown: &[Section], device: &mut Device) {
    let mut seen: HashMap<String, &Section> = HashMap::default();
    for section in unknown {
        let name = reader.doc.name(section);
        // CiA 306-1 defines the section [Tools], which lists software tools, so this section is not reported.
        if !name.eq_ignore_ascii_case("Tools") {
            let found = codes::UNKNOWN_SECTION
                .at(reader.doc.name_span(section), format!("CiA 306 does not define the section [{name}]"));
            reader.diagnostics.push(found.label("kept as extension attributes of the device"));
        }
        let first = *seen.entry(name.to_ascii_lowercase()).or_insert(section);
        if first.line != section.line {
            reader.duplicate_section(first, section, "the entries of both are kept");
        }
    }
    let orphans = std::mem::take(&mut reader.orphan_sections);
    for section in unknown.iter().chain(&orphans) {
        for entry in reader.doc.entries(section) {
            reader.foreign(section, &entry, &mut device.extensions);
        }
    }
}

fn report_encoding(source: &Source, file: FileId, diagnostics: &mut Diagnostics) {
    let (message, read_as) = match source.encoding() {
        Encoding::Utf8 | Encoding::Utf8Bom => return,
        Encoding::Utf16 => ("the file is UTF-16", "UTF-16"),
        _ if source.has_wrong_mark() => ("the file has a UTF-8 byte order mark but is not UTF-8", "Windows-1252"),
        Encoding::Windows1252 | Encoding::Declared => ("the file is neither ASCII nor UTF-8", "Windows-1252"),
    };
    let at = source.text().bytes().position(|byte| !byte.is_ascii());
    let (at, label) = match at {
        Some(at) => (at, format!("first affected character; the file is read as {read_as}")),
        None => (0, format!("read as {read_as}")),
    };
    let length = source.text()[at..].chars().next().map_or(0, char::len_utf8);
    let span = Span::new(file, at as u32, (at + length) as u32);
    let found = codes::NOT_UTF8.at(span, message).label(label);
    diagnostics.push(found.help("convert the file to ASCII; most tools also read UTF-8"));
}

fn report_oddities(doc: &Document<'_>, diagnostics: &mut Diagnostics) {
    let oddities = doc.oddities();
    let hash_lines = oddities.iter().filter(|(oddity, _)| *oddity == Oddity::HashLine).count();
    let mut hash_seen = false;
    for &(oddity, span) in &oddities {
        let (code, message, label) = match oddity {
            Oddity::Junk => {
                (&codes::JUNK_LINE, "this line is neither a section header, an entry nor a comment", "skipped")
            }
            Oddity::EntryOutsideSection => {
                (&codes::ENTRY_OUTSIDE_SECTION, "this entry is above the first section", "skipped")
            }
            Oddity::UnclosedHeader => {
                (&codes::MALFORMED_HEADER, "this section header has no `]`", "read up to the end of the line")
            }
            Oddity::TextAfterHeader => (&codes::MALFORMED_HEADER, "there is text after the section header", "skipped"),
            Oddity::IndentedHeader => {
                (&codes::INDENTED_HEADER, "this section header is indented", "read as a section header")
            }
            Oddity::LongLine => (&codes::LONG_LINE, "this line has more than 255 characters", ""),
            Oddity::HashLine if hash_seen => continue,
            Oddity::HashLine => {
                hash_seen = true;
                let (lines, label) = match hash_lines {
                    1 => ("1 line starts".to_owned(), "skipped"),
                    _ => (format!("{hash_lines} lines start"), "first of these lines; all are skipped"),
                };
                let message = format!("{lines} with `#`, which does not start a comment in CiA 306");
                let help = "start comment lines with `;`";
                diagnostics.push(codes::HASH_COMMENT.at(span, message).label(label).help(help));
                continue;
            }
        };
        diagnostics.push(code.at(span, message).label(label));
    }
}
