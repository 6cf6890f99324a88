//! Compares the compiler's results with two lists of the corpus: `oracle.json` and `MANIFEST.tsv`. `oracle.json`
//! contains the counts of a simple script, and `MANIFEST.tsv` contains the class of each file.

use std::collections::BTreeMap;

use crate::corpus_support::{files, folder, header, is_read, lane, lines, File};
use lexibus_codegen::compile::{check, Compilation, Options};
use lexibus_codegen::diagnostics::{Diagnostic, Severity};
use lexibus_codegen::source::{FileId, Source};
use lexibus_export::json;
use serde_json::Value;

/// A corpus file, its rows in both lists, and its compilation.
struct Case {
    file: File,
    class: String,
    format: String,
    objects: usize,
    subs: usize,
    compilation: Compilation,
}

impl Case {
    fn name(&self) -> &str {
        &self.file.name
    }

    fn source(&self) -> &Source {
        &self.compilation.sources[0]
    }

    fn is_canopen(&self) -> bool {
        matches!(self.format.as_str(), "EDS" | "DCF" | "XML CANopen XDD/XDC")
    }

    fn one_line(&self, diagnostic: &Diagnostic) -> String {
        self.compilation.one_line(diagnostic)
    }
}

fn cases() -> Option<Vec<Case>> {
    let files = files()?;
    let text = std::fs::read_to_string(folder()?.join("oracle.json")).expect("the oracle");
    let oracle: Value = serde_json::from_str(&text).expect("JSON");
    Some(files.into_iter().map(|file| case(file, &oracle)).collect())
}

fn case(file: File, oracle: &Value) -> Case {
    let entry = &oracle[file.name.as_str()];
    let text =
        |key: &str| entry[key].as_str().unwrap_or_else(|| panic!("{}: no {key} in the oracle", file.name)).to_owned();
    let number = |key: &str| text(key).parse().unwrap_or_else(|_| panic!("{}: {key} is no number", file.name));
    let (class, format, objects, subs) = (text("class"), text("format"), number("objects"), number("subobjects"));
    let compilation = check(Source::new(file.name.as_str(), file.bytes.clone()), &Options::default());
    Case { file, class, format, objects, subs, compilation }
}

/// Returns the number of items that are described by a separate section or element.
fn declared_subs(case: &Case) -> usize {
    let groups = case.compilation.catalog.iter().flat_map(|catalog| &catalog.devices).flat_map(|device| &device.groups);
    let origins = groups.flat_map(|group| &group.items).map(|item| item.origin.span);
    origins.filter(|&span| is_sub(case.source().slice(span))).count()
}

fn is_sub(declaration: &str) -> bool {
    declaration.to_ascii_lowercase().contains("sub")
}

/// Compares all counts with the oracle. The oracle and the compiler count these special cases in the same way: E24
/// (capitalization of `sub`), E27 (repeated sections), E33 (sub-indices without an object) and E41 (leading zeros).
/// This also applies to entries that follow from CompactSubObj (E43) or CompactPDO (E70) and have no section.
#[test]
fn objects_and_sub_indices_are_as_many_as_the_oracle_counts() {
    let Some(cases) = cases() else { return };
    let (mut objects, mut subs) = (0, 0);
    for case in cases.iter().filter(|case| case.is_canopen()) {
        let info = json::info(&case.compilation);
        let [device] = &info.devices[..] else { panic!("{}: {} devices", case.name(), info.devices.len()) };
        assert_eq!(device.objects, case.objects, "{}: objects", case.name());
        let declared = declared_subs(case);
        assert_eq!(declared, case.subs, "{}: sub-indices with a section", case.name());
        assert!(
            device.entries >= declared,
            "{}: {} entries, {declared} of them sub-indices",
            case.name(),
            device.entries
        );
        objects += device.objects;
        subs += declared;
    }
    eprintln!("{objects} objects and {subs} sub-indices are as many as the oracle counts");
    assert!(
        objects > lane::at_least(18_000) && subs > lane::at_least(54_000),
        "only {objects} objects and {subs} sub-indices"
    );
}

/// Returns whether the text has a section about commissioning (quirk E68). The script treats such a file as a DCF and
/// other files as EDS.
fn e68_commissioned(text: &str) -> bool {
    let names = lines(text).into_iter().filter_map(|(_, line)| Some(header(line)?.0.to_ascii_lowercase()));
    names.into_iter().any(|name| ["devicecomissioning", "devicecommissioning"].contains(&name.as_str()))
}

/// Compares the formats that the compiler and the script recognize. The compiler prefers the extension `.eds` or `.dcf` of
/// the file name. The results may differ only if the extension and the content differ.
#[test]
fn formats_follow_from_extension_or_content() {
    let Some(cases) = cases() else { return };
    let mut by_name = 0;
    for case in cases.iter().filter(|case| case.is_canopen()) {
        let expected = match case.format.as_str() {
            "EDS" => "eds",
            "DCF" => "dcf",
            _ => "xdd",
        };
        let format = json::info(&case.compilation).format.expect("a format");
        if format != expected {
            let by_content = if e68_commissioned(&case.file.text()) { "dcf" } else { "eds" };
            let ending = case.name().rsplit_once('.').map(|(_, ending)| ending.to_ascii_lowercase());
            assert_eq!(
                ending.as_deref(),
                Some(format),
                "{}: the format does not match the file extension",
                case.name()
            );
            assert_eq!(by_content, expected, "{}: the format does not match the content", case.name());
            by_name += 1;
        }
    }
    eprintln!("{by_name} files are EDS or DCF by their extension only");
}

#[test]
fn the_lists_agree_on_classes() {
    let Some(cases) = cases() else { return };
    let manifest = std::fs::read_to_string(folder().expect("the corpus").join("MANIFEST.tsv")).expect("the manifest");
    let classes: BTreeMap<&str, &str> = manifest
        .lines()
        .skip(1)
        .map(|line| (line.split('\t').next().unwrap_or(""), line.rsplit('\t').next().unwrap_or("")))
        .filter(|(name, _)| is_read("eds", name))
        .collect();
    for case in &cases {
        assert_eq!(classes.get(case.name()), Some(&case.class.as_str()), "{}", case.name());
    }
    assert_eq!(classes.len(), cases.len());
}

#[test]
fn no_canopen_file_is_rejected() {
    let Some(cases) = cases() else { return };
    let mut real = 0;
    for case in cases.iter().filter(|case| case.is_canopen()) {
        let errors = case.compilation.diagnostics.list().iter().filter(|found| found.severity == Severity::Error);
        let errors: Vec<String> = errors.map(|error| case.one_line(error)).collect();
        assert!(case.compilation.is_usable(), "{} ({}) is rejected: {errors:#?}", case.name(), case.class);
        real += usize::from(case.class == "real device/firmware");
    }
    assert!(real >= lane::at_least(170), "only {real} files of real devices");
}

/// Returns the code of the only error that the compiler must report for a file of this class, and a part of its message.
/// The file is not a CANopen device description.
fn rejection(case: &Case) -> (&'static str, &'static str) {
    match case.class.as_str() {
        "negative (EtherNet/IP EDS)" => ("EDS001", "this is an EtherNet/IP EDS"),
        "negative/adjacent (POWERLINK XDD)" => ("XDD002", "POWERLINK"),
        "negative (Xilinx constraints .xdc)" => ("IO002", "this is not a device description"),
        "bad/edge" if case.file.bytes.is_empty() => ("IO002", "the file is empty"),
        "bad/edge (git symlink target text)" | "bad/edge" => ("EDS002", "the file has no section"),
        other => panic!("{}: unknown class {other:?}", case.name()),
    }
}

#[test]
fn other_files_are_rejected_with_one_error_that_names_their_format() {
    let Some(cases) = cases() else { return };
    let mut rejected: BTreeMap<&str, usize> = BTreeMap::new();
    for case in cases.iter().filter(|case| !case.is_canopen()) {
        let (code, message) = rejection(case);
        let list = case.compilation.diagnostics.list();
        let errors: Vec<&Diagnostic> = list.iter().filter(|found| found.severity == Severity::Error).collect();
        let [error] = errors[..] else { panic!("{}: {} errors, not 1", case.name(), errors.len()) };
        assert_eq!(error.code.id, code, "{}: {}", case.name(), error.message);
        assert!(error.message.contains(message), "{}", case.one_line(error));
        assert!(!case.compilation.is_usable() && case.compilation.catalog.is_none(), "{}", case.name());
        *rejected.entry(code).or_default() += 1;
    }
    let expected = BTreeMap::from([("EDS001", 8), ("EDS002", 3), ("IO002", 2), ("XDD002", 1)]);
    if lane::is_full() {
        assert_eq!(rejected, expected, "files rejected, by code");
    }
    assert!(rejected.keys().eq(expected.keys()), "the sample has a file for each code: {rejected:?}");
}

/// Checks the diagnostics about the text template that is part of the corpus. Most lines of the template look like an EDS;
/// each template directive must have a diagnostic.
#[test]
fn lines_of_a_template_are_reported_one_by_one() {
    let Some(cases) = cases() else { return };
    let mut templates = 0;
    for case in cases.iter().filter(|case| case.class == "negative (empy template)") {
        templates += 1;
        let found = |line| {
            case.compilation
                .diagnostics
                .list()
                .iter()
                .any(|found| found.code.id == "EDS003" && case.source().position(found.span.start).line == line)
        };
        let text = case.file.text();
        for ((_, line), number) in lines(&text).into_iter().zip(1..) {
            if line.starts_with('@') && !line.contains('=') {
                assert!(found(number), "{}:{number}: no diagnostic about {line:?}", case.name());
            }
        }
    }
    assert_eq!(templates, 1);
}

/// Codes of diagnostics about missing parts. These diagnostics name a file but no position.
const ABOUT_THE_WHOLE_FILE: [&str; 4] = ["IO002", "EDS002", "EDS063", "EDS069"];

#[test]
fn every_diagnostic_has_a_valid_position() {
    let Some(cases) = cases() else { return };
    let mut diagnostics = 0;
    for case in &cases {
        let text = case.file.text();
        let lines = lines(&text);
        for found in case.compilation.diagnostics.list() {
            check_position(case, found, &text, &lines);
            diagnostics += 1;
        }
    }
    eprintln!("{diagnostics} diagnostics have a position");
    assert!(diagnostics > lane::at_least(5_000), "only {diagnostics} diagnostics");
}

fn check_position(case: &Case, found: &Diagnostic, text: &str, lines: &[(usize, &str)]) {
    let report = case.one_line(found);
    assert_eq!(found.span.file, FileId(0), "{report}");
    for span in std::iter::once(found.span).chain(found.notes.iter().filter_map(|note| note.span)) {
        assert!(text.get(span.range()).is_some(), "{report}: {span:?} is outside the file");
    }
    if found.span.is_empty() {
        assert!(ABOUT_THE_WHOLE_FILE.contains(&found.code.id), "{report}: it has no position");
        assert!(report.starts_with(&format!("{}: ", case.name())), "{report}");
        return;
    }
    let start = found.span.start as usize;
    let line = lines.partition_point(|&(from, _)| from <= start);
    let (from, text_of_line) = lines[line - 1];
    assert!(start - from < text_of_line.len(), "{report}: the position is after the end of line {line}");
    let column = text[from..start].chars().count() + 1;
    assert!(report.starts_with(&format!("{}:{line}:{column}: ", case.name())), "{report}: not at {line}:{column}");
}
