//! Default value, limits, unit and properties of an object or sub-item, before conversion.

use std::borrow::Cow;

use compact_str::format_compact;

use super::reader::{Names, Reader};
use crate::diagnostics::codes;
use crate::frontend::xml::{Given, Read};
use crate::ir::Extension;
use crate::source::Span;
use crate::syntax::xml::Tag;
use crate::text::brief;

/// Default value, limits, unit and display name of an object or sub-item.
#[derive(Default)]
pub(super) struct RawInfo<'a> {
    pub default: Option<RawValue<'a>>,
    /// Limits and unit, which few objects have.
    pub more: Option<Box<MoreInfo<'a>>>,
    pub display: Option<Box<Names<'a>>>,
}

#[derive(Default)]
pub(super) struct MoreInfo<'a> {
    pub min: Option<RawValue<'a>>,
    pub max: Option<RawValue<'a>>,
    pub unit: Given<'a>,
}

/// Value as written in the file, and its notation. The fields of a [`Given`] are its own fields, because a large
/// dictionary has many values and they need less memory in this form.
pub(super) struct RawValue<'a> {
    pub text: Cow<'a, str>,
    pub span: Span,
    pub form: Form,
}

impl<'a> RawValue<'a> {
    pub fn new(form: Form, Given { text, span }: Given<'a>) -> Self {
        RawValue { text, span, form }
    }

    pub fn given(&self) -> Given<'_> {
        Given { text: Cow::Borrowed(&self.text), span: self.span }
    }
}

/// Notation of a value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Form {
    /// Bytes in hexadecimal notation, in memory order.
    Data,
    /// Decimal or hexadecimal number.
    Number,
    /// Text of a string type.
    Text,
}

impl<'a> RawInfo<'a> {
    /// Returns the number of text bytes that a copy of the default value, limits, unit and display name needs.
    pub fn weight(&self) -> usize {
        let length = |raw: &Option<RawValue<'a>>| raw.as_ref().map_or(0, |raw| raw.text.len());
        let of_more = |more: &MoreInfo<'a>| length(&more.min) + length(&more.max) + more.unit.text.len();
        let of_display = self.display.as_deref().map_or(0, Names::weight);
        length(&self.default) + self.more.as_deref().map_or(0, of_more) + of_display
    }

    /// Reads a child of an `Info` element, or of a data type's `SubItem` element.
    pub fn read(&mut self, reader: &mut Reader<'a, '_>, tag: &Tag<'a>) -> Read<()> {
        let form = match tag.name {
            "DefaultData" | "MinData" | "MaxData" => Form::Data,
            "DefaultValue" | "MinValue" | "MaxValue" => Form::Number,
            "DefaultString" => Form::Text,
            "Unit" => {
                self.more().unit = reader.text(tag)?;
                return Ok(());
            }
            "DisplayName" => return reader.name(tag, self.display.get_or_insert_default()),
            _ => return reader.unknown(tag),
        };
        let given = reader.text(tag)?;
        if given.is_empty() {
            return Ok(());
        }
        let value = match tag.name.as_bytes() {
            [b'D', ..] => &mut self.default,
            [b'M', b'i', ..] => &mut self.more().min,
            _ => &mut self.more().max,
        };
        if let Some(earlier) = value.replace(RawValue::new(form, given)) {
            reader.note(tag.name, &earlier.given());
        }
        Ok(())
    }

    pub fn more(&mut self) -> &mut MoreInfo<'a> {
        self.more.get_or_insert_default()
    }

    /// Returns whether there is no default value, limit, unit or display name.
    pub fn is_empty(&self) -> bool {
        self.default.is_none() && self.more.is_none() && self.display.is_none()
    }
}

/// Reads a `Properties` element.
pub(super) fn properties<'a>(reader: &mut Reader<'a, '_>, parent: &Tag<'a>) -> Read<()> {
    reader.each(parent, "Property", property)
}

/// Reads a `Property` element. Stores the value as an extension with the name of the property, and the description as a
/// second extension. If the value is missing, the first extension contains the description.
pub(super) fn property<'a>(reader: &mut Reader<'a, '_>, parent: &Tag<'a>) -> Read<()> {
    let (mut name, mut value) = (Given::default(), Given::default());
    let mut description = Names::default();
    while let Some(tag) = reader.child(parent)? {
        match tag.name {
            "Name" => name = reader.text(&tag)?,
            "Value" => value = reader.text(&tag)?,
            "Desc" => reader.name(&tag, &mut description)?,
            _ => reader.unknown(&tag)?,
        }
    }
    if name.is_empty() {
        reader.report(&codes::ESI_VALUE, parent.span, "this property has no name", "kept as `Property`");
        name.text = "Property".into();
    }
    let key = name.compact();
    if value.is_empty() {
        let span = description.span().or(name.span).or(parent.span);
        reader.extensions.push(Extension { key, value: description.name(), span });
        return Ok(());
    }
    if !description.span().is_empty() {
        let key = format_compact!("{}/Desc", brief(&name.text));
        reader.extensions.push(Extension { key, value: description.name(), span: description.span() });
    }
    reader.extensions.push(Extension { key, value: value.compact(), span: value.span });
    Ok(())
}
