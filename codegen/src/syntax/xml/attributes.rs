//! Attributes of a start tag.

use std::borrow::Cow;

use smallvec::SmallVec;

use super::decode::{decode, Blanks};
use super::scan::{is_blank, Name, Value};
use super::Error;
use crate::diagnostics::{codes, Diagnostics};
use crate::limits;
use crate::source::{FileId, Span};
use crate::text::brief;

/// An attribute of a start tag.
#[derive(Clone, Copy, Debug)]
pub struct Attribute<'a> {
    /// Name of the attribute without its prefix.
    pub name: &'a str,
    /// Prefix of the attribute name; empty if there is none.
    pub prefix: &'a str,
    /// Value as written in the file.
    pub raw: &'a str,
    /// Span of the attribute name.
    pub name_span: Span,
    /// Span of the value, without its quotation marks.
    pub span: Span,
    /// True if the value needs no decoding.
    plain: bool,
}

impl<'a> Attribute<'a> {
    /// Returns whether the attribute declares a namespace.
    pub fn is_namespace(&self) -> bool {
        self.prefix == "xmlns" || (self.prefix.is_empty() && self.name == "xmlns")
    }

    /// Returns the span to mark in a diagnostic: the value, or the quotation marks of an empty value.
    pub fn marked_span(&self) -> Span {
        match self.span {
            span if span.is_empty() => Span { start: span.start.saturating_sub(1), end: span.end + 1, ..span },
            span => span,
        }
    }

    /// Returns the value with references resolved and white space normalized (XML 1.0, 3.3.3). Reports invalid and unknown
    /// references as diagnostics, and keeps them as text.
    pub fn value(&self, diagnostics: &mut Diagnostics) -> Cow<'a, str> {
        if self.plain {
            return Cow::Borrowed(self.raw);
        }
        decode(self.raw, self.span, Blanks::Attribute, diagnostics)
    }
}

/// Iterator over the attributes of a start tag. Ends after the first error.
#[derive(Clone, Debug)]
pub struct Attributes<'a> {
    rest: &'a str,
    at: u32,
    file: FileId,
    /// Names of the first attributes of the tag, up to [`limits::MAX_COMPARED_EXTENSIONS`], to detect duplicates.
    seen: SmallVec<[&'a str; 16]>,
    /// Bit mask of the names in `seen`. Each name sets one of 64 bits, which depends on its first byte and its length.
    /// A name whose bit is not set is no duplicate, so `seen` need not be searched.
    marks: u64,
}

impl<'a> Attributes<'a> {
    pub(super) fn new(rest: &'a str, at: u32, file: FileId) -> Self {
        Attributes { rest, at, file, seen: SmallVec::new(), marks: 0 }
    }

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

    #[inline]
    fn next(&mut self) -> Option<Self::Item> {
        let blanks = self.skip_blanks();
        if self.rest.is_empty() {
            return None;
        }
        let Some(name) = Name::of(self.rest).filter(|_| blanks > 0) else { return self.no_name(blanks) };
        let (full, name_span) = (&self.rest[..name.length], self.span(name.length));
        self.advance(name.length);
        // The usual case without white space around the equals sign is handled first.
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
            return self.fail(name_span, format!("the value of `{}` is not in quotation marks", brief(full)));
        };
        self.advance(1);
        self.value(full, name, name_span, quote)
    }
}

impl<'a> Attributes<'a> {
    /// Returns the attribute whose value starts at the current position, after the opening quotation mark.
    #[inline]
    fn value(&mut self, full: &'a str, name: Name, name_span: Span, quote: u8) -> Option<Result<Attribute<'a>, Error>> {
        let Some(Value { length, plain }) = Value::of(quote, self.rest.as_bytes()) else {
            return self.fail(name_span, format!("the value of `{}` has no closing quotation mark", brief(full)));
        };
        let (raw, span) = (&self.rest[..length], self.span(length));
        self.advance(length + 1);
        let mark = 1 << ((usize::from(full.as_bytes()[0]) + 7 * full.len()) % 64);
        if self.marks & mark != 0 && self.seen.contains(&full) {
            return self.fail(name_span, format!("the attribute `{}` occurs twice", brief(full)));
        }
        if self.seen.len() < limits::MAX_COMPARED_EXTENSIONS {
            self.seen.push(full);
            self.marks |= mark;
        }
        let (prefix, name) = name.split(full);
        Some(Ok(Attribute { name, prefix, raw, name_span, span, plain }))
    }

    fn no_name(&mut self, blanks: usize) -> Option<Result<Attribute<'a>, Error>> {
        let length = self.rest.bytes().take_while(|&byte| !is_blank(byte) && byte != b'=').count();
        if blanks == 0 {
            return self.fail(self.span(length), "there is no space before this attribute");
        }
        self.fail(self.span(length.max(1)), "this is not an attribute name")
    }
}
