//! Writes the EEPROM content and the registers of the EtherCAT slave controller (ESC).

use super::text::hex;
use super::Context;
use crate::note::{NoteKind, Subject};
use crate::types::hex_digits;
use crate::xml::Xml;
use lexibus_codegen::ir::EtherCatSettings;

/// Addresses of the ESC registers that the schema defines.
const REGISTERS: [u16; 4] = [0x0108, 0x0400, 0x0410, 0x0420];

/// Writes the ESC element with the register values of the slave controller. Writes nothing if the source has none.
pub(super) fn registers(xml: &mut Xml, settings: &EtherCatSettings) {
    if settings.registers.is_empty() {
        return;
    }
    xml.open("ESC");
    let mut known: Vec<(u16, u32)> = settings.registers.clone();
    known.retain(|(address, _)| REGISTERS.contains(address));
    known.sort_by_key(|(address, _)| *address);
    known.dedup_by_key(|(address, _)| *address);
    for (address, value) in &known {
        xml.leaf(format!("Reg{address:04X}"), hex(*value, 1));
    }
    xml.close();
    xml.notes.add_many(NoteKind::Setting, settings.registers.len() - known.len(), Subject::Named("ESC"));
}

/// Writes the Eeprom element if the source describes the EEPROM. The element contains either the complete data, or the
/// size, the configuration data, and optionally bootstrap data and categories. If neither the complete data nor the
/// size is known, writes no element and adds a note.
pub(super) fn write(xml: &mut Xml, context: &mut Context<'_>, settings: &EtherCatSettings) {
    let Some(eeprom) = settings.eeprom.as_deref() else { return };
    let subject = Subject::Named("Eeprom");
    // The complete data imply the size.
    let given = if eeprom.data.is_empty() { context.options.eeprom_size() } else { None };
    let size = given.or(eeprom.byte_size);
    if eeprom.data.is_empty() && size.is_none() {
        return xml.notes.add(NoteKind::Incomplete, subject);
    }
    xml.open("Eeprom");
    xml.flag("AssignToPdi", eeprom.assign_to_pdi, "true");
    match (eeprom.data.is_empty(), size) {
        (true, Some(size)) => {
            xml.leaf("ByteSize", size);
            xml.leaf("ConfigData", hex_digits(&eeprom.config_data));
            xml.text_leaf("BootStrap", &hex_digits(&eeprom.boot_strap));
            for (number, data) in &eeprom.categories {
                xml.leaves("Category", &[("CatNo", &number), ("Data", &hex_digits(data))]);
            }
        }
        _ => {
            xml.leaf("Data", hex_digits(&eeprom.data));
            let others = usize::from(eeprom.byte_size.is_some())
                + usize::from(!eeprom.config_data.is_empty())
                + usize::from(!eeprom.boot_strap.is_empty())
                + eeprom.categories.len();
            xml.notes.add_many(NoteKind::Setting, others, subject);
        }
    }
    xml.close();
}
