//! The state of reading one file: attributes and children of elements.

use compact_str::CompactString;

use super::Given;
use crate::diagnostics::{Code, Diagnostic, Diagnostics};
use crate::ir::Extensions;
use crate::source::{Origin, Span};
use crate::syntax::xml::{Attribute, Cursor, Tag};
use crate::text::brief;

/// A result that ends the reading of the file with one diagnostic.
pub type Read<T> = Result<T, Box<Diagnostic>>;

/// Attributes as the source spells them, with their values.
pub type Attributes = Vec<(CompactString, CompactString)>;

/// What a format decides about the reading of its elements, and its state.
pub trait Format {
    /// The standard, as diagnostics call it.
    const STANDARD: &'static str;
    /// Code of an element or attribute that the standard does not have.
    const UNKNOWN: &'static Code;
    /// Code of a value of a form that the standard does not allow.
    const VALUE: &'static Code;
    /// Code of an attribute whose name is in another case; without one, such a name is as good as the right one.
    const CASE: Option<&'static Code> = None;
    /// Whether the key of an unknown attribute names its element.
    const ELEMENT_IN_KEY: bool = false;
    /// Whether an empty attribute or element is as good as none.
    const EMPTY_IS_MISSING: bool = true;
    /// The attribute of a text in English, which is not kept.
    const ENGLISH: (&'static str, &'static str) = ("", "");
}

/// The state of reading one file.
pub struct Reader<'a, 'd, F> {
    /// The document.
    pub cursor: Cursor<'a>,
    /// The diagnostics so far.
    pub diagnostics: &'d mut Diagnostics,
    /// What was read and has no field in the IR, as a stack; see the module.
    pub extensions: Extensions,
    /// The last child, if it has attributes and none of them was read.
    pub(super) unread: Option<Tag<'a>>,
    /// The state of the format.
    pub format: F,
}

impl<'a, 'd, F: Format> Reader<'a, 'd, F> {
    /// A reader before the first element that `cursor` finds.
    pub fn new(cursor: Cursor<'a>, diagnostics: &'d mut Diagnostics, format: F) -> Self {
        Reader { cursor, diagnostics, extensions: Extensions::new(), unread: None, format }
    }

    /// The next child of `parent`; the unread rest of the previous one is skipped. Attributes that nothing has read are unknown.
    pub fn child(&mut self, parent: &Tag<'a>) -> Read<Option<Tag<'a>>> {
        if let Some(tag) = self.unread.take() {
            self.attributes(&tag, [])?;
        }
        let child = self.cursor.child(parent)?;
        self.unread = child.filter(Tag::has_attributes);
        Ok(child)
    }

    /// Skips an element with its attributes.
    pub fn skip(&mut self, tag: &Tag<'a>) -> Read<()> {
        self.unread = None;
        Ok(self.cursor.skip(tag)?)
    }

    /// Reads each child called `name` of an element that has no others.
    pub fn each(
        &mut self,
        parent: &Tag<'a>,
        name: &str,
        mut read: impl FnMut(&mut Self, &Tag<'a>) -> Read<()>,
    ) -> Read<()> {
        while let Some(tag) = self.child(parent)? {
            if tag.name == name {
                read(self, &tag)?;
            } else {
                self.unknown(&tag)?;
            }
        }
        Ok(())
    }

    /// Reads an element without children to its end.
    pub fn no_children(&mut self, tag: &Tag<'a>) -> Read<()> {
        if tag.empty {
            return Ok(());
        }
        while let Some(child) = self.child(tag)? {
            self.unknown(&child)?;
        }
        Ok(())
    }

    /// Line and span of an element.
    pub fn origin(&mut self, tag: &Tag<'a>) -> Origin {
        self.cursor.origin(tag)
    }

    /// The attributes called `names`, in that order; others become extensions.
    pub fn attributes<const N: usize>(&mut self, tag: &Tag<'a>, names: [&str; N]) -> Read<[Given<'a>; N]> {
        self.select(tag, names, Self::given, |reader, attribute| reader.unknown_attribute(tag, attribute))
    }

    /// The same with the blanks around their values.
    pub fn attributes_with_blanks<const N: usize>(&mut self, tag: &Tag<'a>, names: [&str; N]) -> Read<[Given<'a>; N]> {
        let given = |reader: &mut Self, attribute: &_| Given::of_attribute(attribute, reader.diagnostics);
        self.select(tag, names, given, |reader, attribute| reader.unknown_attribute(tag, attribute))
    }

    /// The attributes called `names`, in that order; others are added to `others`.
    pub fn attributes_and_others<const N: usize>(
        &mut self,
        tag: &Tag<'a>,
        names: [&str; N],
        others: &mut Attributes,
    ) -> Read<[Given<'a>; N]> {
        self.select(tag, names, Self::given, |reader, attribute| {
            let value = attribute.value(reader.diagnostics).into();
            others.push((attribute.name.into(), value));
        })
    }

    fn select<const N: usize>(
        &mut self,
        tag: &Tag<'a>,
        names: [&str; N],
        given: impl Fn(&mut Self, &Attribute<'a>) -> Given<'a>,
        mut other: impl FnMut(&mut Self, &Attribute<'a>),
    ) -> Read<[Given<'a>; N]> {
        self.unread = None;
        let mut found = [const { Given::missing() }; N];
        // Most files have the attributes in this order.
        let mut next = 0;
        if !tag.has_attributes() {
            return Ok(found);
        }
        for attribute in tag.attributes() {
            let attribute = attribute?;
            // Attributes with a prefix are those of XML Schema and of XML itself, such as `xml:lang`.
            let has_prefix = !attribute.prefix.is_empty();
            if attribute.is_namespace() || (has_prefix && attribute.prefix != "xml") {
                continue;
            }
            let at = |names: &[&str]| names.iter().position(|name| *name == attribute.name);
            let position = at(&names[next..]).map(|at| at + next).or_else(|| at(&names[..next]));
            match position.or_else(|| self.in_another_case(&attribute, &names)) {
                Some(at) => {
                    found[at] = given(self, &attribute);
                    next = at + 1;
                }
                None if has_prefix => {}
                None => other(self, &attribute),
            }
        }
        Ok(found)
    }

    /// The position of a name that differs from that of an attribute in nothing but its case.
    fn in_another_case(&mut self, attribute: &Attribute<'a>, names: &[&str]) -> Option<usize> {
        let at = names.iter().position(|name| name.eq_ignore_ascii_case(attribute.name))?;
        if let (Some(code), Some(name)) = (F::CASE, names.get(at)) {
            let message = format!("the attribute is called {name}, not {}", attribute.name);
            let diagnostic = Diagnostic::new(code, attribute.name_span, message);
            self.diagnostics.push(diagnostic.label(format!("read as {name}")).fix(*name));
        }
        Some(at)
    }

    /// The attribute `name`; others become extensions.
    pub fn attribute(&mut self, tag: &Tag<'a>, name: &str) -> Read<Given<'a>> {
        self.attributes(tag, [name]).map(|[given]| given)
    }

    /// The attribute `name` of an element that is read later.
    pub fn peek(&mut self, tag: &Tag<'a>, name: &str) -> Read<Given<'a>> {
        self.unread = None;
        Ok(tag.attribute(name)?.map_or_else(Given::default, |attribute| self.given(&attribute)))
    }

    fn given(&mut self, attribute: &Attribute<'a>) -> Given<'a> {
        let given = Given::of_attribute(attribute, self.diagnostics).trimmed();
        if F::EMPTY_IS_MISSING && given.is_empty() {
            return Given::default();
        }
        given
    }

    /// `true` or `false`, also as 1 or 0; `default` if it is missing.
    pub fn flag_or(&mut self, given: &Given<'_>, default: bool) -> bool {
        if given.is_missing() {
            return default;
        }
        match given.text.as_ref() {
            "true" | "1" => return true,
            "false" | "0" => return false,
            _ => {}
        }
        let value = ["true", "yes"].iter().any(|word| word.eq_ignore_ascii_case(&given.text))
            || given.text.bytes().any(|byte| matches!(byte, b'1'..=b'9'));
        self.bad(given, "`true` or `false`", format!("read as {value}"));
        value
    }

    /// The same; false if it is missing.
    pub fn flag(&mut self, given: &Given<'_>) -> bool {
        self.flag_or(given, false)
    }

    /// Reports a text of a form that the standard does not allow.
    pub fn bad(&mut self, given: &Given<'_>, what: &str, label: impl Into<String>) {
        let message = format!("`{}` is no {what}", brief(&given.text));
        self.report(F::VALUE, given.span, message, label);
    }

    /// Reports a diagnostic with a label.
    pub fn report(&mut self, code: &'static Code, span: Span, message: impl Into<String>, label: impl Into<String>) {
        self.diagnostics.push(Diagnostic::new(code, span, message).label(label));
    }

    /// Keeps a text that was read as an extension.
    pub fn note(&mut self, key: &str, given: &Given<'_>) {
        self.extensions.extend(given.extension(key));
    }

    /// Takes the extensions that were added since there were `start` of them.
    pub fn extensions_since(&mut self, start: usize) -> Extensions {
        if self.extensions.len() <= start {
            return Extensions::new();
        }
        self.extensions.drain(start..).collect()
    }
}
