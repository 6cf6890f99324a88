//! Text of an attribute or element, with its span.

use std::borrow::Cow;

use compact_str::CompactString;

use crate::diagnostics::Diagnostics;
use crate::ir::Extension;
use crate::source::{FileId, Span};
use crate::syntax::xml::Attribute;

/// Value of an attribute, or text of an element. The span is empty if the attribute or element is missing, or if the
/// element has no text.
#[derive(Clone, Debug, Default)]
pub struct Given<'a> {
    /// Text of the attribute or element.
    pub text: Cow<'a, str>,
    /// Span of the text. The span of an empty attribute includes only its quotation marks.
    pub span: Span,
}

impl<'a> Given<'a> {
    /// Returns the value of an attribute, including surrounding white space.
    pub fn of_attribute(attribute: &Attribute<'a>, diagnostics: &mut Diagnostics) -> Self {
        Given { text: attribute.value(diagnostics), span: attribute.marked_span() }
    }

    /// Removes surrounding white space from the text. The span stays the same.
    #[inline]
    pub fn trimmed(self) -> Self {
        let is_blank = |byte: Option<&u8>| byte.is_some_and(u8::is_ascii_whitespace);
        if !is_blank(self.text.as_bytes().first()) && !is_blank(self.text.as_bytes().last()) {
            return self;
        }
        let text = match self.text {
            Cow::Borrowed(text) => Cow::Borrowed(text.trim_ascii()),
            Cow::Owned(text) => Cow::Owned(text.trim_ascii().to_owned()),
        };
        Given { text, span: self.span }
    }

    /// Returns the text of a missing attribute or element.
    pub const fn missing() -> Self {
        Given { text: Cow::Borrowed(""), span: Span::new(FileId(0), 0, 0) }
    }

    /// Returns the span of `part`, which must be a slice of the text. For decoded text, returns the span of the whole
    /// text.
    pub fn span_of(&self, part: &str) -> Span {
        let start = (part.as_ptr() as usize).wrapping_sub(self.text.as_ptr() as usize);
        let is_part = self.text.len().checked_sub(start).is_some_and(|rest| part.len() <= rest);
        if self.text.len() != self.span.range().len() || !is_part {
            return self.span;
        }
        let start = self.span.start + start as u32;
        Span { start, end: start + part.len() as u32, ..self.span }
    }

    /// Returns whether the attribute is missing, or the element is missing or has no text.
    pub fn is_missing(&self) -> bool {
        self.span.is_empty()
    }

    /// Returns whether the text is missing or empty.
    pub fn is_empty(&self) -> bool {
        self.text.is_empty()
    }

    /// Returns the text, or `None` if the text is missing or empty.
    pub fn non_empty(&self) -> Option<&Self> {
        (!self.is_empty()).then_some(self)
    }

    /// Returns the text as an extension with the key `key`, or `None` if the text is missing.
    pub fn extension(&self, key: &str) -> Option<Extension> {
        let extension = || Extension { key: key.into(), value: self.compact(), span: self.span };
        (!self.is_missing()).then(extension)
    }

    /// Returns the text as an attribute with the key `key`, or `None` if the text is missing.
    pub fn attribute(&self, key: &str) -> Option<(CompactString, CompactString)> {
        (!self.is_missing()).then(|| (key.into(), self.compact()))
    }

    /// Returns the text as a `CompactString`.
    pub fn compact(&self) -> CompactString {
        CompactString::from(self.text.as_ref())
    }
}
