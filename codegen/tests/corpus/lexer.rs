//! Compares the EDS lexer with an independent one on the INI files of the corpus. The independent lexer is the crate
//! `configparser`.
//!
//! `configparser` does not implement CiA 306. If a row of the table of quirks (E20, E27, …) makes the results differ, a function
//! whose name starts with the number of the row removes the difference. The test compares the removed differences with the lexer's
//! reports.

use crate::corpus_support;

use std::collections::{BTreeMap, BTreeSet};

use configparser::ini::{Ini, IniDefault};
use corpus_support::{files, header, lane, lines, trimmed};
use lexibus_codegen::source::{FileId, Source};
use lexibus_codegen::syntax::ini::{Document, Entries, Entry, Oddity, Section};

/// Sections with their keys and values. Names are in lowercase.
type Sections = BTreeMap<String, BTreeMap<String, String>>;

/// Section name under which `configparser` stores entries that occur before the first section header.
const NO_SECTION: &str = "\u{1}no section";

/// The result of `configparser` for a text.
struct Theirs {
    sections: Sections,
    /// The lines that contain no `=`, as pairs of section and line in lowercase.
    junk: BTreeSet<(String, String)>,
    /// The keys that occur before the first section header.
    outside: BTreeSet<String>,
}

fn theirs(text: &str) -> Result<Theirs, String> {
    let mut settings = IniDefault::default();
    settings.default_section = NO_SECTION.to_owned();
    settings.comment_symbols = vec![';', '#'];
    settings.delimiters = vec!['='];
    settings.enable_inline_comments = false;
    settings.multiline = false;
    settings.case_sensitive = false;
    let parsed = Ini::new_from_defaults(settings).read(e31_line_ends(e32_ctrl_z(text)))?;
    let mut theirs = Theirs { sections: BTreeMap::new(), junk: BTreeSet::new(), outside: BTreeSet::new() };
    for (section, entries) in parsed {
        let entries = e64_junk(&section, entries, &mut theirs.junk);
        if section == NO_SECTION {
            theirs.outside.extend(entries.into_keys());
        } else {
            theirs.sections.insert(section, entries);
        }
    }
    Ok(theirs)
}

/// E31: replaces CR LF and single CR, which also end a line, with LF.
fn e31_line_ends(text: &str) -> String {
    text.replace("\r\n", "\n").replace('\r', "\n")
}

/// E32: a Ctrl-Z ends the text if only whitespace, Ctrl-Z and NUL characters follow. Returns the text before these characters.
fn e32_ctrl_z(text: &str) -> &str {
    text.trim_end_matches([' ', '\t', '\r', '\n', '\u{1a}', '\0'])
}

/// E64: moves keys to `junk`, with their section, if `configparser` reads no value for them.
fn e64_junk(
    section: &str,
    entries: impl IntoIterator<Item = (String, Option<String>)>,
    junk: &mut BTreeSet<(String, String)>,
) -> BTreeMap<String, String> {
    let mut kept = BTreeMap::new();
    for (key, value) in entries {
        match value {
            Some(value) => _ = kept.insert(key, value),
            None => _ = junk.insert((section.to_owned(), key)),
        }
    }
    kept
}

/// E20, E61: returns whether a line is a comment and not an entry. A comment starts with a comment mark; a key cannot start with
/// such a mark.
fn e20_e61_is_comment(document: &Document<'_>, entry: &Entry) -> bool {
    let comment = document.is_comment(entry);
    assert_eq!(comment, [";", "#"].contains(&document.key(entry)), "line {}", entry.line);
    comment
}

/// Returns the lexer's entries. According to E27 and E28, sections with the same name are merged, and the last value of a
/// repeated key is used.
fn ours(document: &Document<'_>) -> Sections {
    let mut sections = Sections::new();
    for section in document.sections() {
        with_predicted_keys(document, section);
        let entries = sections.entry(document.name(section).to_lowercase()).or_default();
        for entry in document.entries(section) {
            if !e20_e61_is_comment(document, &entry) {
                entries.insert(document.key(&entry).to_lowercase(), document.value(&entry).to_owned());
            }
        }
    }
    sections
}

/// Reads a section with predictions of keys, and compares the entries with those that are read without. The first prediction is
/// wrong for most entries, the second one is right.
fn with_predicted_keys(document: &Document<'_>, section: &Section) {
    let mut predicted = document.entries(section);
    for entry in document.entries(section) {
        let key = document.key(&entry).as_bytes();
        let first = predicted.next_if_key(b"ParameterName");
        assert!(first.is_none() || key == b"ParameterName", "line {}", entry.line);
        let second =
            |entries: &mut Entries<'_>| (8..=16).contains(&key.len()).then(|| entries.next_if_key(key)).flatten();
        let found = first.or_else(|| second(&mut predicted)).or_else(|| predicted.next());
        let spans = |entry: &Entry| (entry.line, document.key_span(entry), document.value_span(entry));
        assert_eq!(found.as_ref().map(spans), Some(spans(&entry)));
    }
    assert!(predicted.next().is_none());
}

/// Returns the lines that the lexer reports as `oddity`.
fn odd<'a>(document: &Document<'_>, source: &'a Source, oddity: Oddity) -> Vec<(u32, &'a str)> {
    let oddities = document.oddities();
    let of_kind = oddities.iter().filter(|(kind, _)| *kind == oddity);
    of_kind.map(|(_, span)| (source.position(span.start).line, source.slice(*span))).collect()
}

/// Returns the name of the section that contains a line, in lowercase.
fn section_at(document: &Document<'_>, line: u32) -> String {
    let above = document.sections().iter().take_while(|section| section.line < line).last();
    above.map_or(NO_SECTION.to_owned(), |section| document.name(section).to_lowercase())
}

/// Compares the results of the lexer and `configparser`. Returns the number of equal entries.
fn compare(source: &Source, other: &str) -> Result<usize, String> {
    let document = Document::parse(source.text(), FileId(0));
    let theirs = theirs(other)?;
    let ours = ours(&document);
    for (name, entries) in &ours {
        let Some(expected) = theirs.sections.get(name) else { return Err(format!("[{name}] is ours alone")) };
        if entries != expected {
            return Err(first_difference(name, entries, expected));
        }
    }
    if let Some(missing) = theirs.sections.keys().find(|name| !ours.contains_key(*name)) {
        return Err(format!("[{missing}] is theirs alone"));
    }
    let junk = odd(&document, source, Oddity::Junk);
    let junk: BTreeSet<_> =
        junk.iter().map(|(line, text)| (section_at(&document, *line), text.to_lowercase())).collect();
    if junk != theirs.junk {
        return Err(format!("junk differs: {:?}", junk.symmetric_difference(&theirs.junk).next()));
    }
    let outside = odd(&document, source, Oddity::EntryOutsideSection);
    let key = |text: &str| trimmed(text.split('=').next().unwrap_or("")).to_lowercase();
    let outside: BTreeSet<_> = outside.iter().map(|(_, text)| key(text)).collect();
    if outside != theirs.outside {
        return Err(format!("above the first section: {outside:?} and {:?}", theirs.outside));
    }
    Ok(ours.values().map(BTreeMap::len).sum())
}

fn first_difference(name: &str, ours: &BTreeMap<String, String>, theirs: &BTreeMap<String, String>) -> String {
    let keys: BTreeSet<_> = ours.keys().chain(theirs.keys()).collect();
    let differing = keys.into_iter().find(|key| ours.get(*key) != theirs.get(*key));
    let key = differing.map_or("", |key| key.as_str());
    format!("[{name}] {key}: {:?} is ours, {:?} is theirs", ours.get(key), theirs.get(key))
}

/// E27, E28: `configparser` keeps only one of several sections or keys with the same name. This function therefore passes each line
/// to it separately and compares all entries in file order.
fn e27_e28_each_line(source: &Source) -> Result<usize, String> {
    let document = Document::parse(source.text(), FileId(0));
    let mut ours = document.sections().iter().flat_map(|section| {
        let entries = document.entries(section).filter(|entry| !document.is_comment(entry));
        let line = |entry: Entry| (entry.line, document.key(&entry).to_lowercase(), document.value(&entry).to_owned());
        std::iter::once((section.line, document.name(section).to_lowercase(), String::new())).chain(entries.map(line))
    });
    let mut compared = 0;
    let mut inside = false;
    for ((_, text), number) in lines(e32_ctrl_z(source.text())).into_iter().zip(1..) {
        let is_header = header(text).is_some();
        inside |= is_header;
        let Some((key, value)) = line_alone(text).filter(|_| inside) else { continue };
        let expected = (number, key, value);
        let found = ours.next();
        if found.as_ref() != Some(&expected) {
            return Err(format!("line {number}: {found:?} is ours, {expected:?} is theirs"));
        }
        compared += usize::from(!is_header);
    }
    match ours.next() {
        Some(entry) => Err(format!("{entry:?} is ours alone")),
        None => Ok(compared),
    }
}

/// Returns what `configparser` reads from a single line: a section, as a name with an empty value, or a key with its value.
fn line_alone(line: &str) -> Option<(String, String)> {
    let theirs = theirs(&format!("[\u{1}]\n{line}")).expect("a line that it can read");
    let mut sections = theirs.sections.into_iter();
    match (sections.next(), sections.next()) {
        (Some((_, entries)), None) => entries.into_iter().next(),
        (_, Some((name, _))) => Some((name, String::new())),
        _ => None,
    }
}

#[test]
fn every_file_has_the_sections_keys_and_values_that_another_parser_sees() {
    let Some(files) = files() else { return };
    let (mut compared, mut each) = (0, 0);
    for file in files.iter().filter(|file| !file.is_xml()) {
        let source = Source::new(file.name.as_str(), file.bytes.clone());
        assert_eq!(source.text(), file.text(), "{}: decoded differently", file.name);
        compared += compare(&source, &file.text()).unwrap_or_else(|error| panic!("{}: {error}", file.name));
        each += e27_e28_each_line(&source).unwrap_or_else(|error| panic!("{}: {error}", file.name));
    }
    eprintln!("{compared} entries by name and {each} by line agree");
    assert!(compared > lane::at_least(300_000), "only {compared} entries were compared");
    assert!(each > compared, "repeated sections and keys were lost: {each}, {compared}");
}

/// Gives corpus files other line ends, a byte order mark, or white space around keys, values and headers, and compares the results
/// again.
#[test]
fn other_line_ends_marks_and_indents_change_nothing() {
    let Some(files) = files() else { return };
    for file in files.iter().filter(|file| !file.is_xml()) {
        let plain = file.text();
        let lf = e31_line_ends(&plain);
        let variants = [
            ("CR", lf.replace('\n', "\r")),
            ("CR LF and Ctrl-Z", lf.replace('\n', "\r\n") + "\r\n\u{1a}"),
            ("mixed", plain.replacen('\n', "\r", 7)),
            ("byte order mark", format!("\u{feff}{plain}")),
            ("blanks and tabs", e60_blanks(&lf)),
        ];
        for (what, text) in variants {
            let source = Source::new(file.name.as_str(), text.into_bytes());
            let outcome = compare(&source, &plain);
            assert!(outcome.is_ok(), "{} with {what}: {}", file.name, outcome.unwrap_err());
        }
    }
}

/// E60, E62: adds whitespace around keys, values and headers.
fn e60_blanks(text: &str) -> String {
    let line = |line: &str| match corpus_support::entry(line) {
        Some((key, value)) => format!("  {key} =\t{value} \n"),
        None if header(line).is_some() => format!("\t {line} \n"),
        None => format!("{line}\n"),
    };
    text.split('\n').map(line).collect()
}

#[test]
fn comment_lines_and_hash_lines_are_all_accounted_for() {
    let Some(files) = files() else { return };
    let (mut comments, mut hashes) = (0, 0);
    for file in files.iter().filter(|file| !file.is_xml()) {
        let source = Source::new(file.name.as_str(), file.bytes.clone());
        let document = Document::parse(source.text(), FileId(0));
        let text = file.text();
        let all = lines(&text);
        let marked = |mark| all.iter().zip(1u32..).filter(move |((_, line), _)| trimmed(line).starts_with(mark));
        let entries = document
            .sections()
            .iter()
            .flat_map(|section| document.entries(section))
            .chain(document.preamble().iter().copied());
        let ours: BTreeSet<(u32, &str)> = entries
            .filter(|entry| document.is_comment(entry))
            .map(|entry| (entry.line, document.value(&entry)))
            .collect();
        let behind_header = |line: &str| {
            header(line).map(|(_, rest)| trimmed(rest.trim_start_matches([';', '#']))).unwrap_or("").to_owned()
        };
        let mut expected: BTreeSet<(u32, String)> = BTreeSet::new();
        expected.extend(marked(';').map(|((_, line), number)| (number, trimmed(&trimmed(line)[1..]).to_owned())));
        expected.extend(all.iter().zip(1u32..).map(|((_, line), number)| (number, behind_header(line))));
        expected.retain(|(_, comment)| !comment.is_empty());
        let ours: BTreeSet<(u32, String)> = ours.into_iter().map(|(line, text)| (line, text.to_owned())).collect();
        let differing = expected.symmetric_difference(&ours).next();
        assert!(differing.is_none(), "{}: comment {differing:?}", file.name);
        let hash: Vec<u32> = odd(&document, &source, Oddity::HashLine).iter().map(|&(line, _)| line).collect();
        assert_eq!(hash, marked('#').map(|(_, number)| number).collect::<Vec<_>>(), "{}: lines with #", file.name);
        comments += ours.len();
        hashes += hash.len();
    }
    assert!(
        comments > lane::at_least(10_000) && hashes > lane::at_least(1_000),
        "only {comments} comments and {hashes} lines with #"
    );
}

#[test]
fn the_comparison_sees_every_kind_of_difference() {
    let source = |text: &str| Source::new("x.eds", text.as_bytes().to_vec());
    let text = "; c\nabove=1\n[A] ; c\nx=1\nx=2 ; two\njunk\n# hash\n[a]\ny=\n";
    assert_eq!(compare(&source(text), text), Ok(2));
    assert_eq!(e27_e28_each_line(&source(text)), Ok(3));
    for (from, to) in [
        ("[A]", "[AA]"),
        ("[a]", "[B]"),
        ("x=2 ; two", "x=2"),
        ("x=2 ; two", "x=3 ; two"),
        ("junk", "trash"),
        ("junk\n", ""),
        ("junk", "junk=1"),
        ("above", "over"),
        ("y=", "z="),
        ("y=\n", ""),
    ] {
        let outcome = compare(&source(text), &text.replace(from, to));
        assert!(outcome.is_err(), "{from:?} became {to:?}");
    }
}
