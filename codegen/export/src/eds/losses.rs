//! Notes about facts that CiA 306 cannot express.

use super::mapping;
use super::note::{self, NoteKind, Notes, Subject};
use super::registers;
use super::section::BIT_RATES;
use super::{is_coe_only, Context, Flavor};
use lexibus_codegen::ir::{Behavior, Binding, Catalog, Device, Group, GroupKind, Item, Module, ObjectBuses};

/// Adds notes for facts of the device and its PDOs that CiA 306 cannot express, and for objects and items that are left
/// out.
pub(super) fn of_device(context: &Context<'_>, catalog: &Catalog, notes: &mut Notes) {
    let (device, subject) = (context.device, Subject::Device);
    if context.flavor == Flavor::Eds && (device.commissioning.is_some() || !device.header.last_eds.is_empty()) {
        notes.add(NoteKind::Configuration, subject);
    }
    let other_buses = usize::from(device.ethercat.is_some()) + usize::from(device.profinet.is_some());
    notes.add_many(NoteKind::OtherBus, other_buses + device.modbus.len(), subject);
    notes.add_many(NoteKind::Slot, device.slots.len(), subject);
    let parts = note::parts_of_tables(device)
        + device.code_tables.len()
        + catalog.code_tables.len()
        + device.submodules.len()
        + device.process_data.images.len();
    notes.add_many(NoteKind::OtherPart, parts, subject);
    note::of_device(catalog, device, notes, subject);
    notes.add_many(NoteKind::Language, device.names.len(), subject);
    notes.add_many(NoteKind::Documentation, device.documentation.is_some(), subject);
    notes.add_many(NoteKind::Duplicate, registers::duplicates(device, Item::object), subject);
    settings(device, notes);
    pdos(device, notes);
    for group in device.groups.iter().filter(|group| is_coe_only(device, group)) {
        notes.add(NoteKind::CoeOnly, Subject::object(group));
    }
    note::of_chapters(device, notes);
}

fn settings(device: &Device, notes: &mut Notes) {
    let Some(canopen) = &device.canopen else { return };
    let other_rates = canopen.bit_rates.iter().filter(|rate| !BIT_RATES.contains(rate)).count();
    notes.add_many(NoteKind::Setting, other_rates + usize::from(canopen.auto_bit_rate), Subject::Device);
}

/// Adds notes for PDOs that have no mapping object in the file, for communication parameters without a communication
/// object, and for facts of PDOs that CiA 306 cannot express.
fn pdos(device: &Device, notes: &mut Notes) {
    for pdo in device.process_data.pdos.iter().filter(|pdo| !pdo.implicit) {
        let subject = Subject::Object(pdo.mapping_index);
        let is_lost = |index| device.object(index).is_none();
        let is_written = pdo.entries.is_empty() || !is_lost(pdo.mapping_index) || mapping::is_expressible(pdo);
        notes.add_many(NoteKind::Pdo, !is_written, subject);
        let communication = pdo.communication.as_ref().filter(|communication| is_lost(communication.index));
        notes.add_many(NoteKind::Pdo, communication.iter().count(), subject);
        notes.add_many(NoteKind::Language, !pdo.names.is_empty(), subject);
        notes.add_many(NoteKind::Extension, pdo.extensions.len(), subject);
        notes.add_many(NoteKind::Documentation, pdo.documentation.is_some(), subject);
        notes.add_many(NoteKind::Doubt, pdo.doubts.len(), subject);
    }
}

/// Adds notes for the facts of a module that CiA 306 cannot express, except those of its objects.
pub(super) fn of_module(module: &Module, notes: &mut Notes) {
    let subject = Subject::Named(&module.name);
    notes.add_many(NoteKind::Language, module.names.len(), subject);
    notes.add_many(NoteKind::Documentation, module.documentation.is_some(), subject);
}

/// Adds notes for the facts of an object that CiA 306 cannot express, except those of its entries. Adds a note for each
/// item without an object address.
pub(super) fn of_object(context: &Context<'_>, group: &Group, notes: &mut Notes) {
    let subject = Subject::object(group);
    notes.add_many(NoteKind::Language, group.names.len(), subject);
    notes.add_many(NoteKind::Documentation, group.documentation.is_some(), subject);
    notes.add_many(NoteKind::Doubt, group.doubts.len(), subject);
    notes.add_many(NoteKind::Setting, group.tool_flags.is_some(), subject);
    // For a CANopen device, the object lists of the EDS express which objects are mandatory.
    let has_category = matches!(group.kind, GroupKind::Object { category: Some(_), .. });
    notes.add_many(NoteKind::Category, has_category && !context.is_canopen, subject);
    for item in group.items.iter().filter(|item| item.object().is_none()) {
        notes.add(NoteKind::NotAnObject, Subject::item(item));
    }
}

/// Adds notes for the facts of an entry that CiA 306 cannot express, except its value.
pub(super) fn of_item(item: &Item, notes: &mut Notes) {
    let subject = Subject::item(item);
    let is_other = |binding: &Binding| match binding {
        Binding::Object { buses: ObjectBuses { canopen, .. }, .. } => !canopen && item.bindings.len() > 1,
        _ => true,
    };
    notes.add_many(NoteKind::Binding, item.bindings.iter().filter(|binding| is_other(binding)).count(), subject);
    notes.add_many(NoteKind::Language, item.names.len(), subject);
    notes.add_many(NoteKind::Quantity, item.quantity.is_some(), subject);
    let is_lost = |behavior: &Behavior| *behavior != Behavior { srdo: behavior.srdo, ..Behavior::default() };
    notes.add_many(NoteKind::Behavior, item.behavior.as_deref().is_some_and(is_lost), subject);
    note::of_item(item, notes, subject);
    notes.add_many(NoteKind::Documentation, item.documentation.is_some(), subject);
    notes.add_many(NoteKind::AllowedValues, !item.limits.allowed.is_empty(), subject);
}
