//! The lexer for EDS and DCF files.
//!
//! A [`Document`] holds the list of sections, the comments above the first section, and the violations of the grammar. All parts of
//! the document are spans of the text. The lines of a section are split on request, without an allocation per line. Each violation
//! of the grammar is recorded as an [`Oddity`]. A line with a violation is still read if its meaning is clear. The front end
//! interprets the keys and values.

use std::cell::{Cell, RefCell};

use super::words;
use crate::source::{FileId, Span};

/// A file: its sections, the comments above the first section, and the violations of the grammar.
#[derive(Debug)]
pub struct Document<'a> {
    text: &'a str,
    file: FileId,
    /// Offset of the end of the text, without trailing spaces, tabs, line ends, zeros and Ctrl-Z.
    end: usize,
    sections: Vec<Section>,
    preamble: Vec<Entry>,
    /// Violations of the grammar found so far.
    oddities: RefCell<Vec<(Oddity, Span)>>,
    /// For each section, true if its violations of the grammar were already recorded.
    noted: Vec<Cell<bool>>,
}

/// A section header and the lines below it.
#[derive(Clone, Copy, Debug)]
pub struct Section {
    name: Range,
    /// Line of the header, counted from 1.
    pub line: u32,
    /// Range of the lines below the header.
    body: Range,
    /// Offset of a comment after the header; 0 if there is none.
    comment: u32,
    number: u32,
}

/// A `Key=Value` line, a comment line, or a comment after a section header.
#[derive(Clone, Copy, Debug)]
pub struct Entry {
    key: Range,
    value: Range,
    /// Line of the entry, counted from 1.
    pub line: u32,
}

/// Bytes `start..end` of the text. The file number is left out to keep the lists small.
type Range = (u32, u32);

/// A violation of the grammar of CiA 306.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Oddity {
    /// A line that is not a section header, entry or comment.
    Junk,
    /// An entry above the first section.
    EntryOutsideSection,
    /// A header without `]`.
    UnclosedHeader,
    /// A header followed by text other than a comment.
    TextAfterHeader,
    /// A header that does not start in the first column.
    IndentedHeader,
    /// A line that starts with `#`.
    HashLine,
    /// A line of more than 255 characters.
    LongLine,
}

/// Maximum number of characters in a line (CiA 306).
const MAX_LINE: usize = 255;

impl<'a> Document<'a> {
    /// Finds the sections of `text`.
    pub fn parse(text: &'a str, file: FileId) -> Self {
        // Old editors end a text with Ctrl-Z, or fill the last block with zeros.
        let end = text.trim_end_matches(['\u{1a}', '\0', '\r', '\n', ' ', '\t']).len();
        let mut document = Document {
            text,
            file,
            end,
            sections: Vec::new(),
            preamble: Vec::new(),
            oddities: RefCell::default(),
            noted: Vec::new(),
        };
        document.headers();
        document.noted = vec![Cell::new(false); document.sections.len()];
        document.preamble = document.above();
        document
    }

    /// Returns the comments above the first section.
    pub fn preamble(&self) -> &[Entry] {
        &self.preamble
    }

    /// Returns all sections in the order of the file.
    pub fn sections(&self) -> &[Section] {
        &self.sections
    }

    /// Returns the entries and comments of a section.
    pub fn entries(&self, section: &Section) -> Entries<'_> {
        let lines = Lines { at: section.body.0 as usize, end: section.body.1 as usize, line: section.line + 1 };
        Entries { document: self, lines, comment: section.comment, number: Some(section.number), odd: Vec::new() }
    }

    /// Returns the entries and comments of several sections.
    pub fn entries_of<'s>(&'s self, sections: &'s [Section]) -> impl Iterator<Item = Entry> + 's {
        sections.iter().flat_map(|section| self.entries(section))
    }

    /// Returns whether two spans are in the same section.
    pub fn is_same_section(&self, one: Span, other: Span) -> bool {
        let above = |place: Span| self.sections.partition_point(|section| section.name.0 <= place.start);
        above(one) == above(other)
    }

    /// Returns the number of entries and comments in all sections.
    pub fn entry_count(&self) -> usize {
        self.sections.iter().map(|section| self.entries(section).count()).sum()
    }

    /// Returns all violations of the grammar, in the order of the file.
    pub fn oddities(&self) -> Vec<(Oddity, Span)> {
        let left = self.sections.iter().zip(&self.noted).filter(|(_, noted)| !noted.get());
        left.for_each(|(section, _)| self.entries(section).for_each(drop));
        let mut all = self.oddities.borrow().clone();
        all.sort_by_key(|(_, span)| span.start);
        all
    }

    /// Returns the name of a section, trimmed and without brackets.
    pub fn name(&self, section: &Section) -> &'a str {
        self.slice(section.name)
    }

    /// Returns the span of a section's name.
    pub fn name_span(&self, section: &Section) -> Span {
        self.span(section.name)
    }

    /// Returns the key of an entry. For a comment, returns the comment mark (`;`, or `#` after a header).
    pub fn key(&self, entry: &Entry) -> &'a str {
        self.slice(entry.key)
    }

    /// Returns the trimmed value of an entry, or the text of a comment.
    pub fn value(&self, entry: &Entry) -> &'a str {
        self.slice(entry.value)
    }

    /// Returns the span of an entry's key.
    pub fn key_span(&self, entry: &Entry) -> Span {
        self.span(entry.key)
    }

    /// Returns the span of an entry's value. For an empty value, returns the span of the whole entry.
    pub fn value_span(&self, entry: &Entry) -> Span {
        if entry.value.0 < entry.value.1 {
            self.span(entry.value)
        } else {
            self.span((entry.key.0, entry.value.1))
        }
    }

    /// Returns the span of a part of the text.
    pub fn span_of(&self, part: &str) -> Span {
        let start = (part.as_ptr() as usize).wrapping_sub(self.text.as_ptr() as usize) as u32;
        self.span((start, start.wrapping_add(part.len() as u32)))
    }

    /// Returns whether the entry is a comment line, or a comment after a section header.
    pub fn is_comment(&self, entry: &Entry) -> bool {
        matches!(self.text.as_bytes()[entry.key.0 as usize], b';' | b'#')
    }

    fn slice(&self, range: Range) -> &'a str {
        &self.text[range.0 as usize..range.1 as usize]
    }

    fn span(&self, range: Range) -> Span {
        Span::new(self.file, range.0, range.1)
    }

    /// Finds the section headers: all lines whose first character, except spaces and tabs, is `[`.
    fn headers(&mut self) {
        let bytes = &self.text.as_bytes()[..self.end];
        let (mut from, mut line, mut counted) = (0, 1, 0);
        let has_returns = memchr::memchr(b'\r', bytes).is_some();
        while let Some(length) = memchr::memchr(b'[', &bytes[from..]) {
            let bracket = from + length;
            let blanks = bytes[from..bracket].iter().rev().take_while(|byte| matches!(byte, b' ' | b'\t')).count();
            let start = bracket - blanks;
            if start > 0 && !matches!(bytes[start - 1], b'\n' | b'\r') {
                from = bracket + 1;
                continue;
            }
            line += line_ends(&bytes[counted..start], has_returns);
            counted = start;
            let mut below = Lines { at: start, end: self.end, line };
            let Some(Line { end, .. }) = below.next(bytes) else { break };
            if let Some(section) = self.sections.last_mut() {
                section.body.1 = start as u32;
            }
            self.header(start, bracket, end, line, below.at);
            from = below.at.min(bytes.len());
        }
    }

    /// Reads the header in the line from `start` to `end`. `bracket` is the offset of `[`, and `body` is the offset of the next
    /// line.
    fn header(&mut self, start: usize, bracket: usize, end: usize, line: u32, body: usize) {
        let bytes = self.text.as_bytes();
        let mut odd = Vec::new();
        let (_, last) = trim(bytes, bracket, end);
        if is_long(&self.text[start..end]) {
            odd.push((Oddity::LongLine, start, end));
        }
        if bracket > start {
            odd.push((Oddity::IndentedHeader, bracket, last));
        }
        let mut comment = 0;
        let name = match memchr::memchr(b']', &bytes[bracket..last]) {
            Some(length) => {
                let close = bracket + length;
                let (rest, _) = trim(bytes, close + 1, last);
                if rest < last && matches!(bytes[rest], b';' | b'#') {
                    comment = rest;
                } else if rest < last {
                    odd.push((Oddity::TextAfterHeader, rest, last));
                }
                trim(bytes, bracket + 1, close)
            }
            None => {
                odd.push((Oddity::UnclosedHeader, bracket, last));
                trim(bytes, bracket + 1, last)
            }
        };
        self.note(&odd);
        self.sections.push(Section {
            name: (name.0 as u32, name.1 as u32),
            line,
            body: (body as u32, self.end as u32),
            comment: comment as u32,
            number: self.sections.len() as u32,
        });
    }

    /// Returns the comments above the first section header. Records entries above the first header as violations.
    fn above(&self) -> Vec<Entry> {
        let end = self.sections.first().map_or(self.end, |section| {
            let bracket = memchr::memrchr(b'[', &self.text.as_bytes()[..section.name.0 as usize]).unwrap_or(0);
            let blanks = self.text.as_bytes()[..bracket].iter().rev();
            bracket - blanks.take_while(|byte| matches!(byte, b' ' | b'\t')).count()
        });
        let lines = Lines { at: 0, end, line: 1 };
        let (entries, rest): (Vec<_>, Vec<_>) =
            Entries { document: self, lines, comment: 0, number: None, odd: Vec::new() }
                .partition(|entry| self.is_comment(entry));
        let outside = |entry: &Entry| (Oddity::EntryOutsideSection, entry.key.0 as usize, entry.value.1 as usize);
        self.note(&rest.iter().map(outside).collect::<Vec<_>>());
        entries
    }

    fn note(&self, odd: &[(Oddity, usize, usize)]) {
        let span = |&(oddity, start, end): &(Oddity, usize, usize)| (oddity, self.span((start as u32, end as u32)));
        self.oddities.borrow_mut().extend(odd.iter().map(span));
    }
}

/// Iterator over the lines of a part of the text.
#[derive(Clone, Debug)]
struct Lines {
    at: usize,
    end: usize,
    line: u32,
}

/// A line without its line end.
struct Line {
    start: usize,
    end: usize,
    /// Offset of the first `=` in the line.
    equals: Option<usize>,
    number: u32,
}

impl Lines {
    #[inline]
    fn next(&mut self, bytes: &[u8]) -> Option<Line> {
        if self.at >= self.end {
            return None;
        }
        let (start, number) = (self.at, self.line);
        let (end, equals) = scan(&bytes[..self.end], start);
        let crlf = bytes[end..].starts_with(b"\r\n");
        self.at = end + 1 + usize::from(crlf);
        self.line += 1;
        Some(Line { start, end, equals, number })
    }
}

/// Returns the end of the line that starts at `start`, and the offset of its first `=`.
#[inline]
fn scan(bytes: &[u8], start: usize) -> (usize, Option<usize>) {
    let (mut at, mut equals) = (start, None);
    let mut chunks = bytes[start..].chunks_exact(8);
    for chunk in chunks.by_ref() {
        let word = words::word(chunk);
        if equals.is_none() {
            let signs = words::equal(word, b'=');
            equals = (signs != 0).then(|| at + words::first(signs));
        }
        // Most words contain no control character, so this comparison usually shows that the word contains no line end.
        if words::less(word, b' ') != 0 {
            let ends = words::equal(word, b'\n') | words::equal(word, b'\r');
            if ends != 0 {
                let end = at + words::first(ends);
                return (end, equals.filter(|&equals| equals < end));
            }
        }
        at += 8;
    }
    for (at, byte) in (at..).zip(chunks.remainder()) {
        match byte {
            b'\n' | b'\r' => return (at, equals),
            b'=' => equals = equals.or(Some(at)),
            _ => {}
        }
    }
    (bytes.len(), equals)
}

/// Iterator over the entries and comments of a section, in the order of the file.
#[derive(Clone, Debug)]
pub struct Entries<'d> {
    document: &'d Document<'d>,
    lines: Lines,
    comment: u32,
    number: Option<u32>,
    /// Violations of the grammar in the section. The violations are added to the document after the last line has been read, so
    /// that each violation is recorded only once.
    odd: Vec<(Oddity, usize, usize)>,
}

impl Iterator for Entries<'_> {
    type Item = Entry;

    // Reading a line is so short that copying the entry from a call through memory is a large part of the time.
    #[inline(always)]
    fn next(&mut self) -> Option<Entry> {
        let bytes = &self.document.text.as_bytes()[..self.document.end];
        if self.comment > 0 {
            if let Some(comment) = self.comment_after_header(bytes) {
                return Some(comment);
            }
        }
        while let Some(line) = self.lines.next(bytes) {
            if let Some(entry) = self.line(bytes, &line) {
                return Some(entry);
            }
        }
        self.finish();
        None
    }
}

impl Entries<'_> {
    /// Returns the comment after the header, or `None` if the comment is empty.
    #[cold]
    fn comment_after_header(&mut self, bytes: &[u8]) -> Option<Entry> {
        let first = std::mem::take(&mut self.comment) as usize;
        let end = memchr::memchr2(b'\n', b'\r', &bytes[first..]).map_or(bytes.len(), |length| first + length);
        let (first, last) = trim(bytes, first, end);
        comment(bytes, first, last, self.lines.line - 1)
    }

    #[inline(always)]
    fn line(&mut self, bytes: &[u8], line: &Line) -> Option<Entry> {
        let &Line { start, end, equals, number } = line;
        let (first, last) = trim(bytes, start, end);
        if first == last {
            return None;
        }
        if end - start > MAX_LINE && is_long(&self.document.text[start..end]) {
            self.odd.push((Oddity::LongLine, start, end));
        }
        match bytes[first] {
            b';' => return comment(bytes, first, last, number),
            b'#' => self.odd.push((Oddity::HashLine, first, last)),
            _ => match equals.filter(|&equals| equals > first) {
                Some(equals) => {
                    let key_end = end_of(bytes, first, equals);
                    return Some(entry((first, key_end), (start_of(bytes, equals + 1, last), last), number));
                }
                None => self.odd.push((Oddity::Junk, first, last)),
            },
        }
        None
    }

    fn finish(&mut self) {
        let noted = self.number.and_then(|number| self.document.noted.get(number as usize));
        let is_first = noted.is_none_or(|noted| !noted.replace(true));
        if is_first && !self.odd.is_empty() {
            self.document.note(&self.odd);
        }
        self.odd.clear();
    }
}

fn comment(bytes: &[u8], first: usize, last: usize, line: u32) -> Option<Entry> {
    let text = trim(bytes, first + 1, last);
    (text.0 < text.1).then(|| entry((first, first + 1), text, line))
}

fn entry(key: (usize, usize), value: (usize, usize), line: u32) -> Entry {
    Entry { key: (key.0 as u32, key.1 as u32), value: (value.0 as u32, value.1 as u32), line }
}

fn is_long(line: &str) -> bool {
    line.len() > MAX_LINE && line.chars().count() > MAX_LINE
}

/// Counts the line ends in `bytes`: CR LF, LF and single CR. `has_returns` states whether the text contains any CR.
fn line_ends(bytes: &[u8], has_returns: bool) -> u32 {
    let feeds = || memchr::memchr_iter(b'\n', bytes);
    if !has_returns {
        return feeds().count() as u32;
    }
    let both = feeds().filter(|&at| bytes[..at].ends_with(b"\r")).count();
    (feeds().count() + memchr::memchr_iter(b'\r', bytes).count() - both) as u32
}

/// Trims spaces and tabs from both ends of `start..end`.
fn trim(bytes: &[u8], start: usize, end: usize) -> (usize, usize) {
    let start = start_of(bytes, start, end);
    (start, end_of(bytes, start, end))
}

/// Returns the offset of the first byte in `start..end` that is not a space or tab.
#[inline]
fn start_of(bytes: &[u8], mut start: usize, end: usize) -> usize {
    while start < end && matches!(bytes[start], b' ' | b'\t') {
        start += 1;
    }
    start
}

/// Returns the offset after the last byte in `start..end` that is not a space or tab.
#[inline]
fn end_of(bytes: &[u8], start: usize, mut end: usize) -> usize {
    while start < end && matches!(bytes[end - 1], b' ' | b'\t') {
        end -= 1;
    }
    end
}

#[cfg(test)]
mod tests {
    use super::*;

    fn flat(text: &str) -> Vec<(String, String, String)> {
        let document = Document::parse(text, FileId(0));
        let mut out = Vec::new();
        for section in document.sections() {
            for entry in document.entries(section) {
                let (key, value) = (document.key(&entry), document.value(&entry));
                out.push((document.name(section).to_owned(), key.to_owned(), value.to_owned()));
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
        let entry = document.entries(&document.sections()[0]).nth(1).unwrap();
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
    fn places_are_in_a_section() {
        let document = Document::parse("[A]\na=1\na=2\n[A]\na=3", FileId(0));
        let values = document.entries_of(document.sections()).map(|entry| document.value_span(&entry));
        let values: Vec<Span> = values.collect();
        assert_eq!(values.len(), 3);
        assert!(document.is_same_section(values[0], values[1]) && !document.is_same_section(values[1], values[2]));
    }

    #[test]
    fn empty_inputs_have_nothing() {
        for text in ["", "\u{1a}", "\r\n\r\n", " \t"] {
            assert!(Document::parse(text, FileId(0)).sections().is_empty());
        }
    }
}
