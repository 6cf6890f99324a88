//! Events of a document, and the error that ends reading.

use std::borrow::Cow;

use super::attributes::{Attribute, Attributes};
use super::decode::{decode, Blanks};
use crate::diagnostics::{Code, Diagnostic, Diagnostics};
use crate::source::Span;

/// Error that stops reading: the document is not well-formed or is nested too deeply.
#[derive(Clone, Debug)]
pub struct Error(Box<Diagnostic>);

impl Error {
    pub(super) fn new(code: &'static Code, span: Span, message: impl Into<String>) -> Self {
        Error(Box::new(code.at(span, message)))
    }

    pub(super) fn note_at(self, span: Span, message: &str) -> Self {
        Error(Box::new(self.0.note_at(span, message)))
    }

    /// Returns the diagnostic that describes the error.
    pub fn into_diagnostic(self) -> Diagnostic {
        *self.0
    }
}

impl From<Error> for Box<Diagnostic> {
    fn from(error: Error) -> Self {
        error.0
    }
}

/// An event of the document.
#[derive(Clone, Copy, Debug)]
pub enum Event<'a> {
    /// Start of an element. The end of an `<empty/>` element is the next event.
    Start(Tag<'a>),
    /// End of the innermost open element.
    End,
    /// Text or CDATA. Comments, processing instructions and CDATA sections divide a text into several events.
    Text(Text<'a>),
}

/// The start tag of an element.
#[derive(Clone, Copy, Debug)]
pub struct Tag<'a> {
    /// Name of the element without its prefix.
    pub name: &'a str,
    /// Prefix of the element name; empty if there is none.
    pub prefix: &'a str,
    /// Span of the tag from `<` to `>`.
    pub span: Span,
    /// Number of open elements, including this element.
    pub depth: u32,
    /// True if the tag is an empty-element tag (`<empty/>`).
    pub empty: bool,
    /// The attributes as written in the file: the text between the name and the end of the tag.
    pub(super) attributes: &'a str,
    pub(super) attributes_at: u32,
}

impl<'a> Tag<'a> {
    /// Returns the attributes in document order, including namespace declarations.
    pub fn attributes(&self) -> Attributes<'a> {
        Attributes::new(self.attributes, self.attributes_at, self.span.file)
    }

    /// Returns whether the tag contains any text after its name, such as attributes.
    pub fn has_attributes(&self) -> bool {
        !self.attributes.is_empty()
    }

    /// Returns the first attribute with this name, with or without a prefix. Ignores attributes with the prefix `xmlns`.
    ///
    /// # Errors
    ///
    /// Returns an error if the tag is not well-formed up to the attribute.
    pub fn attribute(&self, name: &str) -> Result<Option<Attribute<'a>>, Error> {
        for attribute in self.attributes() {
            let attribute = attribute?;
            if attribute.name == name && attribute.prefix != "xmlns" {
                return Ok(Some(attribute));
            }
        }
        Ok(None)
    }

    /// Returns the span of the name with its prefix.
    pub fn name_span(&self) -> Span {
        Span::new(self.span.file, self.span.start + 1, self.attributes_at)
    }
}

/// A piece of text in an element.
#[derive(Clone, Copy, Debug)]
pub struct Text<'a> {
    /// The text as written in the file. For CDATA, the content of the section.
    pub raw: &'a str,
    /// Span of the text.
    pub span: Span,
    /// True if the text is CDATA, which contains no references.
    pub cdata: bool,
}

impl<'a> Text<'a> {
    /// Returns the text with references resolved and line ends normalized (XML 1.0, 2.11). Reports invalid and unknown references
    /// as diagnostics, and keeps them as text. CDATA contains no references.
    pub fn value(&self, diagnostics: &mut Diagnostics) -> Cow<'a, str> {
        let blanks = if self.cdata { Blanks::Cdata } else { Blanks::Text };
        decode(self.raw, self.span, blanks, diagnostics)
    }
}
