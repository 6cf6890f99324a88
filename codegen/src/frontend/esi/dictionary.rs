//! Dictionaries: the parts of them as they stand in the file, and what becomes of those in a device or module.

use compact_str::format_compact;

use super::data_type::{self, RawType};
use super::object::{self, RawObject, RawSub};
use super::reader::{note, shortened, Given, Read, Reader};
use crate::diagnostics::codes;
use crate::ir::{CompactString, Extensions};
use crate::source::Span;
use crate::syntax::xml::Tag;

/// What the dictionaries of one device or module say; data types may stand behind the objects that name them.
#[derive(Default)]
pub(super) struct Dictionary<'a> {
    pub types: Vec<RawType<'a>>,
    pub objects: Vec<RawObject<'a>>,
    /// The sub-items of all objects.
    pub subs: Vec<RawSub<'a>>,
    /// Symbols of units that it defines, by notation index.
    pub units: Vec<(u32, CompactString)>,
    pub extensions: Extensions,
}

impl<'a> Dictionary<'a> {
    /// Reads a Dictionary, and adds it to what was read before.
    pub fn read(&mut self, reader: &mut Reader<'a, '_>, parent: &Tag<'a>) -> Read<()> {
        while let Some(list) = reader.cursor.child(parent)? {
            match list.name {
                "DataTypes" => {
                    while let Some(tag) = reader.cursor.child(&list)? {
                        match tag.name {
                            "DataType" => {
                                self.types.push(RawType::default());
                                if let Some(last) = self.types.last_mut() {
                                    data_type::read(reader, &tag, last)?;
                                }
                            }
                            _ => reader.unknown(&tag, &mut self.extensions)?,
                        }
                    }
                }
                "Objects" => {
                    while let Some(tag) = reader.cursor.child(&list)? {
                        match tag.name {
                            "Object" => {
                                let object = object::read(reader, &tag, self)?;
                                self.objects.push(object);
                            }
                            _ => reader.unknown(&tag, &mut self.extensions)?,
                        }
                    }
                }
                "UnitTypes" => self.unit_types(reader, &list)?,
                _ => reader.unknown(&list, &mut self.extensions)?,
            }
        }
        Ok(())
    }

    fn unit_types(&mut self, reader: &mut Reader<'a, '_>, parent: &Tag<'a>) -> Read<()> {
        while let Some(unit) = reader.cursor.child(parent)? {
            let (mut notation, mut symbol) = (None, Given::default());
            while let Some(tag) = reader.cursor.child(&unit)? {
                match tag.name {
                    "NotationIndex" => notation = reader.number(&tag, "notation index", &mut self.extensions)?,
                    "Symbol" => symbol = reader.leaf(&tag, &mut self.extensions)?,
                    "Index" | "Name" => reader.note(&tag, &mut self.extensions)?,
                    _ => reader.unknown(&tag, &mut self.extensions)?,
                }
            }
            match notation {
                Some(notation) => self.units.push((notation, symbol.compact())),
                None => note("Symbol", &symbol, &mut self.extensions),
            }
        }
        Ok(())
    }

    /// What of the dictionary has no place in the IR, with what its data types and their sub-items say beyond that.
    pub fn take_extensions(&mut self) -> Extensions {
        let mut extensions = std::mem::take(&mut self.extensions);
        for ty in &mut self.types {
            let of_fields = ty.fields.iter_mut().flat_map(|field| field.extensions.drain(..));
            for mut extension in ty.extensions.drain(..).chain(of_fields) {
                extension.key = format_compact!("{}/{}", shortened(&ty.name.text), extension.key);
                extensions.push(extension);
            }
        }
        extensions
    }
}

pub(super) fn missing_index(reader: &mut Reader<'_, '_>, span: Span, message: &str) {
    reader.report(&codes::ESI_MISSING_INDEX, span, message, "left out");
}
