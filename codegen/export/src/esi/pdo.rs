//! Writes PDOs and their entries.

use super::dictionary::entry_type;
use super::text::{hex, names};
use super::types::Types;
use crate::note::{NoteKind, Subject};
use crate::xml::Xml;
use lexibus_codegen::ir::{Direction, Pdo, PdoEntry, Type};

/// Writes a PDO. `is_slave` states whether the device is an EtherCAT slave. The CAN communication parameters of an
/// EtherCAT slave are left out with a note.
pub(super) fn write(xml: &mut Xml, types: &Types<'_>, pdo: &Pdo, is_slave: bool) {
    let subject = Subject::Object(pdo.mapping_index);
    xml.open(if pdo.direction == Direction::Receive { "RxPdo" } else { "TxPdo" });
    attributes(xml, pdo);
    slot_index(xml, "Index", pdo.mapping_index, pdo.depends_on_slot, pdo.depends_on_slot_group);
    names(xml, "Name", &pdo.name, &pdo.names, subject);
    pdo.excludes.iter().for_each(|excluded| xml.leaf("Exclude", hex(*excluded, 4)));
    pdo.entries.iter().for_each(|each| entry(xml, types, each));
    pdo.excluded_sync_managers.iter().for_each(|number| xml.leaf("ExcludedSm", number));
    xml.close();
    xml.notes.add_many(NoteKind::Extension, pdo.extensions.len(), subject);
    xml.notes.add_many(NoteKind::Pdo, pdo.communication.is_some() && is_slave, subject);
    xml.notes.add_many(NoteKind::Documentation, pdo.documentation.is_some(), subject);
    xml.notes.add_many(NoteKind::Doubt, pdo.doubts.len(), subject);
}

fn attributes(xml: &mut Xml, pdo: &Pdo) {
    xml.flag("Fixed", pdo.fixed, "true");
    xml.flag("Mandatory", pdo.mandatory, "true");
    xml.flag("Virtual", pdo.is_virtual, "true");
    xml.optional("Sm", pdo.sync_manager);
    xml.optional("Su", pdo.sync_unit);
    if let Some(oversampling) = &pdo.oversampling {
        xml.optional("OSFac", oversampling.factor);
        xml.optional("OSMin", oversampling.min);
        xml.optional("OSMax", oversampling.max);
        xml.optional("OSIndexInc", oversampling.index_increment);
    }
    xml.flag("OverwrittenByModule", pdo.overwritten_by_module, "true");
    xml.optional("PdoOrder", pdo.order);
    xml.optional("SRA_Parameter", pdo.sra_parameter);
}

/// Writes an index. The flags state whether the index increases with the slot and with the slot group.
pub(super) fn slot_index(
    xml: &mut Xml,
    element: &'static str,
    index: u16,
    depends_on_slot: bool,
    depends_on_slot_group: bool,
) {
    xml.open(element);
    xml.flag("DependOnSlot", depends_on_slot, "true");
    xml.flag("DependOnSlotGroup", depends_on_slot_group, "true");
    xml.content(hex(index, 4));
    xml.close();
}

fn entry(xml: &mut Xml, types: &Types<'_>, entry: &PdoEntry) {
    xml.open("Entry");
    xml.flag("Fixed", entry.fixed, "true");
    slot_index(xml, "Index", entry.index, entry.depends_on_slot, entry.depends_on_slot_group);
    xml.optional_leaf("SubIndex", Some(entry.sub_index).filter(|sub_index| entry.index != 0 || *sub_index != 0));
    xml.leaf("BitLen", entry.bits);
    if !entry.name.is_empty() || !entry.names.is_empty() {
        names(xml, "Name", &entry.name, &entry.names, Subject::Entry(entry.index, entry.sub_index));
    }
    xml.optional_leaf("DataType", entry_type(types, data_type(types, entry)));
    xml.close();
}

/// Returns the data type of a PDO entry. If the mapped length differs from the length of the type and is at most 64
/// bits, returns an unsigned integer of the mapped length. The export of an ESI keeps the original type.
fn data_type(types: &Types<'_>, entry: &PdoEntry) -> Type {
    let is_whole = types.underlying(entry.ty).bits().is_none_or(|bits| bits == entry.bits);
    match u8::try_from(entry.bits) {
        Ok(bits @ 1..=64) if !is_whole && !types.is_esi => Type::Unsigned(bits),
        _ => entry.ty,
    }
}
