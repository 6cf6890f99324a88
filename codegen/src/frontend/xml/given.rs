//! A text with its span.

use std::borrow::Cow;

use compact_str::CompactString;

use crate::diagnostics::Diagnostics;
use crate::ir::Extension;
use crate::source::{FileId, Span};
use crate::syntax::xml::Attribute;

/// The value of an attribute or the content of an element, without blanks around it. The span is empty if it is missing.
#[derive(Clone, Debug, Default)]
pub struct Given<'a> {
    /// The text.
    pub text: Cow<'a, str>,
    /// Its span; of an empty attribute that of the quotation marks.
    pub span: Span,
}

impl<'a> Given<'a> {
    /// The value of an attribute, with the blanks around it.
    pub fn of_attribute(attribute: &Attribute<'a>, diagnostics: &mut Diagnostics) -> Self {
        Given { text: attribute.value(diagnostics), span: attribute.marked_span() }
    }

    /// Without the blanks around it.
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

    /// A missing attribute or element.
    pub const fn missing() -> Self {
        Given { text: Cow::Borrowed(""), span: Span::new(FileId(0), 0, 0) }
    }

    /// The span of a part of the text; that of the whole if the text is not as written.
    pub fn span_of(&self, part: &str) -> Span {
        let start = (part.as_ptr() as usize).wrapping_sub(self.text.as_ptr() as usize);
        let is_part = self.text.len().checked_sub(start).is_some_and(|rest| part.len() <= rest);
        if self.text.len() != self.span.range().len() || !is_part {
            return self.span;
        }
        let start = self.span.start + start as u32;
        Span { start, end: start + part.len() as u32, ..self.span }
    }

    /// Whether there is no such attribute or element.
    pub fn is_missing(&self) -> bool {
        self.span.is_empty()
    }

    /// Whether it is missing or empty.
    pub fn is_empty(&self) -> bool {
        self.text.is_empty()
    }

    /// `None` if it is missing or empty.
    pub fn non_empty(&self) -> Option<&Self> {
        (!self.is_empty()).then_some(self)
    }

    /// The same as an extension; `None` if it is missing.
    pub fn extension(&self, key: &str) -> Option<Extension> {
        let extension = || Extension { key: key.into(), value: self.compact(), span: self.span };
        (!self.is_missing()).then(extension)
    }

    /// The same as an attribute; `None` if it is missing.
    pub fn attribute(&self, key: &str) -> Option<(CompactString, CompactString)> {
        (!self.is_missing()).then(|| (key.into(), self.compact()))
    }

    /// The text.
    pub fn compact(&self) -> CompactString {
        CompactString::from(self.text.as_ref())
    }
}
