//! One cursor over the events of an XML document, with positions and the breadcrumb of open elements.
//!
//! [`Cursor::read`] gives the start of an element, its end (also for `<empty/>`), and text; comments, processing
//! instructions, declarations and text of nothing but blanks are passed over. Names come without their namespace
//! prefix. Attributes are taken apart only when somebody asks for them, and values are decoded only when they are used,
//! so that passing over a part of a document allocates nothing.
//!
//! A reader walks down with [`Cursor::child`], which skips whatever of a child nobody read:
//!
//! ```
//! use lexibus_codegen::source::FileId;
//! use lexibus_codegen::syntax::xml::Cursor;
//!
//! let mut cursor = Cursor::new("<a><b x='1'/><c><d/></c></a>", FileId(0));
//! let root = cursor.root()?;
//! let mut names = Vec::new();
//! while let Some(tag) = cursor.child(&root)? {
//!     names.push(tag.name);
//! }
//! assert_eq!(names, ["b", "c"]);
//! # Ok::<(), lexibus_codegen::syntax::xml::Error>(())
//! ```
//!
//! No DTD is read and no entity is expanded but the five of XML itself, so that a small file can't grow into a large
//! one. Reading stops at the first error, which is the only one.

use std::borrow::Cow;

use compact_str::{format_compact, CompactString};
use memchr::{memchr, memchr2, memchr_iter};
use quick_xml::events::Event as Raw;
use quick_xml::Reader;
use smallvec::SmallVec;

use crate::diagnostics::{codes, Code, Diagnostic, Diagnostics};
use crate::limits;
use crate::source::{FileId, Origin, Span};
use crate::text::brief;

/// Why reading stopped: the document isn't well formed, or nested too deeply.
#[derive(Clone, Debug)]
pub struct Error(Box<Diagnostic>);

impl Error {
    fn new(code: &'static Code, span: Span, message: impl Into<String>) -> Self {
        Error(Box::new(Diagnostic::new(code, span, message)))
    }

    /// The diagnostic to file.
    pub fn into_diagnostic(self) -> Diagnostic {
        *self.0
    }
}

impl From<Error> for Box<Diagnostic> {
    fn from(error: Error) -> Self {
        error.0
    }
}

/// What the cursor found.
#[derive(Clone, Copy, Debug)]
pub enum Event<'a> {
    /// An element starts. That of `<empty/>` ends with the next event.
    Start(Tag<'a>),
    /// The innermost open element ends.
    End,
    /// Text or CDATA. Comments divide a text into several events.
    Text(Text<'a>),
}

/// The start tag of an element.
#[derive(Clone, Copy, Debug)]
pub struct Tag<'a> {
    /// The name without its prefix.
    pub name: &'a str,
    /// Its prefix; empty = none.
    pub prefix: &'a str,
    /// The tag from `<` to `>`.
    pub span: Span,
    /// How many elements are open, this one included.
    pub depth: usize,
    /// Whether it is `<empty/>`.
    pub empty: bool,
    /// What stands between the name and the end of the tag, and where.
    attributes: &'a str,
    attributes_at: u32,
}

impl<'a> Tag<'a> {
    /// The attributes in the order of the source, namespace declarations included.
    pub fn attributes(&self) -> Attributes<'a> {
        Attributes { rest: self.attributes, at: self.attributes_at, file: self.span.file, seen: SmallVec::new() }
    }

    /// The attribute with this name, whatever its prefix.
    ///
    /// # Errors
    ///
    /// When the tag isn't well formed up to the attribute.
    pub fn attribute(&self, name: &str) -> Result<Option<Attribute<'a>>, Error> {
        for attribute in self.attributes() {
            let attribute = attribute?;
            if attribute.name == name && attribute.prefix != "xmlns" {
                return Ok(Some(attribute));
            }
        }
        Ok(None)
    }

    /// Where the name stands, with its prefix.
    pub fn name_span(&self) -> Span {
        Span::new(self.span.file, self.span.start + 1, self.attributes_at)
    }
}

/// An attribute.
#[derive(Clone, Copy, Debug)]
pub struct Attribute<'a> {
    /// The name without its prefix.
    pub name: &'a str,
    /// Its prefix; empty = none.
    pub prefix: &'a str,
    /// The value as it stands in the source.
    pub raw: &'a str,
    /// Where the name stands.
    pub name_span: Span,
    /// Where the value stands, without its quotation marks.
    pub span: Span,
}

impl<'a> Attribute<'a> {
    /// Whether it declares a namespace.
    pub fn is_namespace(&self) -> bool {
        self.prefix == "xmlns" || (self.prefix.is_empty() && self.name == "xmlns")
    }

    /// The value with references resolved and blanks normalised (XML 1.0, 3.3.3).
    pub fn value(&self, diagnostics: &mut Diagnostics) -> Cow<'a, str> {
        decode(self.raw, self.span, Blanks::Attribute, diagnostics)
    }
}

/// A piece of text.
#[derive(Clone, Copy, Debug)]
pub struct Text<'a> {
    /// The text as it stands in the source, of CDATA what stands inside.
    pub raw: &'a str,
    /// Where it stands.
    pub span: Span,
    /// Whether it is CDATA, in which nothing is a reference.
    pub cdata: bool,
}

impl<'a> Text<'a> {
    /// The text with references resolved and line ends normalised (XML 1.0, 2.11).
    pub fn value(&self, diagnostics: &mut Diagnostics) -> Cow<'a, str> {
        let blanks = if self.cdata { Blanks::Cdata } else { Blanks::Text };
        decode(self.raw, self.span, blanks, diagnostics)
    }
}

/// The attributes of a tag.
#[derive(Clone, Debug)]
pub struct Attributes<'a> {
    rest: &'a str,
    at: u32,
    file: FileId,
    /// Names so far, as far as they are compared, to find one that occurs twice.
    seen: SmallVec<[&'a str; 16]>,
}

impl<'a> Attributes<'a> {
    fn advance(&mut self, count: usize) {
        self.rest = self.rest.get(count..).unwrap_or("");
        self.at += count as u32;
    }

    fn skip_blanks(&mut self) -> usize {
        let count = self.rest.bytes().take_while(|&byte| is_blank(byte)).count();
        self.advance(count);
        count
    }

    fn fail<T>(&mut self, span: Span, message: impl Into<String>) -> Option<Result<T, Error>> {
        self.rest = "";
        Some(Err(Error::new(&codes::MALFORMED_XML, span, message)))
    }

    fn span(&self, length: usize) -> Span {
        Span::new(self.file, self.at, self.at + length as u32)
    }
}

impl<'a> Iterator for Attributes<'a> {
    type Item = Result<Attribute<'a>, Error>;

    fn next(&mut self) -> Option<Self::Item> {
        let blanks = self.skip_blanks();
        if self.rest.is_empty() {
            return None;
        }
        let name = match Name::of(self.rest) {
            Some(name) if blanks > 0 => name,
            _ => return self.no_name(blanks),
        };
        let (full, name_span) = (&self.rest[..name.length], self.span(name.length));
        self.advance(name.length);
        // Hardly anybody puts blanks around the sign.
        if self.rest.starts_with("=\"") {
            self.advance(2);
            return self.value(full, name, name_span, b'"');
        }
        self.skip_blanks();
        if !self.rest.starts_with('=') {
            return self.fail(name_span, format!("the attribute `{}` has no value", brief(full)));
        }
        self.advance(1);
        self.skip_blanks();
        let Some(quote @ (b'"' | b'\'')) = self.rest.bytes().next() else {
            return self.fail(name_span, format!("the value of `{}` isn't in quotation marks", brief(full)));
        };
        self.advance(1);
        self.value(full, name, name_span, quote)
    }
}

impl<'a> Attributes<'a> {
    /// The attribute whose value starts here, behind its quotation mark.
    fn value(&mut self, full: &'a str, name: Name, name_span: Span, quote: u8) -> Option<Result<Attribute<'a>, Error>> {
        let Some(length) = short_search(quote, self.rest.as_bytes()) else {
            return self.fail(name_span, format!("the value of `{}` has no closing quotation mark", brief(full)));
        };
        let (raw, span) = (&self.rest[..length], self.span(length));
        self.advance(length + 1);
        if self.seen.contains(&full) {
            return self.fail(name_span, format!("the attribute `{}` occurs twice", brief(full)));
        }
        if self.seen.len() < limits::MAX_COMPARED_EXTENSIONS {
            self.seen.push(full);
        }
        let (prefix, name) = match name.colon {
            Some(colon) => (&full[..colon], &full[colon + 1..]),
            None => ("", full),
        };
        Some(Ok(Attribute { name, prefix, raw, name_span, span }))
    }

    fn no_name(&mut self, blanks: usize) -> Option<Result<Attribute<'a>, Error>> {
        let length = self.rest.bytes().take_while(|&byte| !is_blank(byte) && byte != b'=').count();
        if blanks == 0 {
            return self.fail(self.span(length), "there is no blank in front of this attribute");
        }
        self.fail(self.span(length.max(1)), "this is no name of an attribute")
    }
}

/// How long a name is, and where its prefix ends.
#[derive(Clone, Copy)]
struct Name {
    length: usize,
    colon: Option<usize>,
}

impl Name {
    /// The name at the start of `text`, up to a blank or `=`; `None` where that can't be one.
    fn of(text: &str) -> Option<Self> {
        let bytes = text.as_bytes();
        let is_start = |byte: u8| byte.is_ascii_alphabetic() || byte >= 0x80 || matches!(byte, b'_' | b':');
        if !bytes.first().copied().is_some_and(is_start) {
            return None;
        }
        let (mut length, mut colon) = (0, None);
        for &byte in bytes {
            match byte {
                b'=' | b' ' | b'\t' | b'\n' | b'\r' => break,
                b'"' | b'\'' | b'<' | b'&' => return None,
                b':' if colon.is_none() => colon = Some(length),
                _ => {}
            }
            length += 1;
        }
        Some(Name { length, colon })
    }
}

/// Where a byte occurs first: mostly so near that a search that has to be set up would take longer than a loop.
fn short_search(byte: u8, bytes: &[u8]) -> Option<usize> {
    const NEAR: usize = 16;
    let near = &bytes[..bytes.len().min(NEAR)];
    match near.iter().position(|&other| other == byte) {
        None if bytes.len() > NEAR => memchr(byte, &bytes[NEAR..]).map(|at| at + NEAR),
        found => found,
    }
}

/// All text of one element.
#[derive(Clone, Debug, Default)]
pub struct Content<'a> {
    /// The text without blanks around it.
    pub text: Cow<'a, str>,
    /// Where it stands, from its first piece to its last.
    pub span: Span,
}

/// Reads a document from its start to its end.
pub struct Cursor<'a> {
    reader: Reader<&'a [u8]>,
    text: &'a str,
    /// Where the reader started in `text`.
    base: usize,
    file: FileId,
    /// Names of the open elements with their prefixes, the root first.
    open: Vec<&'a str>,
    /// The last start tag was that of an empty element, whose end is still to come.
    empty: bool,
    root_seen: bool,
    /// Number of the line that contains the byte `line_at`.
    line: u32,
    line_at: usize,
}

impl<'a> Cursor<'a> {
    /// A cursor before the first element of `text`.
    pub fn new(text: &'a str, file: FileId) -> Self {
        let base = text.len() - text.trim_start_matches('\u{feff}').len();
        Cursor::start(text, base, file, 1)
    }

    /// A cursor before the element whose start tag stands at `origin`, to read it once more. The cursor knows nothing
    /// of the elements around it.
    pub fn resume(text: &'a str, origin: Origin) -> Self {
        let at = (origin.span.start as usize).min(text.len());
        let at = if text.is_char_boundary(at) { at } else { text.len() };
        Cursor::start(text, at, origin.span.file, origin.line)
    }

    fn start(text: &'a str, base: usize, file: FileId, line: u32) -> Self {
        let mut reader = Reader::from_str(&text[base..]);
        let config = reader.config_mut();
        // Names of end tags are compared here, where the open elements are known by their place.
        config.check_end_names = false;
        config.allow_unmatched_ends = true;
        config.allow_dangling_amp = true;
        // Blanks in front of a tag are no event of their own.
        config.trim_text_start = true;
        Cursor { reader, text, base, file, open: Vec::new(), empty: false, root_seen: false, line, line_at: base }
    }

    /// The next event, or `None` at the end of the document.
    ///
    /// # Errors
    ///
    /// When the document isn't well formed, or nested deeper than [`limits::MAX_XML_DEPTH`]. Nothing can be read then.
    pub fn read(&mut self) -> Result<Option<Event<'a>>, Error> {
        if std::mem::take(&mut self.empty) {
            self.open.pop();
            return Ok(Some(Event::End));
        }
        loop {
            let start = self.position();
            let event = match self.reader.read_event() {
                Ok(event) => event,
                Err(error) => return Err(self.broken(error)),
            };
            let end = self.position();
            match event {
                // Blanks may stand between `start` and the tag.
                Raw::Start(tag) => return self.open(end - tag.len() - 2, end, false).map(Some),
                Raw::Empty(tag) => return self.open(end - tag.len() - 3, end, true).map(Some),
                Raw::End(_) => return self.close(self.markup(start), end).map(Some),
                Raw::Text(_) | Raw::GeneralRef(_) => {
                    if let Some(text) = self.text_run(start, end)? {
                        return Ok(Some(Event::Text(text)));
                    }
                }
                Raw::CData(data) => {
                    let start = end - data.len() - 12;
                    let span = self.span(start + 9, end - 3);
                    let text = Text { raw: &self.text[start + 9..end - 3], span, cdata: true };
                    self.inside(span)?;
                    return Ok(Some(Event::Text(text)));
                }
                Raw::Eof => return self.finish().map(|()| None),
                Raw::Comment(_) | Raw::Decl(_) | Raw::PI(_) | Raw::DocType(_) => {}
            }
        }
    }

    /// Reads up to the root element.
    ///
    /// # Errors
    ///
    /// As [`Cursor::read`]; a document without any element isn't well formed.
    pub fn root(&mut self) -> Result<Tag<'a>, Error> {
        while let Some(event) = self.read()? {
            if let Event::Start(tag) = event {
                return Ok(tag);
            }
        }
        Err(self.no_root())
    }

    /// The next child of the open element `parent`, or `None` once `parent` has ended. What of the last child was not
    /// read is passed over.
    ///
    /// # Errors
    ///
    /// As [`Cursor::read`].
    pub fn child(&mut self, parent: &Tag<'a>) -> Result<Option<Tag<'a>>, Error> {
        while self.open.len() >= parent.depth {
            match self.read()? {
                Some(Event::Start(tag)) if tag.depth == parent.depth + 1 => return Ok(Some(tag)),
                Some(_) => {}
                None => break,
            }
        }
        Ok(None)
    }

    /// Reads the open element `tag` to its end and gives its own text; that of its children is passed over.
    ///
    /// # Errors
    ///
    /// As [`Cursor::read`].
    pub fn content(&mut self, tag: &Tag<'a>, diagnostics: &mut Diagnostics) -> Result<Content<'a>, Error> {
        let mut text: Cow<'a, str> = Cow::Borrowed("");
        let mut span = Span::default();
        while self.open.len() >= tag.depth {
            match self.read()? {
                Some(Event::Text(piece)) if self.open.len() == tag.depth => {
                    let value = piece.value(diagnostics);
                    span = if span.is_empty() { piece.span } else { Span { end: piece.span.end, ..span } };
                    if text.is_empty() {
                        text = value
                    } else {
                        text.to_mut().push_str(&value)
                    }
                }
                Some(_) => {}
                None => break,
            }
        }
        let blank = |c: char| c.is_ascii_whitespace();
        let text = match text {
            Cow::Borrowed(text) => Cow::Borrowed(text.trim_matches(blank)),
            Cow::Owned(text) if text.starts_with(blank) || text.ends_with(blank) => {
                Cow::Owned(text.trim_matches(blank).to_owned())
            }
            owned => owned,
        };
        Ok(Content { text, span: self.trimmed(span) })
    }

    /// Reads the open element `tag` to its end.
    ///
    /// # Errors
    ///
    /// As [`Cursor::read`].
    pub fn skip(&mut self, tag: &Tag<'a>) -> Result<(), Error> {
        while self.open.len() >= tag.depth && self.read()?.is_some() {}
        Ok(())
    }

    /// How many elements are open.
    pub fn depth(&self) -> usize {
        self.open.len()
    }

    /// How far the document was read, in bytes.
    pub fn offset(&self) -> u32 {
        self.position() as u32
    }

    /// The names of the open elements without their prefixes, the root first.
    pub fn path(&self) -> impl DoubleEndedIterator<Item = &'a str> + '_ {
        self.open.iter().map(|full| split_name(full).1)
    }

    /// The names of the two innermost open elements, `parent/own`, shortened where they are very long.
    pub fn innermost(&self) -> CompactString {
        let mut path = self.path().rev();
        let own = path.next().map_or("", brief);
        match path.next() {
            Some(parent) => format_compact!("{}/{own}", brief(parent)),
            None => own.into(),
        }
    }

    /// Line and place of a start tag.
    pub fn origin(&mut self, tag: &Tag<'a>) -> Origin {
        Origin { span: tag.span, line: self.line(tag.span.start) }
    }

    /// The line of a byte of the document, counted from 1. Cheap as long as one asks from top to bottom.
    pub fn line(&mut self, offset: u32) -> u32 {
        let offset = (offset as usize).min(self.text.len());
        let (from, to) = (self.line_at.min(offset), self.line_at.max(offset));
        let bytes = self.text.as_bytes();
        let passed = &bytes[from..to];
        // Counting is much faster than looking at each, and CR LF is one end.
        let mut ends = memchr_iter(b'\n', passed).count() as u32;
        if memchr(b'\r', passed).is_some() {
            ends += memchr_iter(b'\r', passed).filter(|at| bytes.get(from + at + 1) != Some(&b'\n')).count() as u32;
        }
        self.line = if offset >= self.line_at { self.line + ends } else { self.line - ends };
        self.line_at = offset;
        self.line
    }

    /// Where the markup begins that follows the blanks at `start`.
    fn markup(&self, start: usize) -> usize {
        let rest = self.text.as_bytes().get(start..).unwrap_or(&[]);
        start + rest.iter().take_while(|&&byte| is_blank(byte)).count()
    }

    fn position(&self) -> usize {
        self.base + self.reader.buffer_position() as usize
    }

    fn span(&self, start: usize, end: usize) -> Span {
        Span::new(self.file, start as u32, end as u32)
    }

    /// The last character that was read.
    fn here(&self) -> Span {
        let end = (0..=self.position().min(self.text.len())).rev().find(|&end| self.text.is_char_boundary(end));
        let end = end.unwrap_or(0);
        let start = self.text[..end].char_indices().next_back().map_or(0, |(start, _)| start);
        self.span(start, end)
    }

    fn open(&mut self, start: usize, end: usize, empty: bool) -> Result<Event<'a>, Error> {
        let inner = &self.text[start + 1..end - if empty { 2 } else { 1 }];
        let length = inner.bytes().position(is_blank).unwrap_or(inner.len());
        let (full, attributes) = inner.split_at(length);
        let span = self.span(start, end);
        if !is_name(full) || (!attributes.is_empty() && memchr(b'<', attributes.as_bytes()).is_some()) {
            let at = self.span(start, start + 1 + length.max(1));
            return Err(Error::new(&codes::MALFORMED_XML, at, "this is no start tag"));
        }
        if self.open.is_empty() && std::mem::replace(&mut self.root_seen, true) {
            let message = format!("<{}> is a second root element", brief(full));
            return Err(Error::new(&codes::MALFORMED_XML, span, message));
        }
        if self.open.len() >= limits::MAX_XML_DEPTH {
            let message = format!("elements are nested deeper than {}", limits::MAX_XML_DEPTH);
            return Err(Error::new(&codes::INPUT_TOO_LARGE, span, message));
        }
        self.open.push(full);
        self.empty = empty;
        let (prefix, name) = split_name(full);
        let attributes_at = (start + 1 + length) as u32;
        Ok(Event::Start(Tag { name, prefix, span, depth: self.open.len(), empty, attributes, attributes_at }))
    }

    fn close(&mut self, start: usize, end: usize) -> Result<Event<'a>, Error> {
        let name = self.text[start + 2..end - 1].trim_ascii_end();
        match self.open.last() {
            Some(&open) if open == name => {
                self.open.pop();
                Ok(Event::End)
            }
            Some(&open) => {
                let message = format!("`</{}>` ends no element; <{}> is open", brief(name), brief(open));
                let error = Error::new(&codes::MALFORMED_XML, self.span(start, end), message);
                Err(Error(Box::new(error.0.note_at(self.span_of(open), "it starts here"))))
            }
            None => {
                let message = format!("`</{}>` ends no element", brief(name));
                Err(Error::new(&codes::MALFORMED_XML, self.span(start, end), message))
            }
        }
    }

    /// Text up to the next tag; references come as events of their own and are taken together with it.
    fn text_run(&mut self, start: usize, mut end: usize) -> Result<Option<Text<'a>>, Error> {
        // Blanks in front of a tag come with the event of that tag, which isn't to be read here.
        while self.text.as_bytes().get(self.markup(end)).is_some_and(|&byte| byte != b'<') {
            if let Err(error) = self.reader.read_event() {
                return Err(self.broken(error));
            }
            let before = std::mem::replace(&mut end, self.position());
            if end == before {
                break;
            }
        }
        let end = self.markup(end);
        let raw = &self.text[start..end];
        if raw.bytes().all(is_blank) {
            return Ok(None);
        }
        let span = self.span(start, end);
        self.inside(span)?;
        Ok(Some(Text { raw, span, cdata: false }))
    }

    /// Text stands in an element.
    fn inside(&self, span: Span) -> Result<(), Error> {
        if self.open.is_empty() {
            let span = self.trimmed(span);
            return Err(Error::new(&codes::MALFORMED_XML, span, "this text stands outside of the root element"));
        }
        Ok(())
    }

    fn finish(&self) -> Result<(), Error> {
        if !self.root_seen {
            return Err(self.no_root());
        }
        let Some(&open) = self.open.last() else { return Ok(()) };
        let message = format!("the file ends within <{}>", brief(open));
        let error = Error::new(&codes::MALFORMED_XML, self.here(), message);
        Err(Error(Box::new(error.0.note_at(self.span_of(open), "the element starts here"))))
    }

    fn no_root(&self) -> Error {
        Error::new(&codes::MALFORMED_XML, self.here(), "the file has no root element")
    }

    fn broken(&self, error: quick_xml::Error) -> Error {
        let at = (self.base + self.reader.error_position() as usize).min(self.text.len());
        let length = self.text.get(at..).and_then(|rest| rest.chars().next()).map_or(0, char::len_utf8);
        let span = if length == 0 { self.here() } else { self.span(at, at + length) };
        Error::new(&codes::MALFORMED_XML, span, error.to_string())
    }

    /// Where a part of the document stands.
    fn span_of(&self, part: &str) -> Span {
        let start = (part.as_ptr() as usize).wrapping_sub(self.text.as_ptr() as usize);
        self.span(start, start + part.len())
    }

    fn trimmed(&self, span: Span) -> Span {
        let Some(text) = self.text.get(span.range()) else { return span };
        let start = text.len() - text.trim_start().len();
        let kept = text.trim().len();
        let start = span.start + if kept == 0 { 0 } else { start as u32 };
        Span { start, end: start + kept as u32, ..span }
    }
}

/// How blanks are normalised.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Blanks {
    /// Line ends become LF.
    Text,
    /// The same, and nothing is a reference.
    Cdata,
    /// Each blank and each line end becomes a space.
    Attribute,
}

fn decode<'a>(raw: &'a str, span: Span, blanks: Blanks, diagnostics: &mut Diagnostics) -> Cow<'a, str> {
    let bytes = raw.as_bytes();
    let first = match blanks {
        Blanks::Attribute if has_no_marks(bytes) => None,
        Blanks::Attribute => bytes.iter().position(|byte| matches!(byte, b'&' | b'\n' | b'\t' | b'\r')),
        Blanks::Text => memchr2(b'&', b'\r', bytes),
        Blanks::Cdata => memchr(b'\r', bytes),
    };
    let Some(first) = first else { return Cow::Borrowed(raw) };
    let mut value = String::with_capacity(raw.len());
    value.push_str(&raw[..first]);
    let mut rest = &raw[first..];
    while let Some(c) = rest.chars().next() {
        let mut length = c.len_utf8();
        match c {
            '&' if blanks != Blanks::Cdata => {
                let (text, consumed) = reference_at(rest);
                length = consumed;
                match text {
                    Some(c) => value.push(c),
                    None => {
                        unknown_reference(&rest[..consumed], span, raw.len() - rest.len(), diagnostics);
                        value.push_str(&rest[..consumed]);
                    }
                }
            }
            '\r' => {
                length += usize::from(rest[1..].starts_with('\n'));
                value.push(if blanks == Blanks::Attribute { ' ' } else { '\n' });
            }
            '\n' | '\t' if blanks == Blanks::Attribute => value.push(' '),
            other => value.push(other),
        }
        rest = &rest[length..];
    }
    Cow::Owned(value)
}

/// Whether there is neither a reference nor a control character: a loop without an exit, which runs on whole vectors.
fn has_no_marks(bytes: &[u8]) -> bool {
    bytes.iter().fold(true, |none, &byte| none & (byte >= b' ') & (byte != b'&'))
}

/// The longest name of an entity that is looked for behind an `&`.
const MAX_ENTITY_NAME: usize = 64;

/// The character that the reference at the start of `text` stands for, and how long the reference is.
fn reference_at(text: &str) -> (Option<char>, usize) {
    let name = text[1..].bytes().take(MAX_ENTITY_NAME).position(|byte| !byte.is_ascii_alphanumeric() && byte != b'#');
    let Some(length) = name.filter(|&length| length > 0 && text.as_bytes()[1 + length] == b';') else {
        return (None, 1);
    };
    let name = &text[1..1 + length];
    let number = |digits: &str, radix| {
        let code = if digits.starts_with('+') { None } else { u32::from_str_radix(digits, radix).ok() };
        code.and_then(char::from_u32).filter(|&c| c >= ' ' || matches!(c, '\t' | '\n' | '\r'))
    };
    let c = match name {
        "amp" => Some('&'),
        "lt" => Some('<'),
        "gt" => Some('>'),
        "quot" => Some('"'),
        "apos" => Some('\''),
        _ => match name.strip_prefix("#x") {
            Some(digits) => number(digits, 16),
            None => name.strip_prefix('#').and_then(|digits| number(digits, 10)),
        },
    };
    (c, length + 2)
}

fn unknown_reference(reference: &str, span: Span, offset: usize, diagnostics: &mut Diagnostics) {
    let start = span.start + offset as u32;
    let span = Span::new(span.file, start, start + reference.len() as u32);
    let message = match reference {
        "&" => "a `&` that starts no reference".to_owned(),
        _ => format!("`{reference}` is no entity of XML"),
    };
    diagnostics.push(
        Diagnostic::new(&codes::ENTITY_REFERENCE, span, message)
            .label("kept as text")
            .help("write `&amp;` for the character `&`"),
    );
}

fn is_blank(byte: u8) -> bool {
    matches!(byte, b' ' | b'\t' | b'\n' | b'\r')
}

/// Whether this can be a name. Only its first character and what would be another token are looked at.
fn is_name(text: &str) -> bool {
    let starts = text
        .bytes()
        .next()
        .is_some_and(|byte| byte.is_ascii_alphabetic() || byte >= 0x80 || matches!(byte, b'_' | b':'));
    starts && !text.bytes().any(|byte| matches!(byte, b'"' | b'\'' | b'<' | b'&' | b'='))
}

/// Prefix and name.
fn split_name(full: &str) -> (&str, &str) {
    // Names are short: a loop is faster than a search that has to be set up.
    match full.bytes().position(|byte| byte == b':') {
        Some(at) => (&full[..at], &full[at + 1..]),
        None => ("", full),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cursor(text: &str) -> Cursor<'_> {
        Cursor::new(text, FileId(0))
    }

    /// Events in short: `+name`, `-`, `"text"`.
    fn events(text: &str) -> Result<Vec<String>, Error> {
        let mut cursor = cursor(text);
        let mut list = Vec::new();
        while let Some(event) = cursor.read()? {
            list.push(match event {
                Event::Start(tag) => {
                    for attribute in tag.attributes() {
                        attribute?;
                    }
                    format!("+{}", tag.name)
                }
                Event::End => "-".into(),
                Event::Text(text) => format!("{:?}", text.value(&mut Diagnostics::default())),
            });
        }
        Ok(list)
    }

    fn error(text: &str) -> (&'static str, String) {
        let diagnostic = events(text).expect_err(text).into_diagnostic();
        (diagnostic.code.id, text[diagnostic.span.range()].to_owned())
    }

    #[test]
    fn blanks_around_references_and_comments() {
        // An element behind a reference and a blank is an element, and blanks within a text are its own.
        assert!(events("<a>x&amp; <b/></a>").unwrap().iter().any(|event| event.contains('b')));
        let content = |text: &'static str| {
            let mut cursor = cursor(text);
            let root = cursor.root().unwrap();
            cursor.content(&root, &mut Diagnostics::default()).unwrap().text.into_owned()
        };
        assert_eq!(content("<a> x &amp; y <!-- --> z </a>"), "x & y  z");
        assert_eq!(content("<a> &lt; <!-- --> &gt; </a>"), "<  >");
        assert_eq!(content("<a>\n <![CDATA[ x ]]>\n</a>"), "x");
        assert_eq!(content("<a>&amp;  </a>"), "&");
    }

    #[test]
    fn elements_text_and_what_is_passed_over() {
        let text = "\u{feff}<?xml version='1.0'?><!DOCTYPE r [<!ENTITY e 'x'>]>\n<r>\n <!-- c --> <p:a/>t<?pi x?>u<b >v</b\n></r>\n";
        let expected = ["+r", "+a", "-", "\"t\"", "\"u\"", "+b", "\"v\"", "-", "-"];
        assert_eq!(events(text).unwrap(), expected);
        assert_eq!(
            events("<r>a&amp;b<![CDATA[<&amp;>\r\n]]>&#x41;</r>").unwrap()[1..4],
            ["\"a&b\"", "\"<&amp;>\\n\"", "\"A\""]
        );
    }

    #[test]
    fn spans_point_at_names_and_values() {
        let text = "<r>\r\n<n:a x = \"1\" n:yy='&lt;2'>  text </n:a>\r<b/></r>";
        let mut cursor = cursor(text);
        let root = cursor.root().unwrap();
        let a = cursor.child(&root).unwrap().unwrap();
        assert_eq!((a.name, a.prefix, a.depth, &text[a.name_span().range()]), ("a", "n", 2, "n:a"));
        assert!(text[a.span.range()].starts_with("<n:a") && text[a.span.range()].ends_with("2'>"));
        let attributes: Vec<_> = a.attributes().map(Result::unwrap).collect();
        assert_eq!(attributes.iter().map(|a| &text[a.name_span.range()]).collect::<Vec<_>>(), ["x", "n:yy"]);
        assert_eq!(attributes.iter().map(|a| &text[a.span.range()]).collect::<Vec<_>>(), ["1", "&lt;2"]);
        assert_eq!(attributes[1].value(&mut Diagnostics::default()), "<2");
        assert_eq!(a.attribute("yy").unwrap().unwrap().prefix, "n");
        assert_eq!(cursor.path().collect::<Vec<_>>(), ["r", "a"]);
        let content = cursor.content(&a, &mut Diagnostics::default()).unwrap();
        assert_eq!((&*content.text, &text[content.span.range()]), ("text", "text"));
        let b = cursor.child(&root).unwrap().unwrap();
        assert_eq!((cursor.origin(&b).line, cursor.origin(&a).line, cursor.origin(&b).line), (3, 2, 3));
        assert!(b.empty && cursor.child(&b).unwrap().is_none() && cursor.depth() == 1);
        assert!(cursor.child(&root).unwrap().is_none() && cursor.read().unwrap().is_none());
    }

    #[test]
    fn an_element_can_be_read_once_more() {
        let text = "<r><skip>x</skip>\n<a><b/>t</a></r>";
        let mut first = cursor(text);
        let root = first.root().unwrap();
        first.child(&root).unwrap();
        let a = first.child(&root).unwrap().unwrap();
        let mut again = Cursor::resume(text, first.origin(&a));
        let tag = again.root().unwrap();
        assert_eq!((tag.name, tag.span, tag.depth, again.origin(&tag).line), ("a", a.span, 1, 2));
        assert_eq!(again.content(&tag, &mut Diagnostics::default()).unwrap().text, "t");
        assert!(again.child(&tag).unwrap().is_none());
    }

    #[test]
    fn references_are_resolved_or_kept() {
        let mut diagnostics = Diagnostics::default();
        let text = "<r a='&#65;&#x42;&quot;\t&apos;\r\n&gt;' b='&nbsp; &a;b &amp R&D &#0; &#xD800; &#+5; &;'/>";
        let mut cursor = cursor(text);
        let tag = cursor.root().unwrap();
        let mut value = |name: &str| tag.attribute(name).unwrap().unwrap().value(&mut diagnostics).into_owned();
        assert_eq!(value("a"), "AB\" ' >");
        assert_eq!(value("b"), "&nbsp; &a;b &amp R&D &#0; &#xD800; &#+5; &;");
        let found: Vec<_> = diagnostics.list().iter().map(|d| (d.code.id, &text[d.span.range()])).collect();
        let expected = ["&nbsp;", "&a;", "&", "&", "&#0;", "&#xD800;", "&", "&"];
        assert_eq!(found, expected.map(|text| ("XML002", text)));
    }

    #[test]
    fn a_bare_ampersand_is_text() {
        assert_eq!(events("<r>a & b&c</r>").unwrap()[1], "\"a & b&c\"");
        assert_eq!(events("<r>&</r>").unwrap()[1], "\"&\"");
    }

    #[test]
    fn what_is_not_well_formed_is_told_at_its_place() {
        let malformed = |text, place: &str| assert_eq!(error(text), ("XML001", place.to_owned()), "{text}");
        malformed("", "");
        malformed(" <!-- x -->", ">");
        malformed("<r><a></r>", "</r>");
        malformed("<r></r></r>", "</r>");
        malformed("<r/><s/>", "<s/>");
        malformed("<r/> x ", "x");
        malformed("x<r/>", "x");
        malformed("<r><a>x", "x");
        malformed("<r", "<");
        malformed("<r><!-- ", "<");
        malformed("<r><![CDATA[ ", "<");
        malformed("<r a=\"1", "<");
        malformed("<>", "<>");
        malformed("<1/>", "<1");
        malformed("<a <b/>", "<a");
        malformed("<r a=1/>", "a");
        malformed("<r a/>", "a");
        malformed("<r a='1'b='2'/>", "b");
        malformed("<r a='1' a='2'/>", "a");
        malformed("<r ='1'/>", "=");
    }

    #[test]
    fn nesting_is_bounded() {
        let deep = |depth| format!("{}{}", "<a>".repeat(depth), "</a>".repeat(depth));
        assert_eq!(events(&deep(limits::MAX_XML_DEPTH)).unwrap().len(), 2 * limits::MAX_XML_DEPTH);
        assert_eq!(error(&deep(limits::MAX_XML_DEPTH + 1)), ("IO003", "<a>".into()));
        assert_eq!(error(&"<a>".repeat(1_000_000)).0, "IO003");
    }

    #[test]
    fn damage_anywhere_ends_in_an_error_at_worst() {
        let text = "<?xml version='1.0'?><!DOCTYPE r><r a='&lt;'>é&amp;<b/><![CDATA[x]]><!-- c --><c>t</c></r>";
        for at in 0..text.len() {
            let _ = events(text.get(..at).unwrap_or(""));
            for byte in [b'<', b'>', b'&', b'\'', b'/', b'!', b'?', b'-', b']', b' '] {
                let mut bytes = text.as_bytes().to_vec();
                bytes[at] = byte;
                if let Ok(text) = std::str::from_utf8(&bytes) {
                    let _ = events(text);
                }
            }
        }
    }
}
