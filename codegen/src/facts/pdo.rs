//! PDOs: names (by number on CANopen, by index on EtherCAT), changeable mappings, and objects that can be mapped.

use super::types;
use crate::collections::HashMap;
use crate::ir::{
    Coe, Device, Direction, Group, Item, Mappable, ObjectBuses, Pdo, PdoEntryKind, Type, TypeDef, MAX_PDO_SUBS,
};
use crate::number::hex16;

/// Maximum length in bits of a mapped entry. A mapping value has 8 bits for the length of the entry.
pub const MAX_ENTRY: u32 = 0xFF;

/// Maximum length of a sync manager in bytes. The length register of a sync manager has 16 bits (ETG.1000.4 6.7.2).
const MAX_SYNC_MANAGER: u16 = u16::MAX;

/// Returns the buses on which a device has objects. A description that contains only a dictionary counts as EtherCAT.
/// Any other device with neither CANopen nor EtherCAT settings counts as a CANopen device.
pub fn buses(device: &Device) -> ObjectBuses {
    let is_ethercat = device.ethercat.is_some() || device.dictionary_only;
    ObjectBuses { canopen: device.canopen.is_some() || !is_ethercat, coe: is_ethercat }
}

/// Returns the name of a PDO: `RPDO 1` on CANopen, `RxPDO 0x1701` on EtherCAT, `RPDO 1 / RxPDO 0x1600` on both. The numbers of
/// PDOs are counted from 1 (CiA 301, 7.5.2.35).
pub fn title(pdo: &Pdo, buses: ObjectBuses) -> String {
    let buses = pdo.buses.unwrap_or(buses);
    let (canopen, coe) = match pdo.direction {
        Direction::Receive => ("RPDO", "RxPDO"),
        Direction::Transmit => ("TPDO", "TxPDO"),
    };
    let by_index = match pdo.mapping_index {
        0 => coe.to_owned(),
        index => format!("{coe} {}", hex16(index)),
    };
    match (buses.canopen, buses.coe) {
        (false, _) => by_index,
        (true, false) => format!("{canopen} {}", pdo.number),
        (true, true) => format!("{canopen} {} / {by_index}", pdo.number),
    }
}

/// Returns the objects that PDOs map, with the directions of these PDOs. Objects in this map can be mapped, even if the
/// description does not state that they are mappable.
pub fn mapped_objects(pdos: &[Pdo]) -> HashMap<(u16, u8), Mappable> {
    let mut mapped: HashMap<(u16, u8), Mappable> = HashMap::default();
    for pdo in pdos {
        for entry in pdo.entries.iter().filter(|entry| entry.kind == PdoEntryKind::Item) {
            let mappable = mapped.entry((entry.index, entry.sub_index)).or_default();
            mappable.rpdo |= pdo.direction == Direction::Receive;
            mappable.tpdo |= pdo.direction == Direction::Transmit;
        }
    }
    mapped
}

/// Returns the PDOs that can map an item. `mapped` contains the objects that PDOs map by default.
pub fn mappable(item: &Item, mapped: &HashMap<(u16, u8), Mappable>) -> Mappable {
    let by_default = item.object().and_then(|address| mapped.get(&address)).copied().unwrap_or_default();
    Mappable { rpdo: item.mappable.rpdo || by_default.rpdo, tpdo: item.mappable.tpdo || by_default.tpdo }
}

/// Returns the length in bits of an item in a PDO. A string always has its maximum length in a PDO. Returns `None` if the length
/// is unknown, or if no entry can have this length.
pub fn mapped_bits(item: &Item, types: &[TypeDef]) -> Option<u32> {
    let bits = match types::basic(types, item.object_type()) {
        Type::VisibleString(Some(bytes)) | Type::OctetString(Some(bytes)) => bytes.checked_mul(8),
        basic => basic.bits(),
    };
    bits.filter(|bits| (1..=MAX_ENTRY).contains(bits))
}

/// Returns whether the mapping of a PDO can be changed. Does not check whether the mapping object is writable.
pub fn is_changeable(pdo: &Pdo) -> bool {
    !(pdo.fixed || pdo.is_virtual || pdo.depends_on_slot || pdo.depends_on_slot_group)
}

/// Returns whether an object contains the mapping of a PDO (CiA 301 7.5.2.36 and 7.5.2.38).
pub fn is_mapping(index: u16) -> bool {
    matches!(index, 0x1600..=0x17FF | 0x1A00..=0x1BFF)
}

/// Returns the number of consecutive writable entries in a mapping object, counted from sub-index 1, up to `MAX_PDO_SUBS`.
/// Returns `None` if there are none, or if the number of entries cannot be written.
pub fn writable_entries(mapping: &Group) -> Option<usize> {
    let is_writable = |sub: &u8| mapping.sub(*sub).is_some_and(|item| item.access.writable());
    let entries = (1..=u8::MAX).take_while(is_writable).count().min(MAX_PDO_SUBS);
    (is_writable(&0) && entries > 0).then_some(entries)
}

/// Returns whether an EtherCAT device allows a master to write mappings.
pub fn configures(device: &Device) -> bool {
    coe(device).is_some_and(|coe| coe.pdo_config)
}

/// Returns whether an EtherCAT device allows a master to write the assignment of PDOs to sync managers.
pub fn assigns(device: &Device) -> bool {
    coe(device).is_some_and(|coe| coe.pdo_assign)
}

fn coe(device: &Device) -> Option<&Coe> {
    device.ethercat.as_ref()?.mailbox.as_ref()?.coe.as_ref()
}

/// Returns the maximum length of a PDO on EtherCAT in bytes.
pub fn max_bytes_on_ethercat(device: &Device, pdo: &Pdo) -> u16 {
    let managers = &device.process_data.sync_managers;
    let sync_manager = managers.iter().find(|manager| Some(manager.number) == pdo.sync_manager);
    let bytes = sync_manager.and_then(|manager| manager.size_range.1).unwrap_or(MAX_SYNC_MANAGER);
    pdo.max_bytes.map_or(bytes, |maximum| maximum.min(bytes))
}
