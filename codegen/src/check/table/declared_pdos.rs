//! Compares the PDOs of a table with the mapped items. For devices without CANopen settings, also compares the default
//! values of mapping objects.

use crate::check::context::Context;
use crate::check::mapped_object::{direction_of, Described, Mapped, CAN_BITS};
use crate::diagnostics::{codes, Diagnostics};
use crate::ir::{Device, Group, Item, Pdo, PdoEntryKind};
use crate::number::hex16;

/// Reports PDO entries that contradict the mapped items, and PDOs that are too long. Other lints check the mapping
/// objects of CANopen devices. For EtherCAT devices, missing objects and wrong lengths are already reported elsewhere.
pub(crate) fn check(context: &Context<'_>, diagnostics: &mut Diagnostics) {
    let device = context.device;
    let described = Described::new(device);
    for pdo in device.process_data.pdos.iter().filter(|pdo| !pdo.from_object) {
        let has_object = |kind| !matches!(kind, PdoEntryKind::Padding | PdoEntryKind::Unnumbered);
        for entry in pdo.entries.iter().filter(|entry| has_object(entry.kind)) {
            let (object, span) = ((entry.index, entry.sub_index), entry.origin.span);
            let mapped = Mapped { object, bits: entry.bits, direction: pdo.direction, span };
            mapped.check(&described, device.ethercat.is_some(), diagnostics);
        }
        length(device, pdo, diagnostics);
    }
    if device.canopen.is_none() {
        device.groups.iter().for_each(|group| defaults(&described, group, diagnostics));
    }
}

fn length(device: &Device, pdo: &Pdo, diagnostics: &mut Diagnostics) {
    let (bits, index) = (pdo.bits(), pdo.mapping_index);
    let mut report = |message| diagnostics.push(codes::PDO_TOO_LONG.at(pdo.origin.span, message));
    if let Some(max) = pdo.max_bytes.map(|max| u32::from(max) * 8).filter(|&max| bits > max) {
        report(format!("the PDO {} has {bits} bits, but at most {max} bits are allowed", hex16(index)));
    }
    if device.canopen.is_some() && device.ethercat.is_none() && bits > CAN_BITS {
        report(format!("the PDO {} has {bits} bits, but a CAN frame carries at most 64 data bits", hex16(index)));
    }
}

/// Checks the default values of the entries in a mapping object.
fn defaults(described: &Described<'_>, group: &Group, diagnostics: &mut Diagnostics) {
    let Some(direction) = group.index().and_then(direction_of) else { return };
    let count = group.sub(0).and_then(Item::default_integer).unwrap_or(i128::MAX);
    for item in &group.items {
        let Some((_, sub @ 1..)) = item.object() else { continue };
        let span = item.at.default.or(item.origin.span);
        let word = item.default_integer().filter(|_| i128::from(sub) <= count);
        if let Some(mapped) = word.and_then(|word| Mapped::word(word, direction, span)) {
            mapped.check(described, false, diagnostics);
        }
    }
}
