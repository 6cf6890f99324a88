//! The lexer of EDS and DCF files.
//!
//! One pass, line by line, without an allocation a line: a [`Document`] holds two flat lists, sections and entries,
//! whose parts are spans into the text. What a line breaks of the grammar is noted as an [`Oddity`] and read all the
//! same. Case, numbers and meaning are the front end's.

use crate::source::{FileId, Span};

/// The lines of a file, taken apart.
#[derive(Debug)]
pub struct Document<'a> {
    text: &'a str,
    file: FileId,
    sections: Vec<Section>,
    entries: Vec<Entry>,
    oddities: Vec<(Oddity, Span)>,
}

/// A section header and the lines below it.
#[derive(Clone, Copy, Debug)]
pub struct Section {
    name: Range,
    /// Line of the header, counted from 1.
    pub line: u32,
    first_entry: u32,
    last_entry: u32,
}

/// A `Key=Value` line, or a comment line.
#[derive(Clone, Copy, Debug)]
pub struct Entry {
    key: Range,
    value: Range,
    /// Its line, counted from 1.
    pub line: u32,
}

/// Bytes `start..end` of the text; without the file, to keep the lists small.
type Range = (u32, u32);

/// What a line breaks of the grammar of CiA 306.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Oddity {
    /// A line that is no section, entry or comment.
    Junk,
    /// An entry above the first section.
    EntryOutsideSection,
    /// A header without `]`.
    UnclosedHeader,
    /// A header with something other than a comment behind it.
    TextAfterHeader,
    /// A header that doesn't start in the first column.
    IndentedHeader,
    /// A line that starts with `#`.
    HashLine,
    /// A line of over 255 characters.
    LongLine,
}

/// The greatest number of characters in a line (CiA 306).
const MAX_LINE: usize = 255;

impl<'a> Document<'a> {
    /// Takes `text` apart.
    pub fn parse(text: &'a str, file: FileId) -> Self {
        let estimate = text.len() / 24;
        let mut document = Document {
            text,
            file,
            sections: Vec::with_capacity(estimate / 6 + 4),
            entries: Vec::with_capacity(estimate + 4),
            oddities: Vec::new(),
        };
        // An editor of old ends a text with Ctrl-Z; everything from it on is no text.
        let end = text.trim_end_matches(['\u{1a}', '\0', '\r', '\n', ' ', '\t']).len();
        let bytes = &text.as_bytes()[..end];
        let (mut start, mut line) = (0, 1);
        for at in memchr::memchr2_iter(b'\n', b'\r', bytes) {
            if at < start {
                continue;
            }
            document.line(start, at, line);
            let crlf = bytes[at] == b'\r' && bytes.get(at + 1) == Some(&b'\n');
            start = at + 1 + usize::from(crlf);
            line += 1;
        }
        document.line(start, end, line);
        if let Some(section) = document.sections.last_mut() {
            section.last_entry = document.entries.len() as u32;
        }
        document
    }

    /// The comments above the first section.
    pub fn preamble(&self) -> &[Entry] {
        let end = self.sections.first().map_or(self.entries.len(), |section| section.first_entry as usize);
        &self.entries[..end]
    }

    /// All sections, in the order of the file.
    pub fn sections(&self) -> &[Section] {
        &self.sections
    }

    /// Entries and comments of a section.
    pub fn entries(&self, section: &Section) -> &[Entry] {
        &self.entries[section.first_entry as usize..section.last_entry as usize]
    }

    /// Number of entries and comments in all sections.
    pub fn entry_count(&self) -> usize {
        self.entries.len()
    }

    /// Every broken rule, in the order of the file.
    pub fn oddities(&self) -> &[(Oddity, Span)] {
        &self.oddities
    }

    /// Name of a section, without brackets and blanks around it.
    pub fn name(&self, section: &Section) -> &'a str {
        self.slice(section.name)
    }

    /// Where the name of a section stands.
    pub fn name_span(&self, section: &Section) -> Span {
        self.span(section.name)
    }

    /// Key of an entry; the mark (`;`, or `#` behind a header) for a comment.
    pub fn key(&self, entry: &Entry) -> &'a str {
        self.slice(entry.key)
    }

    /// Value of an entry without blanks around it; the text of a comment.
    pub fn value(&self, entry: &Entry) -> &'a str {
        self.slice(entry.value)
    }

    /// Where the key stands.
    pub fn key_span(&self, entry: &Entry) -> Span {
        self.span(entry.key)
    }

    /// Where the value stands; for an empty value, the whole entry.
    pub fn value_span(&self, entry: &Entry) -> Span {
        if entry.value.0 < entry.value.1 {
            self.span(entry.value)
        } else {
            self.span((entry.key.0, entry.value.1))
        }
    }

    /// Whether the entry is a comment: a line of its own, or what stands behind a section header.
    pub fn is_comment(&self, entry: &Entry) -> bool {
        matches!(self.text.as_bytes()[entry.key.0 as usize], b';' | b'#')
    }

    fn slice(&self, range: Range) -> &'a str {
        &self.text[range.0 as usize..range.1 as usize]
    }

    fn span(&self, range: Range) -> Span {
        Span::new(self.file, range.0, range.1)
    }

    fn line(&mut self, start: usize, end: usize, line: u32) {
        let (first, last) = trim(self.text.as_bytes(), start, end);
        if first == last {
            return;
        }
        if end - start > MAX_LINE && self.text[start..end].chars().count() > MAX_LINE {
            self.odd(Oddity::LongLine, start, end);
        }
        match self.text.as_bytes()[first] {
            b'[' => self.header(start, first, last, line),
            b';' => self.comment(first, last, line),
            b'#' => self.odd(Oddity::HashLine, first, last),
            _ => self.entry(first, last, line),
        }
    }

    fn header(&mut self, start: usize, first: usize, last: usize, line: u32) {
        let bytes = self.text.as_bytes();
        if first > start {
            self.odd(Oddity::IndentedHeader, first, last);
        }
        let mut comment = None;
        let name = match memchr::memchr(b']', &bytes[first..last]) {
            Some(length) => {
                let close = first + length;
                let (rest, _) = trim(bytes, close + 1, last);
                if rest < last && matches!(bytes[rest], b';' | b'#') {
                    comment = Some(rest);
                } else if rest < last {
                    self.odd(Oddity::TextAfterHeader, rest, last);
                }
                trim(bytes, first + 1, close)
            }
            None => {
                self.odd(Oddity::UnclosedHeader, first, last);
                trim(bytes, first + 1, last)
            }
        };
        let next = self.entries.len() as u32;
        if let Some(section) = self.sections.last_mut() {
            section.last_entry = next;
        }
        self.sections.push(Section { name: (name.0 as u32, name.1 as u32), line, first_entry: next, last_entry: next });
        if let Some(mark) = comment {
            self.comment(mark, last, line);
        }
    }

    fn comment(&mut self, first: usize, last: usize, line: u32) {
        let (start, end) = trim(self.text.as_bytes(), first + 1, last);
        if start < end {
            self.push((first, first + 1), (start, end), line);
        }
    }

    fn entry(&mut self, first: usize, last: usize, line: u32) {
        let bytes = self.text.as_bytes();
        let Some(length) = memchr::memchr(b'=', &bytes[first..last]) else {
            return self.odd(Oddity::Junk, first, last);
        };
        let equals = first + length;
        let key = trim(bytes, first, equals);
        if key.0 == key.1 {
            return self.odd(Oddity::Junk, first, last);
        }
        if self.sections.is_empty() {
            return self.odd(Oddity::EntryOutsideSection, first, last);
        }
        let value = trim(bytes, equals + 1, last);
        self.push(key, value, line);
    }

    fn push(&mut self, key: (usize, usize), value: (usize, usize), line: u32) {
        self.entries.push(Entry { key: (key.0 as u32, key.1 as u32), value: (value.0 as u32, value.1 as u32), line });
    }

    fn odd(&mut self, oddity: Oddity, start: usize, end: usize) {
        self.oddities.push((oddity, self.span((start as u32, end as u32))));
    }
}

/// `start..end` without blanks and tabs at either end.
fn trim(bytes: &[u8], mut start: usize, mut end: usize) -> (usize, usize) {
    while start < end && matches!(bytes[start], b' ' | b'\t') {
        start += 1;
    }
    while start < end && matches!(bytes[end - 1], b' ' | b'\t') {
        end -= 1;
    }
    (start, end)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn flat(text: &str) -> Vec<(String, String, String)> {
        let document = Document::parse(text, FileId(0));
        let mut out = Vec::new();
        for section in document.sections() {
            for entry in document.entries(section) {
                let part = |text: &str| text.to_owned();
                out.push((part(document.name(section)), part(document.key(entry)), part(document.value(entry))));
            }
        }
        out
    }

    fn odd(text: &str) -> Vec<Oddity> {
        Document::parse(text, FileId(0)).oddities().iter().map(|&(oddity, _)| oddity).collect()
    }

    fn row(section: &str, key: &str, value: &str) -> (String, String, String) {
        (section.into(), key.into(), value.into())
    }

    #[test]
    fn every_line_end_gives_the_same_entries() {
        let expected = [row("A", "x", "1"), row("B", "y", "a=b;c"), row("B", "z", "")];
        for end in ["\n", "\r\n", "\r"] {
            let text = ["[A]", "x=1", "", "[B]", " y = a=b;c ", "z="].join(end);
            assert_eq!(flat(&text), expected, "{end:?}");
            assert_eq!(flat(&(text + end + "\u{1a}")), expected, "{end:?} and Ctrl-Z");
        }
    }

    #[test]
    fn lines_are_counted_and_spans_point_at_values() {
        let text = "[A]\r\nx=1\rlong = v \n";
        let document = Document::parse(text, FileId(3));
        let entry = document.entries(&document.sections()[0])[1];
        assert_eq!(entry.line, 3);
        assert_eq!(&text[document.value_span(&entry).range()], "v");
        assert_eq!(document.value_span(&entry).file, FileId(3));
    }

    #[test]
    fn comments_are_entries_of_their_section() {
        let text = ";top\n[A]\n; Unit=V\n;\nx=1";
        assert_eq!(flat(text), [row("A", ";", "Unit=V"), row("A", "x", "1")]);
        let document = Document::parse(text, FileId(0));
        let above: Vec<_> = document.preamble().iter().map(|entry| document.value(entry)).collect();
        assert_eq!(above, ["top"]);
        assert_eq!(Document::parse(";a\n;b", FileId(0)).preamble().len(), 2);
    }

    #[test]
    fn headers_may_have_comments_behind_and_blanks_around() {
        let document = Document::parse("[ A ] ; c\n[B]#c\n  [C]\n[D\n[E] x", FileId(0));
        let names: Vec<_> = document.sections().iter().map(|s| document.name(s)).collect();
        assert_eq!(names, ["A", "B", "C", "D", "E"]);
        assert_eq!(flat("[ A ] ; c\n[B]#c\n[C];\n"), [row("A", ";", "c"), row("B", "#", "c")]);
        assert_eq!(
            odd("[ A ] ; c\n[B]#c\n  [C]\n[D\n[E] x"),
            [Oddity::IndentedHeader, Oddity::UnclosedHeader, Oddity::TextAfterHeader]
        );
    }

    #[test]
    fn lines_without_meaning_are_noted() {
        assert_eq!(
            odd("a=1\n../x.dcf\n[A]\n# c\n=5\njunk"),
            [Oddity::EntryOutsideSection, Oddity::Junk, Oddity::HashLine, Oddity::Junk, Oddity::Junk]
        );
        assert_eq!(odd(&format!("[A]\nx={}", "é".repeat(254))), [Oddity::LongLine]);
        assert_eq!(odd(&format!("[A]\nx={}", "é".repeat(253))), []);
    }

    #[test]
    fn empty_inputs_have_nothing() {
        for text in ["", "\u{1a}", "\r\n\r\n", " \t"] {
            assert!(Document::parse(text, FileId(0)).sections().is_empty());
        }
    }
}
