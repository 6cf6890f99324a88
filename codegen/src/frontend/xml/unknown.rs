//! Elements and attributes that the standard does not define, or for which the IR has no field. They become extensions.
//! By default, the reader reports only likely misspellings. If the user enables the diagnostic for unknown names, the reader
//! reports all names that the standard does not define.

use compact_str::{format_compact, CompactString};

use super::reader::{Attributes, Format, Read, Reader};
use crate::diagnostics::codes;
use crate::ir::Extension;
use crate::source::Span;
use crate::syntax::xml::{Attribute, Event, Tag};
use crate::text::{brief, edit_distance};

impl<'a, F: Format> Reader<'a, '_, F> {
    /// Reports an element that the standard does not define in this position, and stores its contents as extensions.
    pub fn unknown(&mut self, tag: &Tag<'a>) -> Read<()> {
        let is_misspelled = !F::ELEMENTS.contains(&tag.name) && self.misspelled(tag.name, tag.name_span(), F::ELEMENTS);
        if !is_misspelled && self.diagnostics.wants(F::UNKNOWN) {
            let message = format!("{} does not allow the element <{}> at this position", F::STANDARD, brief(tag.name));
            self.report(F::UNKNOWN, tag.name_span(), message, "kept as extension attributes");
        }
        self.keep(tag)
    }

    /// Reports an attribute that the standard does not define for this element, and stores it as an extension. Attributes in
    /// [`Format::KEPT`] are stored without a report. `missing` contains the attributes that the element lacks.
    pub(super) fn unknown_attribute(&mut self, tag: &Tag<'a>, attribute: &Attribute<'a>, missing: &[&str]) {
        let is_misspelled = self.misspelled(attribute.name, attribute.name_span, missing);
        if !is_misspelled && self.diagnostics.wants(F::UNKNOWN) && !F::KEPT.contains(&(tag.name, attribute.name)) {
            let (element, name) = (brief(tag.name), brief(attribute.name));
            let message = format!("{} does not define the attribute `{name}` of <{element}>", F::STANDARD);
            self.report(F::UNKNOWN, attribute.name_span, message, "kept as an extension attribute");
        }
        let key = match F::ELEMENT_IN_KEY {
            true => format_compact!("{}@{}", brief(tag.name), brief(attribute.name)),
            false => attribute.name.into(),
        };
        let value = attribute.value(self.diagnostics).into();
        self.extensions.push(Extension { key, value, span: attribute.span });
    }

    /// Reports an unknown name that is similar to one of `names`. A name of 5 to 8 letters may differ in one letter, and a longer
    /// name in two letters. Shorter names are not compared. Returns whether the name was reported.
    pub(super) fn misspelled(&mut self, name: &str, span: Span, names: &[&str]) -> bool {
        if !self.diagnostics.wants(&codes::MISSPELLED_NAME) {
            return false;
        }
        let limit = match name.len() {
            0..=4 => return false,
            5..=8 => 1,
            _ => 2,
        };
        let is_near = |other: &&&str| other.len().abs_diff(name.len()) <= limit && edit_distance(name, other) <= limit;
        let Some(similar) = names.iter().find(is_near) else { return false };
        let message = format!("{} defines `{similar}` here, not `{}`", F::STANDARD, brief(name));
        let found = codes::MISSPELLED_NAME.at(span, message).label("kept as an extension");
        self.diagnostics.push(found.help("correct the name if it is misspelled, because its value is not used"));
        true
    }

    /// Stores the attributes and texts of an element and its descendants as extensions, with keys such as
    /// `parent/element@attribute`.
    pub fn keep(&mut self, tag: &Tag<'a>) -> Read<()> {
        self.keep_start(tag)?;
        while self.cursor.depth() >= tag.depth {
            match self.cursor.read()? {
                Some(Event::Start(inner)) => self.keep_start(&inner)?,
                Some(Event::Text(text)) => {
                    let value = text.value(self.diagnostics).trim().into();
                    self.push(self.cursor.innermost(), value, text.span);
                }
                Some(Event::End) => {}
                None => break,
            }
        }
        Ok(())
    }

    /// Adds the attributes and texts of an element and its descendants to `attributes`, with names such as
    /// `element@attribute`.
    pub fn keep_as_attributes(&mut self, tag: &Tag<'a>, attributes: &mut Attributes) -> Read<()> {
        let start = self.extensions.len();
        self.keep(tag)?;
        attributes.extend(self.extensions.drain(start..).map(|Extension { key, value, .. }| {
            let name = key.split_once('/').map(|(_, name)| name.into());
            (name.unwrap_or(key), value)
        }));
        Ok(())
    }

    /// Stores the attributes of a start tag as extensions. An empty element without attributes becomes an empty extension,
    /// unless the format treats empty elements as missing.
    fn keep_start(&mut self, tag: &Tag<'a>) -> Read<()> {
        let before = self.extensions.len();
        self.keep_attributes(tag)?;
        if tag.empty && !F::EMPTY_IS_MISSING && self.extensions.len() == before {
            self.push(self.cursor.innermost(), CompactString::default(), tag.span);
        }
        Ok(())
    }

    /// Stores the attributes of the innermost open element as extensions.
    pub fn keep_attributes(&mut self, tag: &Tag<'a>) -> Read<()> {
        self.unread = None;
        if !tag.has_attributes() {
            return Ok(());
        }
        for attribute in tag.attributes() {
            let attribute = attribute?;
            let is_empty = F::EMPTY_IS_MISSING && attribute.raw.is_empty();
            if attribute.is_namespace() || is_empty || (attribute.name, attribute.raw) == F::ENGLISH {
                continue;
            }
            let key = format_compact!("{}@{}", self.cursor.innermost(), brief(attribute.name));
            let value = attribute.value(self.diagnostics).into();
            self.push(key, value, attribute.span);
        }
        Ok(())
    }

    fn push(&mut self, key: CompactString, value: CompactString, span: Span) {
        self.extensions.push(Extension { key, value, span });
    }
}
