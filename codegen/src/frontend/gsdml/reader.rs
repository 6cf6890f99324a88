//! The state of reading one file, and the reading of single attributes and of elements that the IR has no field for.

use std::borrow::Cow;

use compact_str::{format_compact, CompactString};

use super::links::Links;
use super::texts::Names;
use super::types::Types;
use crate::diagnostics::{codes, Diagnostic, Diagnostics};
use crate::ir::{Extension, Extensions, Item};
use crate::source::Span;
use crate::syntax::xml::{Attribute, Cursor, Event, Tag};
pub(super) use crate::text::brief as shortened;

/// A result that ends the reading of the file with one diagnostic.
pub(super) type Read<T> = Result<T, Box<Diagnostic>>;

/// Attributes as the source spells them.
pub(super) type Attributes = Vec<(CompactString, CompactString)>;

pub(super) struct Reader<'a, 'd> {
    pub cursor: Cursor<'a>,
    /// The whole file.
    pub text: &'a str,
    pub diagnostics: &'d mut Diagnostics,
    /// References to texts, which stand at the end of the file.
    pub names: Names<'a>,
    /// Types of the catalogue so far.
    pub types: Types<'a>,
    /// Elements by their identifiers, and references to them.
    pub links: Links<'a>,
    /// Parameters of the record that is being read.
    pub items: Vec<Item>,
}

/// What an attribute says, without blanks around it, and where.
#[derive(Clone, Debug)]
pub(super) struct Given<'a> {
    pub text: Cow<'a, str>,
    pub span: Span,
}

impl<'a> Reader<'a, '_> {
    /// The attributes called `names`, by their position there; further ones become extensions.
    pub fn fields<const N: usize>(
        &mut self,
        tag: &Tag<'a>,
        names: &[&str; N],
        extensions: &mut Extensions,
    ) -> Read<[Option<Given<'a>>; N]> {
        self.sorted(tag, names, |reader, attribute| reader.unknown_attribute(tag, attribute, extensions))
    }

    /// The attributes called `names`, by their position there; further ones are kept as attributes of the element.
    pub fn fields_of<const N: usize>(
        &mut self,
        tag: &Tag<'a>,
        names: &[&str; N],
        attributes: &mut Attributes,
    ) -> Read<[Option<Given<'a>>; N]> {
        self.sorted(tag, names, |reader, attribute| {
            let value = attribute.value(reader.diagnostics).into();
            attributes.push((attribute.name.into(), value));
        })
    }

    /// The attributes called `names`; further ones are handed to `other`.
    fn sorted<const N: usize>(
        &mut self,
        tag: &Tag<'a>,
        names: &[&str; N],
        mut other: impl FnMut(&mut Self, &Attribute<'a>),
    ) -> Read<[Option<Given<'a>>; N]> {
        let mut fields = [const { None }; N];
        for attribute in tag.attributes() {
            let attribute = attribute?;
            let at = match names.iter().position(|name| *name == attribute.name) {
                Some(at) => Some(at),
                // Attributes with a prefix are those of XML Schema and of XML itself.
                None if !attribute.prefix.is_empty() || attribute.is_namespace() => continue,
                None => self.misspelt(&attribute, names),
            };
            match at {
                Some(at) => fields[at] = Some(self.given(&attribute)),
                None => other(self, &attribute),
            }
        }
        Ok(fields)
    }

    /// The position of a name that differs from an attribute's in nothing but its case.
    fn misspelt(&mut self, attribute: &Attribute<'a>, names: &[&str]) -> Option<usize> {
        let at = names.iter().position(|name| name.eq_ignore_ascii_case(attribute.name))?;
        let name = names.get(at)?;
        let message = format!("the attribute is called {name}, not {}", attribute.name);
        self.diagnostics.push(
            Diagnostic::new(&codes::ATTRIBUTE_CASE, attribute.name_span, message)
                .label(format!("read as {name}"))
                .fix(*name),
        );
        Some(at)
    }

    fn unknown_attribute(&mut self, tag: &Tag<'a>, attribute: &Attribute<'a>, extensions: &mut Extensions) {
        if self.diagnostics.wants(&codes::UNKNOWN_GSDML_ELEMENT) {
            let message = format!("<{}> has no such attribute in GSDML V2.35", shortened(tag.name));
            self.diagnostics.push(
                Diagnostic::new(&codes::UNKNOWN_GSDML_ELEMENT, attribute.name_span, message)
                    .label("kept as an extension attribute"),
            );
        }
        let value = attribute.value(self.diagnostics).into();
        extensions.push(Extension { key: attribute.name.into(), value, span: attribute.span });
    }

    /// The attribute `name`.
    pub fn field(&mut self, tag: &Tag<'a>, name: &str) -> Read<Option<Given<'a>>> {
        Ok(tag.attribute(name)?.map(|attribute| self.given(&attribute)))
    }

    fn given(&mut self, attribute: &Attribute<'a>) -> Given<'a> {
        let text = match attribute.value(self.diagnostics) {
            Cow::Borrowed(text) => Cow::Borrowed(text.trim_ascii()),
            Cow::Owned(text) => Cow::Owned(text.trim_ascii().to_owned()),
        };
        Given { text, span: attribute.span }
    }

    /// Keeps an element that GSDML doesn't have at this place.
    pub fn unknown(&mut self, tag: &Tag<'a>, extensions: &mut Extensions) -> Read<()> {
        if self.diagnostics.wants(&codes::UNKNOWN_GSDML_ELEMENT) {
            self.diagnostics.push(
                Diagnostic::new(&codes::UNKNOWN_GSDML_ELEMENT, tag.name_span(), "GSDML V2.35 has no such element here")
                    .label("kept as extension attributes"),
            );
        }
        self.keep(tag, extensions)
    }

    /// Keeps the attributes and texts of an element and of those within it as `parent/element@attribute` extensions.
    pub fn keep(&mut self, tag: &Tag<'a>, extensions: &mut Extensions) -> Read<()> {
        self.each_within(tag, |reader, found| {
            let (key, value, span) = match found {
                Found::Attribute(attribute) => {
                    let key = format_compact!("{}@{}", reader.cursor.innermost(), shortened(attribute.name));
                    (key, attribute.value(reader.diagnostics).into(), attribute.span)
                }
                Found::Text(value, span) => (reader.cursor.innermost(), value, span),
                Found::Nothing(span) => (reader.cursor.innermost(), CompactString::default(), span),
            };
            extensions.push(Extension { key, value, span });
        })
    }

    /// Keeps the attributes and texts of an element and of those within it as `element@attribute` attributes.
    pub fn keep_attributes(&mut self, tag: &Tag<'a>, attributes: &mut Attributes) -> Read<()> {
        self.each_within(tag, |reader, found| {
            let own = reader.cursor.path().next_back().map_or("", shortened);
            match found {
                Found::Attribute(attribute) => {
                    let key = format_compact!("{own}@{}", shortened(attribute.name));
                    attributes.push((key, attribute.value(reader.diagnostics).into()));
                }
                Found::Text(value, _) => attributes.push((own.into(), value)),
                Found::Nothing(_) => attributes.push((own.into(), CompactString::default())),
            }
        })
    }

    /// Goes through an element and those within it: what they say, or that they say nothing at all.
    fn each_within(&mut self, tag: &Tag<'a>, mut each: impl FnMut(&mut Self, Found<'_, 'a>)) -> Read<()> {
        self.attributes_within(tag, &mut each)?;
        while self.cursor.depth() >= tag.depth {
            match self.cursor.read()? {
                Some(Event::Start(inner)) => self.attributes_within(&inner, &mut each)?,
                Some(Event::Text(text)) => {
                    let value = text.value(self.diagnostics).trim().into();
                    each(self, Found::Text(value, text.span));
                }
                Some(Event::End) => {}
                None => break,
            }
        }
        Ok(())
    }

    fn attributes_within(&mut self, tag: &Tag<'a>, each: &mut impl FnMut(&mut Self, Found<'_, 'a>)) -> Read<()> {
        let mut any = false;
        for attribute in tag.attributes() {
            let attribute = attribute?;
            if !attribute.is_namespace() {
                any = true;
                each(self, Found::Attribute(&attribute));
            }
        }
        if tag.empty && !any {
            each(self, Found::Nothing(tag.span));
        }
        Ok(())
    }

    /// Reads an element that has no children in GSDML to its end.
    pub fn no_children(&mut self, tag: &Tag<'a>, extensions: &mut Extensions) -> Read<()> {
        while let Some(child) = self.cursor.child(tag)? {
            self.unknown(&child, extensions)?;
        }
        Ok(())
    }

    /// Reports an attribute whose form GSDML doesn't allow.
    pub fn bad(&mut self, given: &Given<'_>, what: &str, label: impl Into<String>) {
        let message = format!("`{}` is no {what}", shortened(&given.text));
        self.diagnostics.push(Diagnostic::new(&codes::GSDML_VALUE, given.span, message).label(label));
    }

    /// Reports that an attribute or a child of `tag` is missing.
    pub fn missing(&mut self, tag: &Tag<'_>, what: &str, label: impl Into<String>) {
        let message = format!("<{}> has no {what}", shortened(tag.name));
        self.diagnostics.push(Diagnostic::new(&codes::GSDML_MISSING, tag.name_span(), message).label(label));
    }
}

/// What [`Reader::each_within`] comes by.
enum Found<'f, 'a> {
    Attribute(&'f Attribute<'a>),
    Text(CompactString, Span),
    /// An empty element without attributes.
    Nothing(Span),
}

/// Keeps something that was read as an extension.
pub(super) fn note(key: &str, given: Option<&Given<'_>>, extensions: &mut Extensions) {
    if let Some(given) = given {
        extensions.push(Extension { key: key.into(), value: given.text.as_ref().into(), span: given.span });
    }
}

/// Keeps something that was read as an attribute.
pub(super) fn attribute(key: &str, given: Option<&Given<'_>>, attributes: &mut Attributes) {
    if let Some(given) = given {
        attributes.push((key.into(), given.text.as_ref().into()));
    }
}
