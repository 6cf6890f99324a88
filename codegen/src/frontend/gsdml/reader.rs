//! The state of reading one file, and what many elements have: identifiers, references to texts, required attributes.

use super::links::{Kind, Links};
use super::text_references::TextReferences;
use super::types::Types;
use crate::diagnostics::{codes, Code, Diagnostic};
use crate::frontend::xml::{self, Given, Read};
use crate::ir::{CompactString, Documentation, Item};
use crate::syntax::xml::Tag;
use crate::text::brief;

pub(super) type Reader<'a, 'd> = xml::Reader<'a, 'd, Gsdml<'a>>;

/// What the reader of GSDML has beyond the base.
#[derive(Default)]
pub(super) struct Gsdml<'a> {
    /// References to texts, which are at the end of the file.
    pub texts: TextReferences<'a>,
    /// Types of the catalogue so far.
    pub types: Types<'a>,
    /// Elements by their identifiers, and references to them.
    pub links: Links<'a>,
    /// Space for the parameters of a record, which is used again for the next one.
    pub items: Vec<Item>,
}

impl xml::Format for Gsdml<'_> {
    const STANDARD: &'static str = "GSDML V2.35";
    const UNKNOWN: &'static Code = &codes::UNKNOWN_GSDML_ELEMENT;
    const VALUE: &'static Code = &codes::GSDML_VALUE;
    const CASE: Option<&'static Code> = Some(&codes::ATTRIBUTE_CASE);
    const EMPTY_IS_MISSING: bool = false;
}

impl<'a> Reader<'a, '_> {
    /// Reports that an attribute or a child of `tag` is missing.
    pub fn missing(&mut self, tag: &Tag<'_>, what: &str, label: impl Into<String>) {
        let message = format!("<{}> has no {what}", brief(tag.name));
        self.report(&codes::GSDML_MISSING, tag.name_span(), message, label);
    }

    /// Whether a required attribute is given; reports it if not.
    pub fn require(&mut self, tag: &Tag<'_>, given: &Given<'_>, name: &str, label: &str) -> bool {
        if given.is_missing() {
            self.missing(tag, name, label);
        }
        !given.is_missing()
    }

    /// The required attribute `name` of an element that has nothing else to say.
    pub fn single(&mut self, tag: &Tag<'a>, name: &str) -> Read<Given<'a>> {
        let given = self.attribute(tag, name)?;
        self.require(tag, &given, name, "left empty");
        Ok(given)
    }

    /// The placeholder of the text of an element that has to have one.
    pub fn name(&mut self, tag: &Tag<'a>, given: Given<'a>) -> CompactString {
        if given.is_missing() {
            let message = format!("<{}> has no TextId, and so no name", tag.name);
            self.report(&codes::MISSING_TEXT, tag.name_span(), message, "its name is left empty");
            return CompactString::default();
        }
        self.format.texts.hold(given)
    }

    /// The placeholder of the text of an element that has nothing but a `TextId`.
    pub fn text_reference(&mut self, tag: &Tag<'a>) -> Read<CompactString> {
        let given = self.attribute(tag, "TextId")?;
        Ok(self.name(tag, given))
    }

    /// The same as documentation.
    pub fn documentation(&mut self, tag: &Tag<'a>) -> Read<Option<Box<Documentation>>> {
        let text = self.text_reference(tag)?.into();
        Ok(Some(Box::new(Documentation { text, ..Documentation::default() })))
    }

    /// Registers the identifier of the element `tag` of this kind, which is at `position` in the catalogue. The first element with
    /// an identifier counts.
    pub fn register(&mut self, tag: &Tag<'a>, kind: Kind, id: &Given<'a>, position: usize) {
        if id.is_missing() {
            // Interfaces and ports of V2.0 have none, and nothing refers to them.
            if kind != Kind::BuiltIn || tag.name == "VirtualSubmoduleItem" {
                self.missing(tag, "ID", "nothing can refer to it");
            }
            return;
        }
        if let Some(first) = self.format.links.register(kind, id, position) {
            let message = format!("a <{}> with the ID `{}` exists already", brief(tag.name), brief(&id.text));
            let diagnostic = Diagnostic::new(&codes::DUPLICATE_ID, id.span, message);
            self.diagnostics.push(diagnostic.label("references lead to the first one").note_at(first, "the first one"));
        }
    }
}
