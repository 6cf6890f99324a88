//! Reader of an XML file, and functions that read attributes and children of elements.

use compact_str::CompactString;
use smallvec::SmallVec;

use super::Given;
use crate::diagnostics::{Code, Diagnostic, Diagnostics};
use crate::ir::Extensions;
use crate::source::{Origin, Span};
use crate::syntax::xml::{Attribute, Cursor, Tag};
use crate::text::brief;

/// Result of reading an element. An error ends the reading of the file with one diagnostic.
pub type Read<T> = Result<T, Box<Diagnostic>>;

/// Names and values of attributes.
pub type Attributes = Vec<(CompactString, CompactString)>;

/// State of a front end, and the settings for reading files of its format.
pub trait Format {
    /// Name of the standard in diagnostics.
    const STANDARD: &'static str;
    /// Diagnostic code for an element or attribute that the standard does not define.
    const UNKNOWN: &'static Code;
    /// Pairs of an element and an attribute that the standard defines and for which the IR has no field. Such an
    /// attribute becomes an extension, and is not reported as unknown.
    const KEPT: &'static [(&'static str, &'static str)] = &[];
    /// Elements whose contents the front end reads. A similar unknown name is reported as misspelled.
    const ELEMENTS: &'static [&'static str];
    /// Diagnostic code for a value in a form that the standard does not allow.
    const VALUE: &'static Code;
    /// Diagnostic code for an attribute name in the wrong case; `None` if case is ignored.
    const CASE: Option<&'static Code> = None;
    /// True if the key of an unknown attribute includes the name of its element.
    const ELEMENT_IN_KEY: bool = false;
    /// True if an empty attribute or element is treated as missing.
    const EMPTY_IS_MISSING: bool = true;
    /// Name and value of the attribute that marks a text as English. [`Reader::keep`] and [`Reader::text`] do not store this
    /// attribute as an extension.
    const ENGLISH: (&'static str, &'static str) = ("", "");
}

/// Reader of an XML file in the format `F`.
pub struct Reader<'a, 'd, F> {
    /// Cursor in the document.
    pub cursor: Cursor<'a>,
    /// Diagnostics reported so far.
    pub diagnostics: &'d mut Diagnostics,
    /// Stack of facts for which the IR has no field; see the module documentation.
    pub extensions: Extensions,
    /// Last child element, if none of its attributes has been read.
    pub(super) unread: Option<Tag<'a>>,
    /// State of the front end.
    pub format: F,
}

impl<'a, 'd, F: Format> Reader<'a, 'd, F> {
    /// Creates a reader that starts at the first element after `cursor`.
    pub fn new(cursor: Cursor<'a>, diagnostics: &'d mut Diagnostics, format: F) -> Self {
        Reader { cursor, diagnostics, extensions: Extensions::new(), unread: None, format }
    }

    /// Returns the next child of `parent`, and skips the unread part of the previous child. Reports the unread
    /// attributes of the previous child as unknown.
    pub fn child(&mut self, parent: &Tag<'a>) -> Read<Option<Tag<'a>>> {
        if let Some(tag) = self.unread.take() {
            self.attributes(&tag, [])?;
        }
        let child = self.cursor.child(parent)?;
        self.unread = child.filter(Tag::has_attributes);
        Ok(child)
    }

    /// Skips an element, including its attributes and content.
    pub fn skip(&mut self, tag: &Tag<'a>) -> Read<()> {
        self.unread = None;
        Ok(self.cursor.skip(tag)?)
    }

    /// Calls `read` for each child called `name`. Reports all other children as unknown.
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

    /// Reads an element that should have no children, up to its end tag.
    pub fn no_children(&mut self, tag: &Tag<'a>) -> Read<()> {
        if tag.empty {
            return Ok(());
        }
        while let Some(child) = self.child(tag)? {
            self.unknown(&child)?;
        }
        Ok(())
    }

    /// Returns the line and the span of an element.
    pub fn origin(&mut self, tag: &Tag<'a>) -> Origin {
        self.cursor.origin(tag)
    }

    /// Returns the values of the attributes `names`, in this order. All other attributes become extensions.
    pub fn attributes<const N: usize>(&mut self, tag: &Tag<'a>, names: [&str; N]) -> Read<[Given<'a>; N]> {
        self.attributes_with(tag, names, Self::given)
    }

    /// Returns the values of the attributes `names` with surrounding white space. All other attributes become
    /// extensions.
    pub fn attributes_with_blanks<const N: usize>(&mut self, tag: &Tag<'a>, names: [&str; N]) -> Read<[Given<'a>; N]> {
        self.attributes_with(tag, names, |reader, attribute| Given::of_attribute(attribute, reader.diagnostics))
    }

    fn attributes_with<const N: usize>(
        &mut self,
        tag: &Tag<'a>,
        names: [&str; N],
        given: impl Fn(&mut Self, &Attribute<'a>) -> Given<'a>,
    ) -> Read<[Given<'a>; N]> {
        let mut unknown = Vec::new();
        let found = self.select(tag, names, given, |_, attribute| unknown.push(*attribute))?;
        if !unknown.is_empty() {
            let missing = names.iter().zip(&found).filter(|(_, given)| given.is_missing()).map(|(name, _)| *name);
            let missing: SmallVec<[&str; 8]> = missing.collect();
            unknown.iter().for_each(|attribute| self.unknown_attribute(tag, attribute, &missing));
        }
        Ok(found)
    }

    /// Returns the value of an attribute with surrounding white space. The other attributes of the element must have
    /// been read before.
    pub fn attribute_with_blanks(&mut self, tag: &Tag<'a>, name: &str) -> Read<Given<'a>> {
        let given = |reader: &mut Self, attribute: &_| Given::of_attribute(attribute, reader.diagnostics);
        let [given] = self.select(tag, [name], given, |_, _| {})?;
        Ok(given)
    }

    /// Returns the values of the attributes `names`, in this order. Adds all other attributes to `others`.
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
        // In most files, the attributes have the order of `names`.
        let mut next = 0;
        if !tag.has_attributes() {
            return Ok(found);
        }
        for attribute in tag.attributes() {
            let attribute = attribute?;
            // Attributes with a prefix other than `xml` belong to another standard, such as XML Schema.
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

    /// Returns the position in `names` of the attribute's name, ignoring case. Reports the wrong case if the format has
    /// a code for it.
    fn in_another_case(&mut self, attribute: &Attribute<'a>, names: &[&str]) -> Option<usize> {
        let at = names.iter().position(|name| name.eq_ignore_ascii_case(attribute.name))?;
        if let (Some(code), Some(name)) = (F::CASE, names.get(at)) {
            let message = format!("the attribute {} has the wrong case: the schema defines {name}", attribute.name);
            self.diagnostics.push(code.at(attribute.name_span, message).label(format!("read as {name}")).fix(*name));
        }
        Some(at)
    }

    /// Returns the value of the attribute `name`. All other attributes become extensions.
    pub fn attribute(&mut self, tag: &Tag<'a>, name: &str) -> Read<Given<'a>> {
        self.attributes(tag, [name]).map(|[given]| given)
    }

    /// Returns the value of the attribute `name`. The element can still be read afterwards.
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

    /// Reads a Boolean value: `true`, `false`, 1 or 0. Returns `default` if the value is missing. Reports any other
    /// text, and reads this text as true if it is `yes`, `true` in another case, or contains a digit from 1 to 9.
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
        self.bad(given, "boolean", format!("read as {value}; expected `true` or `false`"));
        value
    }

    /// Reads a Boolean value as [`flag_or`](Self::flag_or) does. Returns false if the value is missing.
    pub fn flag(&mut self, given: &Given<'_>) -> bool {
        self.flag_or(given, false)
    }

    /// Reads a Boolean value as [`flag_or`](Self::flag_or) does. Returns `None` if the value is missing or empty.
    pub fn optional_flag(&mut self, given: &Given<'_>) -> Option<bool> {
        (!given.is_empty()).then(|| self.flag(given))
    }

    /// Reports a value in a form that the standard does not allow.
    pub fn bad(&mut self, given: &Given<'_>, what: &str, label: impl Into<String>) {
        let message = format!("`{}` is not a valid {what}", brief(&given.text));
        self.report(F::VALUE, given.span, message, label);
    }

    /// Reports a diagnostic with a message and a label at `span`.
    pub fn report(&mut self, code: &'static Code, span: Span, message: impl Into<String>, label: impl Into<String>) {
        self.diagnostics.push(code.at(span, message).label(label));
    }

    /// Stores a text as an extension with the key `key`.
    pub fn note(&mut self, key: &str, given: &Given<'_>) {
        self.extensions.extend(given.extension(key));
    }

    /// Removes and returns all extensions after the first `start` ones.
    pub fn extensions_since(&mut self, start: usize) -> Extensions {
        if self.extensions.len() <= start {
            return Extensions::new();
        }
        if start == 0 {
            let mut extensions = std::mem::take(&mut self.extensions);
            extensions.shrink_to_fit();
            return extensions;
        }
        let mut extensions = Extensions::with_capacity(self.extensions.len() - start);
        extensions.extend(self.extensions.drain(start..));
        extensions
    }
}
