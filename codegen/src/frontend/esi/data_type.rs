//! Data types as written in the file, before references are resolved.

use compact_str::format_compact;
use thin_vec::ThinVec;

use super::flags::{self, Flags};
use super::info_value::{self, RawInfo};
use super::reader::{Names, Reader};
use crate::diagnostics::codes;
use crate::frontend::xml::{Given, Read};
use crate::ir::EnumValue;
use crate::source::Origin;
use crate::syntax::xml::Tag;
use crate::text::brief;

/// Contents of a `DataType` element.
#[derive(Default)]
pub(super) struct RawType<'a> {
    pub name: Given<'a>,
    /// Index of the data type in the object dictionary (element `Index`).
    pub code: Option<u32>,
    pub base: Given<'a>,
    pub bits: Option<u32>,
    pub dimensions: ThinVec<Dimension>,
    pub fields: ThinVec<RawField<'a>>,
    pub values: ThinVec<EnumValue>,
    pub comment: Option<Box<Names<'a>>>,
    pub origin: Origin,
}

/// Contents of an `ArrayInfo` element.
#[derive(Default)]
pub(super) struct Dimension {
    pub lower: i32,
    pub elements: Option<u32>,
    pub origin: Origin,
}

/// Contents of a `SubItem` element of a data type.
#[derive(Default)]
pub(super) struct RawField<'a> {
    pub sub_index: Option<u16>,
    pub name: Given<'a>,
    pub ty: Given<'a>,
    pub bits: Option<u32>,
    pub offset: Option<u32>,
    pub flags: Flags,
    pub info: RawInfo<'a>,
    pub comment: Option<Box<Names<'a>>>,
    pub origin: Origin,
}

impl RawField<'_> {
    /// Returns the number of text bytes that are copied from this sub-item to each item that is created from it.
    pub fn weight(&self) -> usize {
        let of_comment = self.comment.as_deref().map_or(0, Names::weight);
        self.name.text.len() + of_comment + self.info.weight() + self.flags.weight()
    }
}

/// Reads a `DataType` element.
pub(super) fn read<'a>(reader: &mut Reader<'a, '_>, parent: &Tag<'a>, raw: &mut RawType<'a>) -> Read<()> {
    let start = reader.extensions.len();
    raw.origin = reader.origin(parent);
    while let Some(tag) = reader.child(parent)? {
        match tag.name {
            "Name" => raw.name = reader.text(&tag)?,
            "Index" => raw.code = reader.number(&tag, "data type number")?,
            "BaseType" => raw.base = reader.text(&tag)?,
            "BitSize" => raw.bits = reader.number(&tag, "size in bits")?,
            "Comment" => reader.name(&tag, raw.comment.get_or_insert_default())?,
            "ArrayInfo" => raw.dimensions.push(dimension(reader, &tag)?),
            "SubItem" => {
                // The large struct is added to the list first and filled there, which avoids a copy.
                raw.fields.push(RawField::default());
                if let Some(last) = raw.fields.last_mut() {
                    field(reader, &tag, last)?;
                }
            }
            "EnumInfo" => raw.values.extend(enum_value(reader, &tag)?),
            "Properties" => info_value::properties(reader, &tag)?,
            "Xml" => reader.keep(&tag)?,
            _ => reader.unknown(&tag)?,
        }
    }
    raw.fields.shrink_to_fit();
    raw.values.shrink_to_fit();
    // All data types share one list of extensions, so each key starts with the name of its data type.
    for extension in reader.extensions.iter_mut().skip(start) {
        extension.key = format_compact!("{}/{}", brief(&raw.name.text), extension.key);
    }
    Ok(())
}

fn dimension<'a>(reader: &mut Reader<'a, '_>, parent: &Tag<'a>) -> Read<Dimension> {
    let mut dimension = Dimension { origin: reader.origin(parent), ..Dimension::default() };
    while let Some(tag) = reader.child(parent)? {
        match tag.name {
            "LBound" => dimension.lower = reader.number(&tag, "lower bound")?.unwrap_or(0),
            "Elements" => dimension.elements = reader.number(&tag, "number of elements")?,
            _ => reader.unknown(&tag)?,
        }
    }
    Ok(dimension)
}

fn field<'a>(reader: &mut Reader<'a, '_>, parent: &Tag<'a>, raw: &mut RawField<'a>) -> Read<()> {
    raw.origin = reader.origin(parent);
    while let Some(tag) = reader.child(parent)? {
        match tag.name {
            "SubIdx" => raw.sub_index = reader.number(&tag, "sub-index")?,
            "Name" => raw.name = reader.text(&tag)?,
            "Type" => raw.ty = reader.text(&tag)?,
            "BitSize" => raw.bits = reader.number(&tag, "size in bits")?,
            "BitOffs" => raw.offset = reader.number(&tag, "bit offset")?,
            "Flags" => raw.flags = flags::read(reader, &tag, None)?,
            "Comment" => reader.name(&tag, raw.comment.get_or_insert_default())?,
            "Property" => info_value::property(reader, &tag)?,
            "Xml" => reader.keep(&tag)?,
            _ => raw.info.read(reader, &tag)?,
        }
    }
    Ok(())
}

/// Reads an enumeration value from an `EnumInfo` element or from an entry of a diagnosis list.
pub(super) fn enum_value<'a>(reader: &mut Reader<'a, '_>, parent: &Tag<'a>) -> Read<Option<EnumValue>> {
    let (mut names, mut comment) = (Names::default(), Names::default());
    let mut value = None;
    while let Some(tag) = reader.child(parent)? {
        match tag.name {
            "Text" => reader.name(&tag, &mut names)?,
            "Enum" => value = reader.number::<i128>(&tag, "enumeration value")?,
            "Comment" => reader.name(&tag, &mut comment)?,
            _ => reader.unknown(&tag)?,
        }
    }
    let Some(value) = value else {
        reader.report(&codes::ESI_VALUE, parent.span, "this enumeration value has no number", "left out");
        return Ok(None);
    };
    let (name, names, documentation) = (names.name(), names.others(), comment.documentation());
    Ok(Some(EnumValue { names, documentation, ..EnumValue::new(name, value) }))
}
