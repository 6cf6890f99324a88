//! COB-IDs of the PDOs that a file declares. An RPDO can receive a PDO of any other node, so the COB-IDs of all nodes are computed
//! first.

use std::collections::HashMap;
use std::rc::Rc;

use lexibus_codegen::diagnostics::{codes, Diagnostic, Diagnostics};
use lexibus_codegen::ir::Direction;
use lexibus_codegen::text::similar;

use super::described::{direction, pdo};
use crate::declared::{DeclaredCobId, DeclaredNode, DeclaredPdo};
use crate::description::Description;
use crate::model::DISABLED;
use crate::syntax::At;

/// CAN-IDs for PDOs above the fourth, which have no CAN-ID in the predefined connection set (CiA 301 7.3.5).
const FREE: std::ops::Range<u32> = 0x680..0x6E0;

/// Name of the node, direction and number of the PDO.
type Key = (String, Direction, u16);

/// COB-IDs of declared PDOs.
pub(super) struct CobIds(HashMap<Key, u32>);

impl CobIds {
    /// Assigns COB-IDs to the declared PDOs of all nodes.
    pub fn new(nodes: &[(&DeclaredNode, u8, Rc<Description>)], diagnostics: &mut Diagnostics) -> Self {
        let mut ids = CobIds(HashMap::new());
        let mut free = FREE;
        for (node, id, description) in nodes {
            for declared in &node.pdos {
                if let Some(cob_id) = own(declared, *id, description, &mut free, diagnostics) {
                    ids.0.insert(key(node, declared), cob_id);
                }
            }
        }
        for (node, _, _) in nodes {
            for declared in &node.pdos {
                let Some(At { value: DeclaredCobId::Of(sender, number), span }) = &declared.cob_id else { continue };
                match ids.sent(sender, *number, nodes) {
                    Some(cob_id) => drop(ids.0.insert(key(node, declared), cob_id)),
                    None => {
                        let names = nodes.iter().map(|(node, ..)| node.name.value.as_str());
                        let message = format!("no node `{sender}` sends TPDO {number}");
                        let found = Diagnostic::new(&codes::NO_SUCH_PDO, *span, message);
                        diagnostics.push(match similar(sender, names) {
                            Some(name) if name != sender => found.help(format!("write `{name}.tpdo{number}`")),
                            _ => found.help(format!("declare TPDO {number} of `{sender}`")),
                        });
                    }
                }
            }
        }
        ids
    }

    /// Returns the COB-ID of a declared PDO. A PDO without a valid COB-ID is disabled.
    pub fn of(&self, node: &str, direction: Direction, number: u16) -> u32 {
        self.0.get(&(node.to_owned(), direction, number)).copied().unwrap_or(DISABLED)
    }

    /// Returns the COB-ID of a TPDO: the declared one, or that of the description.
    fn sent(&self, node: &str, number: u16, nodes: &[(&DeclaredNode, u8, Rc<Description>)]) -> Option<u32> {
        let declared = self.0.get(&(node.to_owned(), Direction::Transmit, number)).copied();
        let described = || {
            let (_, id, description) = nodes.iter().find(|(other, ..)| other.name.value == node)?;
            pdo(description.device(), Direction::Transmit, number, *id).map(|pdo| pdo.cob_id)
        };
        // Flags of a TPDO have another meaning in an RPDO.
        declared.or_else(described).filter(|cob_id| cob_id & DISABLED == 0).map(|cob_id| cob_id & 0x3FFF_FFFF)
    }
}

fn key(node: &DeclaredNode, declared: &DeclaredPdo) -> Key {
    (node.name.value.clone(), direction(declared), declared.number.value)
}

/// Returns the COB-ID of a PDO that does not refer to another node: the declared one, that of the description, or an automatic one.
fn own(
    declared: &DeclaredPdo,
    id: u8,
    description: &Description,
    free: &mut std::ops::Range<u32>,
    diagnostics: &mut Diagnostics,
) -> Option<u32> {
    let of_description = || {
        let pdo = pdo(description.device(), direction(declared), declared.number.value, id)?;
        (pdo.cob_id & DISABLED == 0 || !declared.enabled).then_some(pdo.cob_id)
    };
    match declared.cob_id.as_ref().map(|cob_id| &cob_id.value) {
        Some(DeclaredCobId::Number(cob_id)) => Some(*cob_id),
        Some(DeclaredCobId::Of(..)) => None,
        Some(DeclaredCobId::Automatic) => automatic(declared, id, free, diagnostics),
        None => of_description().or_else(|| automatic(declared, id, free, diagnostics)),
    }
}

/// Returns the COB-ID of the predefined connection set for the first four PDOs, and otherwise the next free one.
fn automatic(
    declared: &DeclaredPdo,
    id: u8,
    free: &mut std::ops::Range<u32>,
    diagnostics: &mut Diagnostics,
) -> Option<u32> {
    let first = if declared.is_tpdo { 0x80 } else { 0x100 };
    if let number @ 1..=4 = declared.number.value {
        return Some(u32::from(number) * 0x100 + first + u32::from(id));
    }
    let next = free.next();
    if next.is_none() {
        let message = format!("no CAN-ID from 0x{:X} to 0x{:X} is free", FREE.start, FREE.end - 1);
        let found = Diagnostic::new(&codes::COB_ID_CONFLICT, declared.number.span, message);
        diagnostics.push(found.help("declare `cob_id`"));
    }
    next
}
