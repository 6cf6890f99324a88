//! Values and PDOs as the description of a device states them.

use lexibus_codegen::ir::{Device, Direction};
use lexibus_codegen::source::Span;

use crate::declared::DeclaredPdo;
use crate::model::{communication_index, MappedObject, NetworkPdo, DISABLED};

/// Returns the initial value of an object in the description.
pub(super) fn initial(device: &Device, (index, sub_index): (u16, u8), id: u8) -> Option<i128> {
    device.entry(index, sub_index)?.initial()?.resolved(id).as_int()
}

/// Returns the direction of a declared PDO.
pub(super) fn direction(declared: &DeclaredPdo) -> Direction {
    if declared.is_tpdo {
        Direction::Transmit
    } else {
        Direction::Receive
    }
}

/// Returns the PDOs of a device with the values of its description.
pub(super) fn described(device: &Device, direction: Direction, id: u8) -> Vec<NetworkPdo> {
    (1..=512).filter_map(|number| pdo(device, direction, number, id)).collect()
}

/// Returns a PDO with the values of its description. Returns `None` if the device does not have the PDO.
pub(super) fn pdo(device: &Device, direction: Direction, number: u16, id: u8) -> Option<NetworkPdo> {
    let index = communication_index(direction, number);
    device.object(index)?;
    let last = initial(device, (index, 0), id).unwrap_or(i128::from(u8::MAX));
    let value = |sub_index: u8| initial(device, (index, sub_index), id).filter(|_| last >= sub_index.into());
    let cob_id = value(1).map_or(DISABLED, |cob_id| cob_id as u32);
    let is_sender = direction == Direction::Transmit;
    Some(NetworkPdo {
        direction,
        number,
        span: Span::MISSING,
        is_enabled: false,
        cob_id,
        cob_id_at: Span::MISSING,
        transmission: value(2).unwrap_or(0) as u8,
        inhibit_time: value(3).filter(|_| is_sender).unwrap_or(0) as u16,
        event_timer: value(5).filter(|_| is_sender).unwrap_or(0) as u16,
        event_deadline: value(5).filter(|_| !is_sender).unwrap_or(0) as u16,
        sync_start: value(6).filter(|_| is_sender).unwrap_or(0) as u8,
        entries: mapping(device, index + 0x200, id),
    })
}

/// Returns the kind of a multiplexed PDO if the number of mapped objects is the code of one (CiA 301 7.5.2.36).
pub(super) fn multiplexed_name(count: i128) -> Option<&'static str> {
    match count {
        254 => Some("SAM-MPDO"),
        255 => Some("DAM-MPDO"),
        _ => None,
    }
}

fn mapping(device: &Device, index: u16, id: u8) -> Vec<MappedObject> {
    let count = initial(device, (index, 0), id).filter(|count| multiplexed_name(*count).is_none());
    let count = count.and_then(|count| u8::try_from(count).ok()).unwrap_or(0);
    let words = (1..=count.min(64)).filter_map(|sub_index| initial(device, (index, sub_index), id));
    let entry =
        |word: i128| MappedObject { index: (word >> 16) as u16, sub_index: (word >> 8) as u8, bits: word as u8 };
    words.filter(|word| *word != 0).map(entry).collect()
}
