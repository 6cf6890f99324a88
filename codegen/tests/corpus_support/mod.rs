//! The corpus of real device descriptions. The full lane compiles all files. The fast lane compiles the files that
//! `tests/corpus-sample.txt` lists.
//!
//! The corpus is not part of the repository. If the corpus is missing, the tests print a message and pass. The readers in this file
//! and in the modules `number` and `reading` use only the standard library. The code under test therefore cannot affect the
//! expected values.

// Each test is a separate program that uses only a part of this module.
#![allow(dead_code)]

pub mod bindings;
pub mod fixes;
#[path = "../../../tests/support/lane.rs"]
pub mod lane;
pub mod number;
#[path = "../../../tests/support/python.rs"]
pub mod python;
pub mod reading;
#[allow(clippy::duplicate_mod, reason = "a program may load several modules that look for the repository")]
#[path = "../../../tests/support/root.rs"]
pub mod root;
pub mod round_trip;
pub mod xsd;

use std::collections::HashSet;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

/// A file of the corpus.
pub struct File {
    pub name: String,
    pub bytes: Vec<u8>,
}

impl File {
    /// Returns the decoded text of the file: UTF-8 without its byte order mark, or Windows-1252 if it is not UTF-8.
    pub fn text(&self) -> String {
        decode(&self.bytes)
    }

    /// Returns whether the file is XML, such as an XDD, ESI or GSDML, and not an INI file.
    pub fn is_xml(&self) -> bool {
        self.text().trim_start().starts_with('<')
    }
}

/// Returns the folder of the corpus with CANopen files, if it exists.
pub fn folder() -> Option<PathBuf> {
    folder_of("eds")
}

/// Returns the folder of the corpus with files of the format `eds`, `esi` or `gsdml`.
pub fn folder_of(format: &str) -> Option<PathBuf> {
    let folder = root::root().join("../shared/corpus").join(format);
    if folder.is_dir() {
        return Some(folder);
    }
    eprintln!("skipped: there is no corpus at {}", folder.display());
    None
}

/// Returns the CANopen descriptions of the current lane, sorted by name. If there is no corpus, prints a message and returns
/// `None`.
pub fn files() -> Option<Vec<File>> {
    let files = files_of("eds")?;
    assert!(files.len() >= lane::at_least(285), "only {} files are in the corpus", files.len());
    Some(files)
}

/// Returns the descriptions of the current lane in all formats, or `None` if there is no corpus.
pub fn all_files() -> Option<Vec<File>> {
    let lists: Option<Vec<Vec<File>>> = ["eds", "esi", "gsdml"].into_iter().map(files_of).collect();
    let files: Vec<File> = lists?.into_iter().flatten().collect();
    assert!(files.len() >= lane::at_least(500), "only {} files are in the corpus", files.len());
    Some(files)
}

/// Returns whether the current lane uses a file. The full lane uses all files, and the fast lane uses a sample.
pub fn is_read(format: &str, name: &str) -> bool {
    static SAMPLE: OnceLock<HashSet<String>> = OnceLock::new();
    let sample = SAMPLE.get_or_init(|| {
        let list = include_str!("../../../tests/corpus-sample.txt").lines();
        list.filter(|line| !line.starts_with('#')).map(str::to_owned).collect()
    });
    lane::is_full() || sample.contains(&format!("{format}/{name}"))
}

/// Returns the descriptions of the current lane in one format, or `None` if there is no corpus.
pub fn files_of(format: &str) -> Option<Vec<File>> {
    let files = whole(format)?;
    Some(files.into_iter().filter(|file| is_read(format, &file.name)).collect())
}

/// Returns all descriptions in one format, independent of the lane, or `None` if there is no corpus. Tests that select files
/// themselves use this function.
pub fn whole(format: &str) -> Option<Vec<File>> {
    let mut paths: Vec<PathBuf> = std::fs::read_dir(folder_of(format)?)
        .expect("the corpus is readable")
        .map(|entry| entry.expect("an entry of the corpus").path())
        .collect();
    paths.sort();
    let files: Vec<File> = paths
        .iter()
        .filter(|path| !path.ends_with("MANIFEST.tsv") && !path.ends_with("oracle.json"))
        .map(|path| File { name: name(path), bytes: std::fs::read(path).expect("a file of the corpus") })
        .collect();
    Some(files)
}

fn name(path: &Path) -> String {
    path.file_name().expect("a file name").to_string_lossy().into_owned()
}

/// Decodes UTF-8 without its byte order mark. If the bytes are not UTF-8, decodes Windows-1252.
pub fn decode(bytes: &[u8]) -> String {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    match std::str::from_utf8(bytes) {
        Ok(text) => text.to_owned(),
        Err(_) => bytes.iter().map(|&byte| windows_1252(byte)).collect(),
    }
}

/// Characters of Windows-1252 for the bytes 0x80 to 0x9F. The five unassigned bytes become control characters with the same
/// number.
const WINDOWS_1252: [u16; 32] = [
    0x20AC, 0x81, 0x201A, 0x0192, 0x201E, 0x2026, 0x2020, 0x2021, 0x02C6, 0x2030, 0x0160, 0x2039, 0x0152, 0x8D, 0x017D,
    0x8F, 0x90, 0x2018, 0x2019, 0x201C, 0x201D, 0x2022, 0x2013, 0x2014, 0x02DC, 0x2122, 0x0161, 0x203A, 0x0153, 0x9D,
    0x017E, 0x0178,
];

fn windows_1252(byte: u8) -> char {
    match byte {
        0x80..=0x9F => char::from_u32(u32::from(WINDOWS_1252[usize::from(byte - 0x80)])).expect("a character"),
        _ => char::from(byte),
    }
}

/// Returns the lines of a text, each with the offset of its first byte. A line ends with CR LF, LF or a single CR.
pub fn lines(text: &str) -> Vec<(usize, &str)> {
    let mut lines = Vec::new();
    let mut start = 0;
    for (at, end) in text.match_indices(['\r', '\n']) {
        if at < start {
            continue;
        }
        lines.push((start, &text[start..at]));
        let crlf = end == "\r" && text[at + 1..].starts_with('\n');
        start = at + 1 + usize::from(crlf);
    }
    lines.push((start, &text[start..]));
    lines
}

/// Removes surrounding spaces and tabs.
pub fn trimmed(text: &str) -> &str {
    text.trim_matches([' ', '\t'])
}

/// Parses a section header `[name] …`. Returns the name and the text after `]`. The bracket `]` may be missing. Returns `None` for
/// other lines.
pub fn header(line: &str) -> Option<(&str, &str)> {
    let rest = trimmed(line).strip_prefix('[')?;
    let (name, rest) = rest.split_once(']').unwrap_or((rest, ""));
    Some((trimmed(name), trimmed(rest)))
}

/// Parses an entry `Key=Value`. Returns `None` for comments, headers and lines without `=`.
pub fn entry(line: &str) -> Option<(&str, &str)> {
    let line = trimmed(line);
    if line.starts_with(['[', ';', '#']) {
        return None;
    }
    let (key, value) = line.split_once('=')?;
    Some((trimmed(key), trimmed(value)))
}
