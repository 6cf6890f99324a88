//! Reads the contents of the EEPROM, and register values of the slave controller.

use super::reader::Reader;
use crate::frontend::xml::Read;
use crate::ir::{Eeprom, EtherCatSettings};
use crate::syntax::xml::Tag;

/// Reads an `Eeprom` element.
pub(super) fn read<'a>(reader: &mut Reader<'a, '_>, parent: &Tag<'a>) -> Read<Eeprom> {
    let [assign] = reader.attributes(parent, ["AssignToPdi"])?;
    let mut eeprom = Eeprom { assign_to_pdi: reader.flag(&assign), ..Eeprom::default() };
    while let Some(tag) = reader.child(parent)? {
        match tag.name {
            "Data" => eeprom.data = octets(reader, &tag)?,
            "ByteSize" => eeprom.byte_size = reader.number(&tag, "size in bytes")?,
            "ConfigData" => eeprom.config_data = octets(reader, &tag)?,
            "BootStrap" => eeprom.boot_strap = octets(reader, &tag)?,
            "Category" => eeprom.categories.extend(category(reader, &tag)?),
            "VendorSpecific" => reader.vendor_specific(&tag)?,
            _ => reader.unknown(&tag)?,
        }
    }
    Ok(eeprom)
}

fn octets<'a>(reader: &mut Reader<'a, '_>, tag: &Tag<'a>) -> Read<Vec<u8>> {
    let given = reader.text(tag)?;
    Ok(reader.octets(&given).unwrap_or_default())
}

/// Reads the number and the content of an EEPROM category. The file contains the content as bytes, a text or a number.
/// Returns `None` for a category without a number.
fn category<'a>(reader: &mut Reader<'a, '_>, parent: &Tag<'a>) -> Read<Option<(u16, Vec<u8>)>> {
    let [preserve] = reader.attributes(parent, ["PreserveOnlineData"])?;
    reader.note("Category@PreserveOnlineData", &preserve);
    let (mut number, mut data) = (None, Vec::new());
    while let Some(tag) = reader.child(parent)? {
        match tag.name {
            "CatNo" => number = reader.number(&tag, "category number")?,
            "Data" => data = octets(reader, &tag)?,
            "DataString" => data = reader.text(&tag)?.text.as_bytes().to_vec(),
            "DataUINT" => data = reader.number(&tag, "16-bit number")?.unwrap_or(0u16).to_le_bytes().to_vec(),
            "DataUDINT" => data = reader.number(&tag, "32-bit number")?.unwrap_or(0u32).to_le_bytes().to_vec(),
            _ => reader.unknown(&tag)?,
        }
    }
    Ok(number.map(|number| (number, data)))
}

/// Reads an `ESC` element. The names of its child elements contain register addresses, as in `Reg0108`.
pub(super) fn registers<'a>(
    reader: &mut Reader<'a, '_>,
    parent: &Tag<'a>,
    settings: &mut EtherCatSettings,
) -> Read<()> {
    while let Some(tag) = reader.child(parent)? {
        let address = tag.name.strip_prefix("Reg").filter(|digits| digits.len() == 4);
        match address.and_then(|digits| u16::from_str_radix(digits, 16).ok()) {
            Some(address) => {
                let value = reader.number(&tag, "register value")?;
                settings.registers.extend(value.map(|value| (address, value)));
            }
            None if tag.name == "VendorSpecific" => reader.vendor_specific(&tag)?,
            None => reader.unknown(&tag)?,
        }
    }
    Ok(())
}
