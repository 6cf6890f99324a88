//! Facts that CiA 306 has no place for.

use super::mapping;
use super::note::{self, NoteKind, Notes, Place};
use super::registers;
use super::section::BIT_RATES;
use super::{is_coe_only, Context, Flavour};
use lexibus_codegen::ir::{Binding, Catalog, Device, Group, GroupKind, Item, Module, ObjectBuses};

/// What the device has beside objects.
pub(super) fn of_device(context: &Context<'_>, catalog: &Catalog, notes: &mut Notes) {
    let (device, place) = (context.device, Place::Device);
    if context.flavour == Flavour::Eds && (device.commissioning.is_some() || !device.header.last_eds.is_empty()) {
        notes.add(NoteKind::Configuration, place);
    }
    let other_buses = usize::from(device.ethercat.is_some()) + usize::from(device.profinet.is_some());
    notes.add_many(NoteKind::OtherBus, other_buses + device.modbus.len(), place);
    notes.add_many(NoteKind::Slot, device.slots.len(), place);
    let parts = note::parts_of_tables(device)
        + device.code_tables.len()
        + catalog.code_tables.len()
        + device.submodules.len()
        + device.process_data.images.len();
    notes.add_many(NoteKind::OtherPart, parts, place);
    let axes = device.axes.as_ref().map_or(0, |rule| usize::from(rule.axes.saturating_sub(1)));
    notes.add_many(NoteKind::Axis, axes, place);
    notes.add_many(NoteKind::Language, device.names.len(), place);
    notes.add_many(NoteKind::Documentation, usize::from(device.documentation.is_some()), place);
    notes.add_many(NoteKind::Doubt, device.doubts.len(), place);
    notes.add_many(NoteKind::Duplicate, registers::duplicates(device, Item::object), place);
    settings(device, notes);
    pdos(device, notes);
    for group in device.groups.iter().filter(|group| is_coe_only(device, group)) {
        notes.add(NoteKind::CoeOnly, Place::object(group));
    }
    for group in device.groups.iter().filter(|group| group.index().is_none()) {
        let others = group.items.iter().filter(|item| item.object().is_none()).count();
        notes.add_many(NoteKind::NotAnObject, others, Place::Named(&group.name));
    }
}

fn settings(device: &Device, notes: &mut Notes) {
    let Some(canopen) = &device.canopen else { return };
    let other_rates = canopen.bit_rates.iter().filter(|rate| !BIT_RATES.contains(rate)).count();
    notes.add_many(NoteKind::Setting, other_rates + usize::from(canopen.auto_bit_rate), Place::Device);
}

/// PDOs that don't follow from objects.
fn pdos(device: &Device, notes: &mut Notes) {
    for pdo in device.process_data.pdos.iter().filter(|pdo| !pdo.implicit) {
        let place = Place::Object(pdo.mapping_index);
        let is_lost = |index| device.object(index).is_none();
        let is_told = pdo.entries.is_empty() || !is_lost(pdo.mapping_index) || mapping::can_be_told(pdo);
        notes.add_many(NoteKind::Pdo, usize::from(!is_told), place);
        let communication = pdo.communication.as_ref().filter(|own| is_lost(own.index));
        notes.add_many(NoteKind::Pdo, communication.iter().count(), place);
        notes.add_many(NoteKind::Language, usize::from(!pdo.names.is_empty()), place);
        notes.add_many(NoteKind::Extension, pdo.extensions.len(), place);
        notes.add_many(NoteKind::Documentation, usize::from(pdo.documentation.is_some()), place);
        notes.add_many(NoteKind::Doubt, pdo.doubts.len(), place);
    }
}

/// What a module has beside its objects.
pub(super) fn of_module(module: &Module, notes: &mut Notes) {
    let place = Place::Named(&module.name);
    notes.add_many(NoteKind::Language, module.names.len(), place);
    notes.add_many(NoteKind::Documentation, usize::from(module.documentation.is_some()), place);
}

/// What an object has beside its entries.
pub(super) fn of_object(context: &Context<'_>, group: &Group, notes: &mut Notes) {
    let place = Place::object(group);
    notes.add_many(NoteKind::Language, group.names.len(), place);
    notes.add_many(NoteKind::Documentation, usize::from(group.documentation.is_some()), place);
    notes.add_many(NoteKind::Doubt, group.doubts.len(), place);
    // That an object is optional or mandatory to CANopen is in the object lists.
    let has_category = matches!(group.kind, GroupKind::Object { category: Some(_), .. });
    notes.add_many(NoteKind::Category, usize::from(has_category && !context.is_canopen), place);
    for item in group.items.iter().filter(|item| item.object().is_none()) {
        notes.add(NoteKind::NotAnObject, Place::item(item));
    }
}

/// What an entry has beside its value.
pub(super) fn of_item(item: &Item, notes: &mut Notes) {
    let place = Place::item(item);
    let is_other = |binding: &Binding| match binding {
        Binding::Object { buses: ObjectBuses { canopen, .. }, .. } => !canopen && item.bindings.len() > 1,
        _ => true,
    };
    notes.add_many(NoteKind::Binding, item.bindings.iter().filter(|binding| is_other(binding)).count(), place);
    notes.add_many(NoteKind::Language, item.names.len(), place);
    notes.add_many(NoteKind::Quantity, usize::from(item.quantity.is_some()), place);
    notes.add_many(NoteKind::Behaviour, usize::from(item.behaviour.is_some()), place);
    let variants = item.variants.len();
    notes.add_many(NoteKind::Availability, usize::from(item.availability.is_some()) + variants, place);
    notes.add_many(NoteKind::Relation, note::relations(item), place);
    notes.add_many(NoteKind::Documentation, usize::from(item.documentation.is_some()), place);
    notes.add_many(NoteKind::Doubt, item.doubts.len(), place);
    notes.add_many(NoteKind::AllowedValues, usize::from(!item.limits.allowed.is_empty()), place);
}
