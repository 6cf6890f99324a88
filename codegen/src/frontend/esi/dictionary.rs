//! Reads `Dictionary` elements, before references are resolved.

use super::data_type::{self, RawType};
use super::object::{self, RawObject, RawSub};
use super::reader::Reader;
use crate::diagnostics::codes;
use crate::frontend::xml::{Given, Read};
use crate::ir::CompactString;
use crate::source::Span;
use crate::syntax::xml::Tag;

/// Contents of the dictionaries of a device or module. A data type may come after the objects that use it.
#[derive(Default)]
pub(super) struct Dictionary<'a> {
    pub types: Vec<RawType<'a>>,
    pub objects: Vec<RawObject<'a>>,
    /// Sub-items of all objects.
    pub subs: Vec<RawSub<'a>>,
    /// Notation indices and symbols of the units that the dictionary defines.
    pub units: Vec<(u32, CompactString)>,
}

impl<'a> Dictionary<'a> {
    /// Reads a `Dictionary` element and adds its contents to `self`.
    pub fn read(&mut self, reader: &mut Reader<'a, '_>, parent: &Tag<'a>) -> Read<()> {
        while let Some(list) = reader.child(parent)? {
            match list.name {
                "DataTypes" => reader.each(&list, "DataType", |reader, tag| {
                    self.types.push(RawType::default());
                    self.types.last_mut().map_or(Ok(()), |last| data_type::read(reader, tag, last))
                })?,
                "Objects" => reader.each(&list, "Object", |reader, tag| {
                    self.objects.push(object::read(reader, tag, &mut self.subs)?);
                    Ok(())
                })?,
                "UnitTypes" => self.unit_types(reader, &list)?,
                _ => reader.unknown(&list)?,
            }
        }
        // The unused capacity is freed, because the lists stay in memory while the items are created from them.
        self.types.shrink_to_fit();
        self.objects.shrink_to_fit();
        self.subs.shrink_to_fit();
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
