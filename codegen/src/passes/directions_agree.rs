//! After this pass the direction of every PDO of an EtherCAT slave or module was held against what its dictionary says of the
//! objects that are mapped. Register tables are looked at elsewhere.

use crate::diagnostics::{codes, Code, Diagnostic, Diagnostics};
use crate::ir::{Device, Direction, Group, Item, Mappable, Module, Pdo, PdoEntry, PdoEntryKind};

/// Of a device.
pub(super) fn device(device: &Device, diagnostics: &mut Diagnostics) {
    pdos(&device.process_data.pdos, &device.groups, diagnostics);
}

/// Of a module.
pub(super) fn module(module: &Module, diagnostics: &mut Diagnostics) {
    pdos(&module.process_data.pdos, &module.groups, diagnostics);
}

fn pdos(pdos: &[Pdo], groups: &[Group], diagnostics: &mut Diagnostics) {
    for pdo in pdos {
        for entry in pdo.entries.iter().filter(|entry| entry.kind == PdoEntryKind::Item) {
            // Objects are sorted by index.
            let position = groups.binary_search_by_key(&Some(entry.index), Group::index).ok();
            let item = position.and_then(|position| groups.get(position)?.sub(entry.sub_index));
            if let Some(item) = item.filter(|item| item.origin.line > 0) {
                against(entry, pdo.direction, item, diagnostics);
            }
        }
    }
}

fn against(entry: &PdoEntry, direction: Direction, item: &Item, diagnostics: &mut Diagnostics) {
    let (is_given, access) = (!item.at.mappable.is_empty(), Mappable::by_access(item.access));
    let (goes, is_accessed, name) = match direction {
        Direction::Receive => (item.mappable.rpdo, access.rpdo, "an RxPDO"),
        Direction::Transmit => (item.mappable.tpdo, access.tpdo, "a TxPDO"),
    };
    let problem: Option<(&'static Code, String)> = if is_given && !item.mappable.any() {
        Some((&codes::NOT_MAPPABLE, "is mapped, but not mappable".to_owned()))
    } else if is_given && !goes {
        Some((
            &codes::WRONG_DIRECTION,
            format!("is mapped into {name}, and its PdoMapping has the other direction only"),
        ))
    } else if !is_accessed && !item.at.access.is_empty() {
        Some((&codes::MAPPED_READ_ONLY, format!("is {} and mapped into {name}", item.access.name())))
    } else {
        None
    };
    if let Some((code, problem)) = problem {
        let message = format!("0x{:04X} sub-index {:#x} {problem}", entry.index, entry.sub_index);
        let found = Diagnostic::new(code, entry.origin.span, message);
        diagnostics.push(found.note_at(item.origin.span, "the mapped object"));
    }
}
