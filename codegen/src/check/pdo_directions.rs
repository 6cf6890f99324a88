//! PDOs of an EtherCAT slave or module: directions that contradict the dictionary.

use super::context::PdoOwner;
use crate::diagnostics::{codes, Code, Diagnostics};
use crate::ir::{Direction, Item, Mappable, PdoEntry, PdoEntryKind};
use crate::number::sub_entry;

/// Reports PDO entries if the PDO mapping or the access rights of the item do not allow mapping in the direction of the PDO.
pub(super) fn check(owner: &PdoOwner<'_>, diagnostics: &mut Diagnostics) {
    for pdo in &owner.data.pdos {
        for entry in pdo.entries.iter().filter(|entry| entry.kind == PdoEntryKind::Item) {
            if let Some(item) = owner.described(entry) {
                against(entry, pdo.direction, item, diagnostics);
            }
        }
    }
}

fn against(entry: &PdoEntry, direction: Direction, item: &Item, diagnostics: &mut Diagnostics) {
    let (is_given, access) = (!item.at.mappable.is_empty(), Mappable::by_access(item.access));
    let (is_mappable, is_accessible, name, other) = match direction {
        Direction::Receive => (item.mappable.rpdo, access.rpdo, "an RxPDO", "a TxPDO"),
        Direction::Transmit => (item.mappable.tpdo, access.tpdo, "a TxPDO", "an RxPDO"),
    };
    let problem: Option<(&'static Code, String)> = if is_given && !item.mappable.any() {
        Some((&codes::NOT_MAPPABLE, "is mapped, but not mappable".to_owned()))
    } else if is_given && !is_mappable {
        Some((
            &codes::WRONG_DIRECTION,
            format!("is mapped into {name}, but PdoMapping of the object allows only {other}"),
        ))
    } else if !is_accessible && !item.at.access.is_empty() {
        Some((&codes::MAPPED_READ_ONLY, format!("is {}, but mapped into {name}", item.access.name())))
    } else {
        None
    };
    if let Some((code, problem)) = problem {
        let message = format!("{} {problem}", sub_entry(entry.index, entry.sub_index));
        diagnostics.push(code.at(entry.origin.span, message).note_at(item.origin.span, "the mapped object"));
    }
}
