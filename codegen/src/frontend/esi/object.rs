//! Objects as written in the file, before data types are resolved.

use std::ops::Range;

use super::flags::{self, Flags};
use super::info_value::{self, RawInfo};
use super::reader::{Names, Reader};
use crate::frontend::xml::{Given, Read};
use crate::ir::{Extensions, ToolFlags};
use crate::source::{Origin, Span};
use crate::syntax::xml::Tag;

/// Contents of an `Object` element.
#[derive(Default)]
pub(super) struct RawObject<'a> {
    pub index: Option<u16>,
    pub depends_on_slot: bool,
    pub depends_on_slot_group: bool,
    pub name: Names<'a>,
    pub comment: Names<'a>,
    pub ty: Given<'a>,
    pub bits: Option<u32>,
    pub bits_at: Span,
    pub info: RawInfo<'a>,
    /// Range of the object's sub-items in the list of all sub-items of the dictionary.
    pub subs: Range<usize>,
    pub flags: Flags,
    pub tool_flags: Option<Box<ToolFlags>>,
    pub extensions: Extensions,
    pub origin: Origin,
}

/// Contents of a `SubItem` element in the `Info` element of an object.
#[derive(Default)]
pub(super) struct RawSub<'a> {
    pub name: Given<'a>,
    pub info: RawInfo<'a>,
    pub extensions: Extensions,
    pub origin: Origin,
}

/// Reads an `Object` element and adds its sub-items to `subs`.
pub(super) fn read<'a>(
    reader: &mut Reader<'a, '_>,
    parent: &Tag<'a>,
    subs: &mut Vec<RawSub<'a>>,
) -> Read<RawObject<'a>> {
    let (first, start) = (subs.len(), reader.extensions.len());
    let mut raw = RawObject { origin: reader.origin(parent), ..RawObject::default() };
    while let Some(tag) = reader.child(parent)? {
        match tag.name {
            "Index" => index(reader, &tag, &mut raw)?,
            "Name" => reader.name(&tag, &mut raw.name)?,
            "Comment" => reader.name(&tag, &mut raw.comment)?,
            "Type" => raw.ty = reader.text(&tag)?,
            "BitSize" => {
                let given = reader.text(&tag)?;
                raw.bits_at = given.span;
                raw.bits = reader.int(&given, "size in bits");
            }
            "Info" => info(reader, &tag, &mut raw.info, subs)?,
            "Flags" => raw.flags = flags::read(reader, &tag, Some(&mut raw.tool_flags))?,
            "Properties" => info_value::properties(reader, &tag)?,
            "Xml" => reader.keep(&tag)?,
            _ => reader.unknown(&tag)?,
        }
    }
    raw.subs = first..subs.len();
    raw.extensions = reader.extensions_since(start);
    Ok(raw)
}

fn index<'a>(reader: &mut Reader<'a, '_>, tag: &Tag<'a>, raw: &mut RawObject<'a>) -> Read<()> {
    let names = ["DependOnSlot", "DependOnSlotGroup", "OverwrittenByModule"];
    let [slot, group, overwritten] = reader.attributes(tag, names)?;
    raw.depends_on_slot = reader.flag(&slot);
    raw.depends_on_slot_group = reader.flag(&group);
    if !overwritten.is_empty() {
        raw.tool_flags.get_or_insert_default().overwritten_by_module = overwritten.compact();
    }
    let given = reader.content()?;
    raw.index = reader.int(&given, "index");
    Ok(())
}

fn info<'a>(
    reader: &mut Reader<'a, '_>,
    parent: &Tag<'a>,
    info: &mut RawInfo<'a>,
    subs: &mut Vec<RawSub<'a>>,
) -> Read<()> {
    while let Some(tag) = reader.child(parent)? {
        if tag.name == "SubItem" {
            // The large struct is added to the list first and filled there, which avoids a copy.
            subs.push(RawSub::default());
            if let Some(last) = subs.last_mut() {
                sub_item(reader, &tag, last)?;
            }
        } else {
            info.read(reader, &tag)?;
        }
    }
    Ok(())
}

fn sub_item<'a>(reader: &mut Reader<'a, '_>, parent: &Tag<'a>, raw: &mut RawSub<'a>) -> Read<()> {
    let start = reader.extensions.len();
    raw.origin = reader.origin(parent);
    while let Some(tag) = reader.child(parent)? {
        match tag.name {
            "Name" => raw.name = reader.text(&tag)?,
            "Info" => {
                while let Some(inner) = reader.child(&tag)? {
                    raw.info.read(reader, &inner)?;
                }
            }
            // Some files omit the `Info` element around the description of a single value.
            _ => raw.info.read(reader, &tag)?,
        }
    }
    raw.extensions = reader.extensions_since(start);
    Ok(())
}
