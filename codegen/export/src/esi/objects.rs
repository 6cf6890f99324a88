//! The objects that a device has on EtherCAT.

use crate::note::{NoteKind, Notes, Subject};
use crate::registers;
use lexibus_codegen::ir::{Binding, Bus, Buses, Device, Group, Item};

/// Returns the EtherCAT index and sub-index of an item. If the item has no EtherCAT address, returns its CANopen index and
/// sub-index.
pub(super) fn address(item: &Item) -> Option<(u16, u8)> {
    let on_ethercat = item.bindings.iter().find_map(|binding| match binding {
        Binding::Object { buses, index, sub_index } if buses.coe => Some((*index, *sub_index)),
        _ => None,
    });
    on_ethercat.or_else(|| item.object())
}

/// Returns objects for the registers that belong to no object.
pub(super) fn of_registers(device: &Device, notes: &mut Notes) -> Vec<Group> {
    let objects = registers::objects(device, |item| address(item).filter(|_| is_on_ethercat(device, item)));
    notes.add_many(NoteKind::Completed, registers::completed(&objects), Subject::Device);
    notes.add_many(NoteKind::Duplicate, registers::duplicates(device, address), Subject::Device);
    objects
}

/// Returns whether an item exists on EtherCAT. If the device is not an EtherCAT slave, all its items count as EtherCAT items.
fn is_on_ethercat(device: &Device, item: &Item) -> bool {
    let buses = item.availability.as_ref().map_or(Buses::NONE, |availability| availability.buses);
    let has_address = item.bindings.iter().any(|binding| matches!(binding, Binding::Object { buses, .. } if buses.coe));
    device.ethercat.is_none() || has_address && (buses.is_empty() || buses.contains(Bus::EtherCat))
}

/// Returns the objects of a device that exist on EtherCAT, including the objects in `of_registers`. If the device has
/// CANopen but not EtherCAT, objects that describe CAN services are left out. Adds a note for each object that is left
/// out.
pub(super) fn of_device<'g>(device: &'g Device, of_registers: &'g [Group], notes: &mut Notes) -> Vec<&'g Group> {
    let is_canopen_only = device.canopen.is_some() && device.ethercat.is_none();
    let mut objects = all(device.groups.iter().chain(of_registers), notes);
    objects.retain(|group| {
        let is_of_can = is_canopen_only && group.index().is_some_and(is_of_can);
        let is_absent = !group.items.is_empty() && !group.items.iter().any(|item| is_on_ethercat(device, item));
        let is_left_out = is_of_can || is_absent;
        notes.add_many(NoteKind::CanObject, is_left_out, Subject::object(group));
        !is_left_out
    });
    objects
}

/// Sorts the objects of `groups` by index and keeps one object per index.
pub(super) fn all<'g>(groups: impl Iterator<Item = &'g Group>, notes: &mut Notes) -> Vec<&'g Group> {
    let mut objects: Vec<&Group> = groups.filter(|group| group.index().is_some()).collect();
    objects.sort_by_key(|group| group.index());
    objects.dedup_by(|later, earlier| {
        let is_twice = later.index() == earlier.index();
        notes.add_many(NoteKind::Duplicate, is_twice, Subject::object(later));
        is_twice
    });
    objects
}

/// Returns whether a CiA 301 object describes a CAN service that ETG.1000.6 does not have: SYNC, TIME, EMCY, guarding,
/// heartbeat, error behavior, SDO channels or PDO communication.
fn is_of_can(index: u16) -> bool {
    matches!(index, 0x1005..=0x1007 | 0x100C..=0x100D | 0x1012..=0x1017 | 0x1019 | 0x1028..=0x1029 | 0x1200..=0x12FF)
        || matches!(index, 0x1400..=0x15FF | 0x1800..=0x19FF)
}
