//! After this pass the PDOs that a register table declares by themselves were held against the items that they map.

use super::owner::Owner;
use crate::diagnostics::{codes, Code, Diagnostic, Diagnostics};
use crate::ir::{Device, Direction, Item, Mappable, Pdo, PdoEntry, PdoEntryKind};

/// Bits of a CAN frame.
const CAN_BITS: u32 = 64;

/// Runs before the PDOs that follow from mapping objects are added: those have checks of their own, as EtherCAT has.
pub(super) fn run(device: &Device, diagnostics: &mut Diagnostics) {
    let owner = Owner { types: &device.types, groups: &[] };
    for pdo in &device.process_data.pdos {
        for entry in pdo.entries.iter().filter(|entry| entry.kind != PdoEntryKind::Padding) {
            let item = device.entry(entry.index, entry.sub_index);
            for (code, problem) in problems(owner, device, pdo, entry, item).into_iter().flatten() {
                let message = format!("0x{:04X} sub-index {:#x} {problem}", entry.index, entry.sub_index);
                let found = Diagnostic::new(code, entry.origin.span, message);
                diagnostics.push(match item {
                    Some(item) => found.note_at(item.origin.span, "the mapped object"),
                    None => found,
                });
            }
        }
        let bits = pdo.bits();
        if device.canopen.is_some() && device.ethercat.is_none() && bits > CAN_BITS {
            let message = format!("the PDO 0x{:04X} has {bits} bits, and a CAN frame has 64", pdo.mapping_index);
            diagnostics.push(Diagnostic::new(&codes::PDO_TOO_LONG, pdo.origin.span, message));
        }
    }
}

fn problems(
    owner: Owner<'_>,
    device: &Device,
    pdo: &Pdo,
    entry: &PdoEntry,
    item: Option<&Item>,
) -> [Option<(&'static Code, String)>; 3] {
    let Some(item) = item else {
        let missing = device.ethercat.is_none() && !device.groups.is_empty();
        let message = || (&codes::MAPPED_OBJECT_MISSING, "is mapped, but not described".to_owned());
        return [missing.then(message), None, None];
    };
    let bits = owner.definition(item.ty).map_or(item.ty.bits(), |definition| definition.bits);
    let length = bits.filter(|&bits| device.ethercat.is_none() && bits != entry.bits);
    let length =
        length.map(|bits| (&codes::MAPPED_LENGTH, format!("is mapped with {} bits, but has {bits}", entry.bits)));
    // What nothing was said of may be mapped where the manual maps it.
    let unmappable = !item.mappable.any() && !item.at.mappable.is_empty();
    let unmappable = unmappable.then(|| (&codes::NOT_MAPPABLE, "is mapped, but not mappable".to_owned()));
    let direction = (!goes(item, pdo.direction)).then(|| {
        let (name, access) = (direction_name(pdo.direction), item.access.name());
        (&codes::WRONG_DIRECTION, format!("is {access} and can't be mapped into {name}"))
    });
    [length, unmappable, direction]
}

/// Whether an item's access, and its direction where it has only one, go with that of a PDO.
pub(super) fn goes(item: &Item, direction: Direction) -> bool {
    let (access, own) = (Mappable::by_access(item.access), item.mappable);
    match direction {
        Direction::Receive => access.rpdo && (own.rpdo || !own.tpdo),
        Direction::Transmit => access.tpdo && (own.tpdo || !own.rpdo),
    }
}

fn direction_name(direction: Direction) -> &'static str {
    match direction {
        Direction::Receive => "an RPDO",
        Direction::Transmit => "a TPDO",
    }
}
