//! Names of PDOs: by number on CANopen, by index on EtherCAT.

use std::collections::HashMap;

use super::number::hex16;
use crate::ir::{Device, Direction, Mappable, ObjectBuses, Pdo, PdoEntryKind};

/// Returns the buses on which a device has objects.
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
    let mut mapped: HashMap<(u16, u8), Mappable> = HashMap::new();
    for pdo in pdos {
        for entry in pdo.entries.iter().filter(|entry| entry.kind == PdoEntryKind::Item) {
            let mappable = mapped.entry((entry.index, entry.sub_index)).or_default();
            mappable.rpdo |= pdo.direction == Direction::Receive;
            mappable.tpdo |= pdo.direction == Direction::Transmit;
        }
    }
    mapped
}
