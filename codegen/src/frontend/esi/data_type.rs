//! Data types as they stand in the file: read, not yet resolved.

use super::flags::{self, Flags};
use super::object::{self, RawInfo};
use super::reader::{Given, Names, Read, Reader};
use crate::diagnostics::codes;
use crate::ir::{EnumValue, Extensions};
use crate::source::Origin;
use crate::syntax::xml::Tag;

/// A DataType.
#[derive(Default)]
pub(super) struct RawType<'a> {
    pub name: Given<'a>,
    /// Its number in the dictionary.
    pub code: Option<u32>,
    pub base: Given<'a>,
    pub bits: Option<u32>,
    pub dimensions: Vec<Dimension>,
    pub fields: Vec<RawField<'a>>,
    pub values: Vec<EnumValue>,
    pub comment: Names<'a>,
    pub extensions: Extensions,
    pub origin: Origin,
}

/// An ArrayInfo.
#[derive(Default)]
pub(super) struct Dimension {
    pub lower: i32,
    pub elements: Option<u32>,
    pub origin: Origin,
}

/// A SubItem of a DataType.
#[derive(Default)]
pub(super) struct RawField<'a> {
    pub sub_index: Option<u16>,
    pub name: Given<'a>,
    pub ty: Given<'a>,
    pub bits: Option<u32>,
    pub offset: Option<u32>,
    pub flags: Flags,
    pub info: RawInfo<'a>,
    pub comment: Names<'a>,
    pub extensions: Extensions,
    pub origin: Origin,
    /// Bytes of text that every item made from it copies.
    pub weight: usize,
}

/// Reads a DataType.
pub(super) fn read<'a>(reader: &mut Reader<'a, '_>, parent: &Tag<'a>, raw: &mut RawType<'a>) -> Read<()> {
    raw.origin = reader.cursor.origin(parent);
    while let Some(tag) = reader.cursor.child(parent)? {
        match tag.name {
            "Name" => raw.name = reader.leaf(&tag, &mut raw.extensions)?,
            "Index" => raw.code = reader.number(&tag, "number of a data type", &mut raw.extensions)?,
            "BaseType" => raw.base = reader.leaf(&tag, &mut raw.extensions)?,
            "BitSize" => raw.bits = reader.number(&tag, "size in bits", &mut raw.extensions)?,
            "Comment" => reader.name(&tag, &mut raw.comment, &mut raw.extensions)?,
            "ArrayInfo" => {
                let dimension = dimension(reader, &tag, &mut raw.extensions)?;
                raw.dimensions.push(dimension);
            }
            "SubItem" => {
                // Filled where it stands: it is too large to be moved about.
                raw.fields.push(RawField::default());
                if let Some(last) = raw.fields.last_mut() {
                    field(reader, &tag, last)?;
                }
            }
            "EnumInfo" => {
                let value = enum_value(reader, &tag, &mut raw.extensions)?;
                raw.values.extend(value);
            }
            "Properties" => object::properties(reader, &tag, &mut raw.extensions)?,
            "Xml" => reader.keep(&tag, &mut raw.extensions)?,
            _ => reader.unknown(&tag, &mut raw.extensions)?,
        }
    }
    Ok(())
}

fn dimension<'a>(reader: &mut Reader<'a, '_>, parent: &Tag<'a>, extensions: &mut Extensions) -> Read<Dimension> {
    let mut dimension = Dimension { origin: reader.cursor.origin(parent), ..Dimension::default() };
    while let Some(tag) = reader.cursor.child(parent)? {
        match tag.name {
            "LBound" => dimension.lower = reader.number(&tag, "lower bound", extensions)?.unwrap_or(0),
            "Elements" => dimension.elements = reader.number(&tag, "number of elements", extensions)?,
            _ => reader.unknown(&tag, extensions)?,
        }
    }
    Ok(dimension)
}

fn field<'a>(reader: &mut Reader<'a, '_>, parent: &Tag<'a>, raw: &mut RawField<'a>) -> Read<()> {
    raw.origin = reader.cursor.origin(parent);
    while let Some(tag) = reader.cursor.child(parent)? {
        match tag.name {
            "SubIdx" => raw.sub_index = reader.number(&tag, "sub-index", &mut raw.extensions)?,
            "Name" => raw.name = reader.leaf(&tag, &mut raw.extensions)?,
            "Type" => raw.ty = reader.leaf(&tag, &mut raw.extensions)?,
            "BitSize" => raw.bits = reader.number(&tag, "size in bits", &mut raw.extensions)?,
            "BitOffs" => raw.offset = reader.number(&tag, "bit offset", &mut raw.extensions)?,
            "Flags" => raw.flags = flags::read(reader, &tag, &mut raw.extensions)?,
            "Comment" => reader.name(&tag, &mut raw.comment, &mut raw.extensions)?,
            "Property" => object::property(reader, &tag, &mut raw.extensions)?,
            "Xml" => reader.keep(&tag, &mut raw.extensions)?,
            _ => {
                if !raw.info.read(reader, &tag, &mut raw.extensions)? {
                    reader.unknown(&tag, &mut raw.extensions)?;
                }
            }
        }
    }
    raw.weight = raw.name.text.len() + raw.comment.weight() + raw.info.weight() + raw.flags.weight();
    Ok(())
}

/// Reads a value of an enumeration: EnumInfo, or one of the lists of a diagnosis.
pub(super) fn enum_value<'a>(
    reader: &mut Reader<'a, '_>,
    parent: &Tag<'a>,
    extensions: &mut Extensions,
) -> Read<Option<EnumValue>> {
    let (mut names, mut comment) = (Names::default(), Names::default());
    let mut value = None;
    while let Some(tag) = reader.cursor.child(parent)? {
        match tag.name {
            "Text" => reader.name(&tag, &mut names, extensions)?,
            "Enum" => value = reader.number::<i128>(&tag, "value of an enumeration", extensions)?,
            "Comment" => reader.name(&tag, &mut comment, extensions)?,
            _ => reader.unknown(&tag, extensions)?,
        }
    }
    let Some(value) = value else {
        reader.report(&codes::ESI_VALUE, parent.span, "this value of an enumeration has no number", "left out");
        return Ok(None);
    };
    let (name, names, documentation) = (names.name(), names.others(), comment.documentation());
    Ok(Some(EnumValue { names, documentation, ..EnumValue::new(name, value) }))
}
