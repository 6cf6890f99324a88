//! The cursor, which reads the events of a document in order and keeps the stack of open elements.

use compact_str::{format_compact, CompactString};
use memchr::{memchr, memchr_iter};

use super::scan::{self, Name};
use super::{Error, Event, Tag, Text};
use crate::diagnostics::codes;
use crate::limits;
use crate::source::{FileId, Origin, Span};
use crate::text::brief;

/// Reads the events of an XML document in order.
pub struct Cursor<'a> {
    text: &'a str,
    /// Byte offset at which reading continues.
    at: usize,
    file: FileId,
    /// Names of the open elements with their prefixes, starting with the root.
    open: Vec<&'a str>,
    /// True if the last start tag was that of an empty element. The end of this element is then the next event.
    empty: bool,
    root_seen: bool,
    /// Line number of the byte at offset `line_at`.
    line: u32,
    line_at: usize,
}

impl<'a> Cursor<'a> {
    /// Creates a cursor at the start of the document `text`.
    pub fn new(text: &'a str, file: FileId) -> Self {
        let base = text.len() - text.trim_start_matches('\u{feff}').len();
        Cursor::start(text, base, file, 1)
    }

    /// Creates a cursor at the start tag `origin` of an element, to read the element again. The cursor does not know the parent
    /// elements.
    pub fn resume(text: &'a str, origin: Origin) -> Self {
        let at = (origin.span.start as usize).min(text.len());
        let at = if text.is_char_boundary(at) { at } else { text.len() };
        Cursor::start(text, at, origin.span.file, origin.line)
    }

    fn start(text: &'a str, at: usize, file: FileId, line: u32) -> Self {
        Cursor { text, at, file, open: Vec::new(), empty: false, root_seen: false, line, line_at: at }
    }

    /// Returns the whole document.
    pub fn text(&self) -> &'a str {
        self.text
    }

    /// Returns the next event, or `None` at the end of the document.
    ///
    /// # Errors
    ///
    /// Returns an error if the document is not well-formed, or is nested deeper than [`limits::MAX_XML_DEPTH`]. Reading cannot
    /// continue after an error.
    pub fn read(&mut self) -> Result<Option<Event<'a>>, Error> {
        if std::mem::take(&mut self.empty) {
            self.open.pop();
            return Ok(Some(Event::End));
        }
        loop {
            let start = scan::after_blanks(self.text.as_bytes(), self.at);
            match &self.text.as_bytes()[start..] {
                [] => {
                    self.at = start;
                    return self.finish().map(|()| None);
                }
                [b'<', b'/', ..] => return self.end_tag(start).map(Some),
                [b'<', b'?', b'>', ..] => {
                    return Err(malformed(self.span(start, start + 3), "this processing instruction has no name"));
                }
                [b'<', b'?', ..] => self.skip_to("?>", start, 2, "this processing instruction has no closing `?>`")?,
                [b'<', b'!', b'-', b'-', ..] => self.skip_to("-->", start, 4, "this comment has no closing `-->`")?,
                [b'<', b'!', ..] => {
                    if let Some(text) = self.declaration(start)? {
                        return Ok(Some(Event::Text(text)));
                    }
                }
                [b'<', ..] => return self.start_tag(start).map(Some),
                _ => return self.text_to_tag().map(|text| Some(Event::Text(text))),
            }
        }
    }

    /// Reads up to the root element and returns its start tag.
    ///
    /// # Errors
    ///
    /// Returns the errors of [`Cursor::read`], and an error for a document without an element.
    pub fn root(&mut self) -> Result<Tag<'a>, Error> {
        while let Some(event) = self.read()? {
            if let Event::Start(tag) = event {
                return Ok(tag);
            }
        }
        Err(self.no_root())
    }

    /// Returns the next child of the open element `parent`, or `None` at the end of `parent`. Skips the unread rest
    /// of the previous child.
    ///
    /// # Errors
    ///
    /// Returns the errors of [`Cursor::read`].
    pub fn child(&mut self, parent: &Tag<'a>) -> Result<Option<Tag<'a>>, Error> {
        while self.depth() >= parent.depth {
            match self.read()? {
                Some(Event::Start(tag)) if tag.depth == parent.depth + 1 => return Ok(Some(tag)),
                Some(_) => {}
                None => break,
            }
        }
        Ok(None)
    }

    /// Reads the innermost open element to its end and returns its text, if it contains exactly one piece of text and its
    /// end tag contains no white space. Otherwise, reads nothing and returns `None`.
    pub fn only_text(&mut self) -> Option<Text<'a>> {
        let open = self.open.last().filter(|_| !self.empty)?;
        let rest = &self.text.as_bytes()[self.at..];
        let length = scan::find_near(b'<', rest).filter(|&length| length > 0)?;
        let end = rest[length..].strip_prefix(b"</")?.strip_prefix(open.as_bytes())?.strip_prefix(b">")?;
        let text = self.piece(self.at, self.at + length, false);
        self.at += rest.len() - end.len();
        self.open.pop();
        Some(text)
    }

    /// Reads the open element `tag` to its end.
    ///
    /// # Errors
    ///
    /// Returns the errors of [`Cursor::read`].
    pub fn skip(&mut self, tag: &Tag<'a>) -> Result<(), Error> {
        while self.depth() >= tag.depth && self.read()?.is_some() {}
        Ok(())
    }

    /// Returns the number of open elements.
    pub fn depth(&self) -> u32 {
        self.open.len() as u32
    }

    /// Returns the byte offset at which reading continues.
    pub fn offset(&self) -> u32 {
        self.at as u32
    }

    /// Returns the names of the open elements without their prefixes, starting with the root.
    pub fn path(&self) -> impl DoubleEndedIterator<Item = &'a str> + '_ {
        self.open.iter().map(|full| full.split_once(':').map_or(*full, |(_, name)| name))
    }

    /// Returns the names of the two innermost open elements as `parent/child`, or only the name of the root if no other element is
    /// open. Shortens each name to 64 characters.
    pub fn innermost(&self) -> CompactString {
        let mut path = self.path().rev();
        let child = path.next().map_or("", brief);
        match path.next() {
            Some(parent) => format_compact!("{}/{child}", brief(parent)),
            None => child.into(),
        }
    }

    /// Returns the line and the span of a start tag.
    pub fn origin(&mut self, tag: &Tag<'a>) -> Origin {
        Origin { span: tag.span, line: self.line(tag.span.start) }
    }

    /// Returns the line of a byte of the document, counted from 1. Scans only the bytes between this offset and the offset of the
    /// previous call.
    pub fn line(&mut self, offset: u32) -> u32 {
        let offset = (offset as usize).min(self.text.len());
        let (from, to) = (self.line_at.min(offset), self.line_at.max(offset));
        let bytes = self.text.as_bytes();
        let passed = &bytes[from..to];
        let mut ends = memchr_iter(b'\n', passed).count() as u32;
        // The two characters CR LF count as one line end.
        if memchr(b'\r', passed).is_some() {
            ends += memchr_iter(b'\r', passed).filter(|at| bytes.get(from + at + 1) != Some(&b'\n')).count() as u32;
        }
        self.line = if offset >= self.line_at { self.line + ends } else { self.line - ends };
        self.line_at = offset;
        self.line
    }

    fn span(&self, start: usize, end: usize) -> Span {
        Span::new(self.file, start as u32, end as u32)
    }

    fn piece(&self, start: usize, end: usize, cdata: bool) -> Text<'a> {
        Text { raw: &self.text[start..end], span: self.span(start, end), cdata }
    }

    fn start_tag(&mut self, start: usize) -> Result<Event<'a>, Error> {
        let bytes = self.text.as_bytes();
        let Some(name) = Name::of(&self.text[start + 1..]) else {
            return Err(malformed(self.span(start, self.boundary(start + 2)), NO_START_TAG));
        };
        let after_name = start + 1 + name.length;
        let Some((end, has_less_than)) = scan::tag_end(bytes, after_name) else { return Err(self.endless_tag(start)) };
        let empty = end > after_name && bytes[end - 1] == b'/';
        let attributes = &self.text[after_name..end - usize::from(empty)];
        if !attributes.is_empty() {
            let is_separate = attributes.bytes().next().is_some_and(scan::is_blank);
            if !is_separate || has_less_than {
                return Err(malformed(self.span(start, after_name), NO_START_TAG));
            }
        }
        let full = &self.text[start + 1..after_name];
        let span = self.span(start, end + 1);
        self.push(full, span)?;
        (self.empty, self.at) = (empty, end + 1);
        let (prefix, name) = name.split(full);
        let depth = self.depth();
        Ok(Event::Start(Tag { name, prefix, span, depth, empty, attributes, attributes_at: after_name as u32 }))
    }

    /// Adds an element to the stack of open elements. Returns an error for a second root element, and for elements that are nested
    /// too deeply.
    fn push(&mut self, name: &'a str, span: Span) -> Result<(), Error> {
        if self.open.is_empty() && std::mem::replace(&mut self.root_seen, true) {
            return Err(malformed(span, format!("<{}> is a second root element", brief(name))));
        }
        if self.open.len() >= limits::MAX_XML_DEPTH {
            let message = format!("elements are nested deeper than {}", limits::MAX_XML_DEPTH);
            return Err(Error::new(&codes::INPUT_TOO_LARGE, span, message));
        }
        self.open.push(name);
        Ok(())
    }

    fn end_tag(&mut self, start: usize) -> Result<Event<'a>, Error> {
        let rest = &self.text.as_bytes()[start + 2..];
        let open = self.open.last().copied();
        let after = open.and_then(|open| rest.strip_prefix(open.as_bytes())?.strip_prefix(b">"));
        if let Some(after) = after {
            self.at = self.text.len() - after.len();
            self.open.pop();
            return Ok(Event::End);
        }
        let Some(end) = scan::find_near(b'>', rest) else { return Err(self.endless_tag(start)) };
        let name = self.text[start + 2..start + 2 + end].trim_ascii_end();
        self.at = start + end + 3;
        let span = self.span(start, self.at);
        match open {
            Some(open) if open == name => {
                self.open.pop();
                Ok(Event::End)
            }
            Some(open) => {
                let message = format!("`</{}>` does not match the open element <{}>", brief(name), brief(open));
                Err(malformed(span, message).note_at(self.span_of(open), "the open element starts here"))
            }
            None => Err(malformed(span, format!("`</{}>` has no start tag", brief(name)))),
        }
    }

    /// Skips markup that begins at `start` with a delimiter of `opening` bytes, and ends with the delimiter `end`.
    fn skip_to(&mut self, end: &str, start: usize, opening: usize, missing: &str) -> Result<(), Error> {
        let after = scan::after(self.text.as_bytes(), start + opening, end);
        self.at = after.ok_or_else(|| malformed(self.span(start, start + 1), missing))?;
        Ok(())
    }

    /// Reads the declaration at `start`. Returns the text of a CDATA section, or skips a document type declaration and
    /// returns `None`.
    fn declaration(&mut self, start: usize) -> Result<Option<Text<'a>>, Error> {
        const CDATA: &str = "<![CDATA[";
        if self.text[start..].starts_with(CDATA) {
            self.skip_to("]]>", start, CDATA.len(), "this CDATA section has no closing `]]>`")?;
            let text = self.piece(start + CDATA.len(), self.at - 3, true);
            return self.inside(text.span).map(|()| Some(text));
        }
        if !self.text[start..].starts_with("<!DOCTYPE") {
            return Err(malformed(self.span(start, start + 2), "this is not an XML declaration"));
        }
        let missing = || malformed(self.span(start, start + 1), "this declaration has no closing `>`");
        self.at = scan::after_doctype(self.text.as_bytes(), start).ok_or_else(missing)?;
        Ok(None)
    }

    /// Returns the text up to the next `<`, including white space.
    fn text_to_tag(&mut self) -> Result<Text<'a>, Error> {
        let rest = &self.text.as_bytes()[self.at..];
        let length = scan::find_near(b'<', rest).unwrap_or(rest.len());
        let text = self.piece(self.at, self.at + length, false);
        self.inside(text.span)?;
        self.at += length;
        Ok(text)
    }

    /// Returns an error if the text at `span` is outside the root element.
    fn inside(&self, span: Span) -> Result<(), Error> {
        if !self.open.is_empty() {
            return Ok(());
        }
        let text = self.text.get(span.range()).unwrap_or("");
        let start = span.start + (text.len() - text.trim_start().len()) as u32;
        let span = Span { start, end: start + text.trim().len() as u32, ..span };
        Err(malformed(span, "this text is outside the root element"))
    }

    fn endless_tag(&self, start: usize) -> Error {
        malformed(self.span(start, start + 1), "this tag has no closing `>`")
    }

    fn finish(&self) -> Result<(), Error> {
        if !self.root_seen {
            return Err(self.no_root());
        }
        let Some(&open) = self.open.last() else { return Ok(()) };
        let error = malformed(self.last_character(), format!("the file ends inside <{}>", brief(open)));
        Err(error.note_at(self.span_of(open), "the element starts here"))
    }

    fn no_root(&self) -> Error {
        malformed(self.last_character(), "the file has no root element")
    }

    /// Returns the span of the last character that was read.
    fn last_character(&self) -> Span {
        let start = self.text[..self.at].char_indices().next_back().map_or(0, |(start, _)| start);
        self.span(start, self.at)
    }

    /// Returns the first character boundary at or after `at`.
    fn boundary(&self, at: usize) -> usize {
        (at..self.text.len()).find(|&at| self.text.is_char_boundary(at)).unwrap_or(self.text.len())
    }

    /// Returns the span of a part of the document.
    fn span_of(&self, part: &str) -> Span {
        let start = (part.as_ptr() as usize).wrapping_sub(self.text.as_ptr() as usize);
        self.span(start, start + part.len())
    }
}

const NO_START_TAG: &str = "this is not a start tag";

fn malformed(span: Span, message: impl Into<String>) -> Error {
    Error::new(&codes::MALFORMED_XML, span, message)
}
