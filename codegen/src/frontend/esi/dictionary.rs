//! Dictionaries as written.

use super::data_type::{self, RawType};
use super::object::{self, RawObject, RawSub};
use super::reader::Reader;
use crate::diagnostics::codes;
use crate::frontend::xml::{Given, Read};
use crate::ir::CompactString;
use crate::source::Span;
use crate::syntax::xml::Tag;

/// What the dictionaries of one device or module say; data types may follow the objects that name them.
#[derive(Default)]
pub(super) struct Dictionary<'a> {
    pub types: Vec<RawType<'a>>,
    pub objects: Vec<RawObject<'a>>,
    /// The sub-items of all objects.
    pub subs: Vec<RawSub<'a>>,
    /// Symbols of units that it defines, by notation index.
    pub units: Vec<(u32, CompactString)>,
}

impl<'a> Dictionary<'a> {
    /// Reads a Dictionary, and adds it to what was read before.
    pub fn read(&mut self, reader: &mut Reader<'a, '_>, parent: &Tag<'a>) -> Read<()> {
        while let Some(list) = reader.child(parent)? {
            match list.name {
                "DataTypes" => reader.each(&list, "DataType", |reader, tag| {
                    self.types.push(RawType::default());
                    self.types.last_mut().map_or(Ok(()), |last| data_type::read(reader, tag, last))
                })?,
                "Objects" => reader.each(&list, "Object", |reader, tag| {
                    let object = object::read(reader, tag, &mut self.subs)?;
                    self.objects.push(object);
                    Ok(())
                })?,
                "UnitTypes" => self.unit_types(reader, &list)?,
                _ => reader.unknown(&list)?,
            }
        }
        Ok(())
    }

    fn unit_types(&mut self, reader: &mut Reader<'a, '_>, parent: &Tag<'a>) -> Read<()> {
        while let Some(unit) = reader.child(parent)? {
            let (mut notation, mut symbol) = (None, Given::default());
            while let Some(tag) = reader.child(&unit)? {
                match tag.name {
                    "NotationIndex" => notation = reader.number(&tag, "notation index")?,
                    "Symbol" => symbol = reader.text(&tag)?,
                    "Index" | "Name" => reader.note_text(&tag)?,
                    _ => reader.unknown(&tag)?,
                }
            }
            match notation {
                Some(notation) => self.units.push((notation, symbol.compact())),
                None => reader.note("Symbol", &symbol),
            }
        }
        Ok(())
    }
}

pub(super) fn missing_index(reader: &mut Reader<'_, '_>, span: Span, message: &str) {
    reader.report(&codes::ESI_MISSING_INDEX, span, message, "left out");
}
