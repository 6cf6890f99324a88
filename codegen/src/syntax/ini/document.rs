//! The sections of a text, and their entries.

use std::cell::{Cell, RefCell};
use std::cmp::Reverse;

use super::lines::{line_end, line_end_length, line_ends, range, trim_end, trim_start, trimmed, Line, Lines, Range};
use crate::source::{FileId, Span};
use crate::syntax::words;

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
    /// For each section, true if all its lines were read, so that all its violations of the grammar are recorded.
    is_read: Vec<Cell<bool>>,
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

/// A violation of the grammar of CiA 306. Violations with the same span are reported in the order of these variants.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Oddity {
    /// A line of more than 255 characters.
    LongLine,
    /// A header that does not start in the first column.
    IndentedHeader,
    /// A line that is not a section header, entry or comment.
    Junk,
    /// An entry above the first section.
    EntryOutsideSection,
    /// A header without `]`.
    UnclosedHeader,
    /// A header followed by text other than a comment.
    TextAfterHeader,
    /// A line that starts with `#`.
    HashLine,
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
            is_read: Vec::new(),
        };
        document.headers();
        document.is_read = vec![Cell::new(false); document.sections.len()];
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
        let lines = self.lines(section.body.0 as usize, section.body.1 as usize, section.line + 1);
        Entries { document: self, lines, comment: section.comment, section: section.number }
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
        let unread = self.sections.iter().zip(&self.is_read).filter(|(_, is_read)| !is_read.get());
        unread.for_each(|(section, _)| self.entries(section).for_each(drop));
        let mut all = self.oddities.borrow().clone();
        all.sort_by_key(|&(oddity, span)| (span.start, Reverse(span.end), oddity));
        // A section that was left before its end was read twice.
        all.dedup();
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

    /// Returns the bytes of [`key`](Self::key).
    pub fn key_bytes(&self, entry: &Entry) -> &'a [u8] {
        &self.text.as_bytes()[entry.key.0 as usize..entry.key.1 as usize]
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

    /// Returns the range from `start` to `end` without the spaces and tabs at both ends.
    fn trimmed(&self, start: usize, end: usize) -> Range {
        trimmed(start, &self.text.as_bytes()[start..end])
    }

    /// Returns the lines from `at`, the start of line number `line`, to `end`, the start of another line or the end of the text.
    fn lines(&self, at: usize, end: usize, line: u32) -> Lines<'a> {
        Lines { bytes: &self.text.as_bytes()[..self.end], at, end, line }
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
            let end = start + words::find(&bytes[start..], line_end);
            let below = end + line_end_length(&bytes[end..]);
            if let Some(section) = self.sections.last_mut() {
                section.body.1 = start as u32;
            }
            self.header(start, bracket, end, line, below);
            from = below.min(bytes.len());
        }
    }

    /// Reads the header in the line from `start` to `end`. `bracket` is the offset of `[`, and `body` is the offset of the next
    /// line.
    fn header(&mut self, start: usize, bracket: usize, end: usize, line: u32, body: usize) {
        let bytes = self.text.as_bytes();
        let last = self.trimmed(bracket, end).1 as usize;
        if is_long(&self.text[start..end]) {
            self.note(Oddity::LongLine, range(start, end));
        }
        if bracket > start {
            self.note(Oddity::IndentedHeader, range(bracket, last));
        }
        let mut comment = 0;
        let name = match memchr::memchr(b']', &bytes[bracket..last]) {
            Some(length) => {
                let close = bracket + length;
                let rest = self.trimmed(close + 1, last).0 as usize;
                if rest < last && matches!(bytes[rest], b';' | b'#') {
                    comment = rest;
                } else if rest < last {
                    self.note(Oddity::TextAfterHeader, range(rest, last));
                }
                self.trimmed(bracket + 1, close)
            }
            None => {
                self.note(Oddity::UnclosedHeader, range(bracket, last));
                self.trimmed(bracket + 1, last)
            }
        };
        self.sections.push(Section {
            name,
            line,
            body: range(body, self.end),
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
        let lines = self.lines(0, end, 1);
        let (entries, rest): (Vec<_>, Vec<_>) =
            Entries { document: self, lines, comment: 0, section: u32::MAX }.partition(|entry| self.is_comment(entry));
        for entry in rest {
            self.note(Oddity::EntryOutsideSection, (entry.key.0, entry.value.1));
        }
        entries
    }

    #[cold]
    fn note(&self, oddity: Oddity, at: Range) {
        self.oddities.borrow_mut().push((oddity, self.span(at)));
    }

    /// Records a violation in the section `section`, unless all violations of the section are already recorded.
    #[cold]
    fn note_in(&self, section: u32, oddity: Oddity, at: Range) {
        if self.is_read.get(section as usize).is_none_or(|is_read| !is_read.get()) {
            self.note(oddity, at);
        }
    }

    #[cold]
    fn long_line(&self, section: u32, line: Line) {
        if is_long(&self.text[line.start..line.end()]) {
            self.note_in(section, Oddity::LongLine, range(line.start, line.end()));
        }
    }

    /// Returns the mark and the text of a comment line. Records any other line as a violation.
    #[inline(never)]
    fn line_without_key(&self, section: u32, line: Line) -> Option<(Range, Range)> {
        let found = self.trimmed(line.start, line.end());
        match self.slice(found).as_bytes().first()? {
            b';' => return self.comment(found.0 as usize, found.1 as usize),
            b'#' => self.note_in(section, Oddity::HashLine, found),
            _ => self.note_in(section, Oddity::Junk, found),
        }
        None
    }

    /// Returns the mark and the text of a comment that starts at `start`, or `None` if the text is empty.
    fn comment(&self, start: usize, end: usize) -> Option<(Range, Range)> {
        let text = self.trimmed(start + 1, end);
        (text.0 < text.1).then(|| (range(start, start + 1), text))
    }

    /// Returns the mark and the text of a comment after a section header, or `None` if the text is empty.
    #[cold]
    fn comment_after_header(&self, start: usize) -> Option<(Range, Range)> {
        let rest = &self.text.as_bytes()[start..self.end];
        self.comment(start, start + memchr::memchr2(b'\n', b'\r', rest).unwrap_or(rest.len()))
    }
}

/// Iterator over the entries and comments of a section, in the order of the file.
#[derive(Clone, Debug)]
pub struct Entries<'d> {
    document: &'d Document<'d>,
    lines: Lines<'d>,
    comment: u32,
    /// Number of the section; `u32::MAX` for the lines above the first section.
    section: u32,
}

impl Iterator for Entries<'_> {
    type Item = Entry;

    // Reading a line is so short that copying the entry from a call through memory is a large part of the time.
    #[inline(always)]
    fn next(&mut self) -> Option<Entry> {
        if self.comment > 0 {
            let start = std::mem::take(&mut self.comment) as usize;
            if let Some((key, value)) = self.document.comment_after_header(start) {
                return Some(Entry { key, value, line: self.lines.line - 1 });
            }
        }
        while let Some(line) = self.lines.next() {
            if let Some(entry) = self.entry(line) {
                return Some(entry);
            }
        }
        if let Some(is_read) = self.document.is_read.get(self.section as usize) {
            is_read.set(true);
        }
        None
    }
}

impl Entries<'_> {
    /// Returns the entry of the next line if the line starts with `key` and `=`. Otherwise returns `None` and reads nothing. `key` has
    /// 8 to 16 bytes. This method is faster than [`next`](Iterator::next) if the caller can predict the key.
    #[inline(always)]
    pub fn next_if_key(&mut self, key: &[u8]) -> Option<Entry> {
        let Lines { bytes, at: start, end, line } = self.lines;
        let (found, rest) = bytes.get(start..)?.split_at_checked(key.len())?;
        let [b'=', rest @ ..] = rest else { return None };
        if !words::equal_texts(found, key) || self.comment > 0 || start >= end {
            return None;
        }
        let (value, below) = rest.split_at_checked(words::find(rest, line_end))?;
        let equals = start + key.len();
        let at = equals + 1 + value.len();
        if at - start > MAX_LINE {
            return None;
        }
        self.lines.at = at + line_end_length(below);
        self.lines.line = line + 1;
        Some(Entry { key: range(start, equals), value: trimmed(equals + 1, value), line })
    }

    #[inline(always)]
    fn entry(&self, line: Line) -> Option<Entry> {
        let key = trim_start(line.key);
        if key.is_empty() && line.value.is_none() {
            return None;
        }
        if line.end() - line.start > MAX_LINE {
            self.document.long_line(self.section, line);
        }
        // This match is not a separate function, because its result would be copied through memory.
        let (key, value) = match (key, line.value) {
            ([], _) | ([b';' | b'#', ..], _) | (_, None) => self.document.line_without_key(self.section, line)?,
            (_, Some(value)) => {
                let equals = line.start + line.key.len();
                let start = equals - key.len();
                (range(start, start + trim_end(key).len()), trimmed(equals + 1, value))
            }
        };
        Some(Entry { key, value, line: line.number })
    }
}

fn is_long(line: &str) -> bool {
    line.len() > MAX_LINE && line.chars().count() > MAX_LINE
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
        assert_eq!(odd(&format!("[A]\n{}\nx=1", " ".repeat(300))), []);
    }

    #[test]
    fn violations_of_a_section_that_is_read_twice_are_recorded_once() {
        let text = format!("[A]\njunk\na=1\nx={}\n#b", "é".repeat(254));
        let document = Document::parse(&text, FileId(0));
        let section = &document.sections()[0];
        assert!(document.entries(section).next().is_some());
        assert_eq!([document.entries(section).count(), document.entries(section).count()], [2, 2]);
        let oddities: Vec<Oddity> = document.oddities().iter().map(|&(oddity, _)| oddity).collect();
        assert_eq!(oddities, [Oddity::Junk, Oddity::LongLine, Oddity::HashLine]);
    }

    /// `next_if_key` returns the same entry as `next`, or `None` if the next line has another form.
    #[test]
    fn a_predicted_key_gives_the_same_entry() {
        for line in ["DataType=5", "DataType= 0x7 \t", "DataType=", "DataType=a=b;c"] {
            for end in ["", "\n", "\r\n", "\r", "\n\n[B]\nDataType=1"] {
                let text = format!("[A]\n{line}{end}");
                let document = Document::parse(&text, FileId(0));
                let section = &document.sections()[0];
                let mut predicted = document.entries(section);
                let (found, expected) = (predicted.next_if_key(b"DataType"), document.entries(section).next());
                assert_eq!(format!("{found:?}"), format!("{expected:?}"), "{text:?}");
                assert!(predicted.next_if_key(b"DataType").is_none() && predicted.next().is_none(), "{text:?}");
            }
        }
        let long = format!("[A]\nDataType={}", "é".repeat(247));
        let others = [
            "[A];c\nDataType=5",
            "[A]\n DataType=5",
            "[A]\nDataType =5",
            "[A]\ndatatype=5",
            "[A]\nDataTypes=5",
            "[A]",
            &long,
        ];
        for text in others {
            let document = Document::parse(text, FileId(0));
            assert!(document.entries(&document.sections()[0]).next_if_key(b"DataType").is_none(), "{text:?}");
        }
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
