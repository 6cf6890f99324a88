//! Content of the EEPROM, and registers of the slave controller.

use super::reader::{has_attributes, Read, Reader};
use crate::ir::{Eeprom, EtherCatSettings, Extensions};
use crate::syntax::xml::Tag;

/// Reads Eeprom.
pub(super) fn read<'a>(reader: &mut Reader<'a, '_>, parent: &Tag<'a>, extensions: &mut Extensions) -> Read<Eeprom> {
    let [assign] = reader.fields(parent, &["AssignToPdi"], extensions)?;
    let mut eeprom = Eeprom { assign_to_pdi: reader.flag(&assign), ..Eeprom::default() };
    while let Some(tag) = reader.cursor.child(parent)? {
        match tag.name {
            "Data" => eeprom.data = octets(reader, &tag, extensions)?,
            "ByteSize" => eeprom.byte_size = reader.number(&tag, "size in bytes", extensions)?,
            "ConfigData" => eeprom.config_data = octets(reader, &tag, extensions)?,
            "BootStrap" => eeprom.boot_strap = octets(reader, &tag, extensions)?,
            "Category" => {
                let category = category(reader, &tag, extensions)?;
                eeprom.categories.extend(category);
            }
            "VendorSpecific" => reader.vendor_specific(&tag, extensions)?,
            _ => reader.unknown(&tag, extensions)?,
        }
    }
    Ok(eeprom)
}

fn octets<'a>(reader: &mut Reader<'a, '_>, tag: &Tag<'a>, extensions: &mut Extensions) -> Read<Vec<u8>> {
    let given = reader.leaf(tag, extensions)?;
    Ok(reader.octets(&given).unwrap_or_default())
}

/// A category: its number, and its content as bytes, text or number.
fn category<'a>(
    reader: &mut Reader<'a, '_>,
    parent: &Tag<'a>,
    extensions: &mut Extensions,
) -> Read<Option<(u16, Vec<u8>)>> {
    if has_attributes(parent) {
        let [preserve] = reader.fields(parent, &["PreserveOnlineData"], extensions)?;
        super::reader::note("Category@PreserveOnlineData", &preserve, extensions);
    }
    let (mut number, mut data) = (None, Vec::new());
    while let Some(tag) = reader.cursor.child(parent)? {
        match tag.name {
            "CatNo" => number = reader.number(&tag, "number of a category", extensions)?,
            "Data" => data = octets(reader, &tag, extensions)?,
            "DataString" => data = reader.leaf(&tag, extensions)?.text.as_bytes().to_vec(),
            "DataUINT" => {
                let value = reader.number::<u16>(&tag, "number of 16 bits", extensions)?;
                data = value.unwrap_or(0).to_le_bytes().to_vec();
            }
            "DataUDINT" => {
                let value = reader.number::<u32>(&tag, "number of 32 bits", extensions)?;
                data = value.unwrap_or(0).to_le_bytes().to_vec();
            }
            _ => reader.unknown(&tag, extensions)?,
        }
    }
    Ok(number.map(|number| (number, data)))
}

/// Reads ESC: registers are called `Reg0108`, by their address.
pub(super) fn registers<'a>(
    reader: &mut Reader<'a, '_>,
    parent: &Tag<'a>,
    settings: &mut EtherCatSettings,
    extensions: &mut Extensions,
) -> Read<()> {
    while let Some(tag) = reader.cursor.child(parent)? {
        let address = tag.name.strip_prefix("Reg").filter(|digits| digits.len() == 4);
        match address.and_then(|digits| u16::from_str_radix(digits, 16).ok()) {
            Some(address) => {
                let value = reader.number(&tag, "value of a register", extensions)?;
                settings.registers.extend(value.map(|value| (address, value)));
            }
            None if tag.name == "VendorSpecific" => reader.vendor_specific(&tag, extensions)?,
            None => reader.unknown(&tag, extensions)?,
        }
    }
    Ok(())
}
