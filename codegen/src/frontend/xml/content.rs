//! Reads the text content of elements.

use std::borrow::Cow;

use super::reader::{Format, Read, Reader};
use super::Given;
use crate::diagnostics::Diagnostics;
use crate::source::Span;
use crate::syntax::xml::{Event, Tag, Text};

impl<'a, F: Format> Reader<'a, '_, F> {
    /// Reads an element that should contain only text, up to its end tag. Attributes and child elements become
    /// extensions.
    pub fn text(&mut self, tag: &Tag<'a>) -> Read<Given<'a>> {
        self.keep_attributes(tag)?;
        self.content()
    }

    /// Reads the content of an element up to its end tag. The attributes must already have been read.
    pub fn content(&mut self) -> Read<Given<'a>> {
        let mut given = Given::default();
        if let Some(piece) = self.cursor.only_text() {
            given.add(&piece, self.diagnostics);
            return Ok(given.finish());
        }
        loop {
            match self.cursor.read()? {
                Some(Event::Text(piece)) => given.add(&piece, self.diagnostics),
                Some(Event::Start(inner)) => self.unknown(&inner)?,
                Some(Event::End) | None => return Ok(given.finish()),
            }
        }
    }
}

impl<'a> Given<'a> {
    /// Adds a piece of the content. Comments and CDATA sections divide the content of an element into pieces.
    fn add(&mut self, piece: &Text<'a>, diagnostics: &mut Diagnostics) {
        let value = piece.value(diagnostics);
        if !self.span.is_empty() {
            self.text.to_mut().push_str(&value);
            self.span.end = piece.span.end;
            return;
        }
        let from_start = piece.raw.trim_ascii_start();
        let trimmed = from_start.trim_ascii_end();
        let start = piece.span.start + (piece.raw.len() - from_start.len()) as u32;
        self.span = Span { start, end: start + trimmed.len() as u32, ..piece.span };
        self.text = match value {
            Cow::Borrowed(_) => Cow::Borrowed(trimmed),
            Cow::Owned(text) => Cow::Owned(text.trim_ascii_start().to_owned()),
        };
    }

    /// Removes white space at the end of the content.
    fn finish(mut self) -> Self {
        if let Cow::Owned(text) = &mut self.text {
            text.truncate(text.trim_ascii_end().len());
        }
        self
    }
}
