//! Objects as they stand in the file: read, not yet held against their data types.

use std::ops::Range;

use compact_str::format_compact;

use super::dictionary::Dictionary;
use super::flags::{self, Flags};
use super::reader::{note, shortened, Given, Names, Read, Reader};
use crate::diagnostics::codes;
use crate::ir::{Extension, Extensions};
use crate::source::Origin;
use crate::syntax::xml::Tag;

/// An Object.
#[derive(Default)]
pub(super) struct RawObject<'a> {
    pub index: Option<u16>,
    pub depends_on_slot: bool,
    pub depends_on_slot_group: bool,
    pub name: Names<'a>,
    pub comment: Names<'a>,
    pub ty: Given<'a>,
    pub bits: Option<u32>,
    pub bits_at: crate::source::Span,
    pub info: RawInfo<'a>,
    /// Its sub-items, among those of the dictionary.
    pub subs: Range<usize>,
    pub flags: Flags,
    pub extensions: Extensions,
    pub origin: Origin,
}

/// A SubItem of an object's Info.
#[derive(Default)]
pub(super) struct RawSub<'a> {
    pub name: Given<'a>,
    pub info: RawInfo<'a>,
    pub extensions: Extensions,
    pub origin: Origin,
}

/// Default, limits and unit of a value.
#[derive(Default)]
pub(super) struct RawInfo<'a> {
    pub default: Option<RawValue<'a>>,
    /// Limits, unit and the name for people, which few values have.
    pub more: Option<Box<MoreInfo<'a>>>,
}

#[derive(Default)]
pub(super) struct MoreInfo<'a> {
    pub min: Option<RawValue<'a>>,
    pub max: Option<RawValue<'a>>,
    pub unit: Given<'a>,
    pub display: Names<'a>,
}

/// A value, and how it is written.
pub(super) struct RawValue<'a> {
    pub form: Form,
    pub given: Given<'a>,
}

/// How a value is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Form {
    /// Its bytes in hexadecimal, in the order of memory.
    Data,
    /// A number.
    Number,
    /// A text.
    Text,
}

impl<'a> RawInfo<'a> {
    /// Bytes of its texts.
    pub fn weight(&self) -> usize {
        let length = |raw: &Option<RawValue<'a>>| raw.as_ref().map_or(0, |raw| raw.given.text.len());
        let of_more =
            |more: &MoreInfo<'a>| length(&more.min) + length(&more.max) + more.unit.text.len() + more.display.weight();
        length(&self.default) + self.more.as_deref().map_or(0, of_more)
    }

    /// Reads a child of Info, or of a SubItem of a data type; false for any other element.
    pub fn read(&mut self, reader: &mut Reader<'a, '_>, tag: &Tag<'a>, extensions: &mut Extensions) -> Read<bool> {
        let form = match tag.name {
            "DefaultData" | "MinData" | "MaxData" => Form::Data,
            "DefaultValue" | "MinValue" | "MaxValue" => Form::Number,
            "DefaultString" => Form::Text,
            "Unit" => {
                self.more().unit = reader.leaf(tag, extensions)?;
                return Ok(true);
            }
            "DisplayName" => {
                reader.name(tag, &mut self.more().display, extensions)?;
                return Ok(true);
            }
            _ => return Ok(false),
        };
        let given = reader.leaf(tag, extensions)?;
        if given.is_empty() {
            return Ok(true);
        }
        let place = match tag.name.as_bytes() {
            [b'D', ..] => &mut self.default,
            [b'M', b'i', ..] => &mut self.more().min,
            _ => &mut self.more().max,
        };
        if let Some(earlier) = place.replace(RawValue { form, given }) {
            note(tag.name, &earlier.given, extensions);
        }
        Ok(true)
    }

    fn more(&mut self) -> &mut MoreInfo<'a> {
        self.more.get_or_insert_default()
    }

    /// Whether nothing is said.
    pub fn is_empty(&self) -> bool {
        self.default.is_none() && self.more.is_none()
    }
}

/// Reads an Object, with its sub-items into `dictionary`.
pub(super) fn read<'a>(
    reader: &mut Reader<'a, '_>,
    parent: &Tag<'a>,
    dictionary: &mut Dictionary<'a>,
) -> Read<RawObject<'a>> {
    let first = dictionary.subs.len();
    let mut raw = RawObject { origin: reader.cursor.origin(parent), ..RawObject::default() };
    while let Some(tag) = reader.cursor.child(parent)? {
        match tag.name {
            "Index" => index(reader, &tag, &mut raw)?,
            "Name" => reader.name(&tag, &mut raw.name, &mut raw.extensions)?,
            "Comment" => reader.name(&tag, &mut raw.comment, &mut raw.extensions)?,
            "Type" => raw.ty = reader.leaf(&tag, &mut raw.extensions)?,
            "BitSize" => {
                let given = reader.leaf(&tag, &mut raw.extensions)?;
                raw.bits_at = given.span;
                raw.bits = reader.int(&given, "size in bits");
            }
            "Info" => info(reader, &tag, &mut raw, dictionary)?,
            "Flags" => raw.flags = flags::read(reader, &tag, &mut raw.extensions)?,
            "Properties" => properties(reader, &tag, &mut raw.extensions)?,
            "Xml" => reader.keep(&tag, &mut raw.extensions)?,
            _ => reader.unknown(&tag, &mut raw.extensions)?,
        }
    }
    raw.subs = first..dictionary.subs.len();
    Ok(raw)
}

fn index<'a>(reader: &mut Reader<'a, '_>, tag: &Tag<'a>, raw: &mut RawObject<'a>) -> Read<()> {
    const NAMES: [&str; 3] = ["DependOnSlot", "DependOnSlotGroup", "OverwrittenByModule"];
    let [slot, group, overwritten] = reader.fields(tag, &NAMES, &mut raw.extensions)?;
    raw.depends_on_slot = reader.flag(&slot);
    raw.depends_on_slot_group = reader.flag(&group);
    note("OverwrittenByModule", &overwritten, &mut raw.extensions);
    let given = reader.content(&mut raw.extensions)?;
    raw.index = reader.int(&given, "index");
    Ok(())
}

fn info<'a>(
    reader: &mut Reader<'a, '_>,
    parent: &Tag<'a>,
    raw: &mut RawObject<'a>,
    dictionary: &mut Dictionary<'a>,
) -> Read<()> {
    while let Some(tag) = reader.cursor.child(parent)? {
        if tag.name == "SubItem" {
            // Filled where it stands: it is too large to be moved about.
            dictionary.subs.push(RawSub::default());
            if let Some(last) = dictionary.subs.last_mut() {
                sub_item(reader, &tag, last)?;
            }
        } else if !raw.info.read(reader, &tag, &mut raw.extensions)? {
            reader.unknown(&tag, &mut raw.extensions)?;
        }
    }
    Ok(())
}

fn sub_item<'a>(reader: &mut Reader<'a, '_>, parent: &Tag<'a>, raw: &mut RawSub<'a>) -> Read<()> {
    raw.origin = reader.cursor.origin(parent);
    while let Some(tag) = reader.cursor.child(parent)? {
        match tag.name {
            "Name" => raw.name = reader.leaf(&tag, &mut raw.extensions)?,
            "Info" => {
                while let Some(inner) = reader.cursor.child(&tag)? {
                    if !raw.info.read(reader, &inner, &mut raw.extensions)? {
                        reader.unknown(&inner, &mut raw.extensions)?;
                    }
                }
            }
            _ => {
                // Some files leave the Info around a single value out.
                if !raw.info.read(reader, &tag, &mut raw.extensions)? {
                    reader.unknown(&tag, &mut raw.extensions)?;
                }
            }
        }
    }
    Ok(())
}

/// Reads Properties.
pub(super) fn properties<'a>(reader: &mut Reader<'a, '_>, parent: &Tag<'a>, extensions: &mut Extensions) -> Read<()> {
    while let Some(tag) = reader.cursor.child(parent)? {
        if tag.name == "Property" {
            property(reader, &tag, extensions)?;
        } else {
            reader.unknown(&tag, extensions)?;
        }
    }
    Ok(())
}

/// Keeps a Property under its own name.
pub(super) fn property<'a>(reader: &mut Reader<'a, '_>, parent: &Tag<'a>, extensions: &mut Extensions) -> Read<()> {
    let (mut name, mut value) = (Given::default(), Given::default());
    let mut description = Names::default();
    while let Some(tag) = reader.cursor.child(parent)? {
        match tag.name {
            "Name" => name = reader.leaf(&tag, extensions)?,
            "Value" => value = reader.leaf(&tag, extensions)?,
            "Desc" => reader.name(&tag, &mut description, extensions)?,
            _ => reader.unknown(&tag, extensions)?,
        }
    }
    if name.is_empty() {
        reader.report(&codes::ESI_VALUE, parent.span, "this property has no name", "kept as `Property`");
        name.text = "Property".into();
    }
    let key = name.compact();
    if value.is_empty() {
        let span = description.span().or(name.span).or(parent.span);
        extensions.push(Extension { key, value: description.name(), span });
        return Ok(());
    }
    if !description.span().is_empty() {
        let key = format_compact!("{}/Desc", shortened(&name.text));
        extensions.push(Extension { key, value: description.name(), span: description.span() });
    }
    extensions.push(Extension { key, value: value.compact(), span: value.span });
    Ok(())
}
