//! COB-IDs of the PDOs that a file declares. An RPDO can receive a PDO of any other node, so the COB-IDs of all nodes are computed
//! before the nodes are resolved.

use lexibus_codegen::number::hex;
use std::collections::{HashMap, HashSet};

use lexibus_codegen::diagnostics::{codes, Diagnostic, Diagnostics};
use lexibus_codegen::ir::{Direction, Group};
use lexibus_codegen::text::similar;

use super::described_node::DescribedNode;
use super::pdo_values::{direction, pdo, pdos};
use crate::declared::{DeclaredCobId, DeclaredMaster, DeclaredPdo};
use crate::model::{can_id, communication_index, DISABLED, NO_RTR};
use crate::syntax::At;

/// CAN-IDs for PDOs after the fourth, which have no CAN-ID in the predefined connection set (CiA 301 7.3.5).
const FREE: std::ops::Range<u32> = 0x680..0x6E0;

/// Name of the node, direction and number of the PDO.
type Key = (String, Direction, u16);

/// COB-IDs of declared PDOs.
pub(super) struct CobIds(HashMap<Key, u32>);

impl CobIds {
    /// Assigns COB-IDs to the declared PDOs of all nodes in three steps:
    ///
    /// 1. the COB-IDs that the file or a description declares, or that the predefined connection set defines
    /// 2. free COB-IDs
    /// 3. the COB-IDs of other nodes' TPDOs
    pub fn new(nodes: &[DescribedNode<'_>], master: Option<&DeclaredMaster>, diagnostics: &mut Diagnostics) -> Self {
        let mut ids = CobIds(HashMap::new());
        let all = || nodes.iter().flat_map(|node| node.declared.pdos.iter().map(move |declared| (node, declared)));
        let mut without = Vec::new();
        for (node, declared) in all() {
            match independent(node, declared) {
                Some(cob_id) => drop(ids.0.insert(key(node, declared), cob_id)),
                None => without.push((node, declared)),
            }
        }
        let used = ids.used(nodes, master);
        let mut free = FREE.filter(|id| !used.contains(id));
        let (of_others, automatic): (Vec<_>, Vec<_>) =
            without.into_iter().partition(|(_, declared)| is_of_other(declared));
        for (node, declared) in automatic {
            match free.next() {
                Some(id) => drop(ids.0.insert(key(node, declared), id | flags(node, declared))),
                None => diagnostics.push(exhausted(declared)),
            }
        }
        for (node, declared) in of_others {
            ids.receive(node, declared, nodes, diagnostics);
        }
        ids
    }

    /// Assigns the COB-ID of another node's TPDO to a PDO. Reports a TPDO that does not exist. Reports a disabled TPDO unless the
    /// file disables both PDOs.
    fn receive(
        &mut self,
        node: &DescribedNode<'_>,
        declared: &DeclaredPdo,
        nodes: &[DescribedNode<'_>],
        diagnostics: &mut Diagnostics,
    ) {
        let Some(At { value: DeclaredCobId::Of(sender, number), span }) = &declared.cob_id else { return };
        if let Some(cob_id) = self.sent(sender, *number, nodes, declared.enabled) {
            self.0.insert(key(node, declared), cob_id);
            return;
        }
        let found =
            Diagnostic::new(&codes::NO_SUCH_PDO, *span, format!("TPDO {number} of `{sender}` is missing or disabled"));
        diagnostics.push(match similar(sender, nodes.iter().map(DescribedNode::name)) {
            Some(name) if name != sender => found.help(format!("write `{name}.tpdo{number}`")),
            _ => found.help(format!("declare and enable TPDO {number} of `{sender}`")),
        });
    }

    /// Returns the COB-ID of a declared PDO, or [`DISABLED`] if none is assigned.
    pub fn of(&self, node: &str, direction: Direction, number: u16) -> u32 {
        self.0.get(&(node.to_owned(), direction, number)).copied().unwrap_or(DISABLED)
    }

    /// Returns the COB-ID of a TPDO, without bit 30. Returns `None` if the TPDO does not exist or has no COB-ID, or if bit 31
    /// of the COB-ID disables it. If `is_needed`, also returns `None` if the file disables the TPDO.
    fn sent(&self, name: &str, number: u16, nodes: &[DescribedNode<'_>], is_needed: bool) -> Option<u32> {
        let node = nodes.iter().find(|node| node.name() == name)?;
        if is_needed && is_disabled(node, number) {
            return None;
        }
        let cob_id = self.last(node, Direction::Transmit, number).filter(|cob_id| cob_id & DISABLED == 0)?;
        // Bit 30 has a meaning only in the COB-ID of a TPDO.
        Some(cob_id & 0x3FFF_FFFF)
    }

    /// Returns the COB-ID of a PDO after the configuration: the first that exists of the COB-ID in `parameters`, the
    /// assigned one, and that of the description.
    fn last(&self, node: &DescribedNode<'_>, direction: Direction, number: u16) -> Option<u32> {
        let values = node.values();
        if node.declares(direction, number) && !values.is_set((communication_index(direction, number), 1)) {
            return self.0.get(&(node.name().to_owned(), direction, number)).copied();
        }
        pdo(values, direction, number).map(|pdo| pdo.cob_id)
    }

    /// Returns the CAN-IDs that are in use: those of SYNC, TIME, EMCY, SDOs and PDOs.
    fn used(&self, nodes: &[DescribedNode<'_>], master: Option<&DeclaredMaster>) -> HashSet<u32> {
        let mut used = HashSet::from([0x80]);
        used.extend(master.map(|master| can_id(master.time_cob_id.value)));
        for node in nodes {
            let pdos = pdos(node.values()).into_iter().filter_map(|pdo| self.last(node, pdo.direction, pdo.number));
            let enabled = pdos.chain(services(node)).filter(|cob_id| cob_id & DISABLED == 0);
            used.extend(enabled.map(can_id));
        }
        used
    }
}

/// Returns whether the file disables a TPDO, and `parameters` do not set its COB-ID.
fn is_disabled(node: &DescribedNode<'_>, number: u16) -> bool {
    let is_set = node.values().is_set((communication_index(Direction::Transmit, number), 1));
    !is_set && node.declared.pdos.iter().any(|pdo| pdo.is_tpdo && pdo.number.value == number && !pdo.enabled)
}

fn key(node: &DescribedNode<'_>, declared: &DeclaredPdo) -> Key {
    (node.name().to_owned(), direction(declared), declared.number.value)
}

/// Returns the COB-IDs of SYNC, TIME, SDOs and EMCY of a node. Bit 31 is set if an SDO or EMCY is disabled.
fn services(node: &DescribedNode<'_>) -> Vec<u32> {
    let values = node.values();
    let time = node.declared.time_cob_id.as_ref().map(|time| time.value);
    let consumed = [values.number((0x1005, 0)), values.number((0x1012, 0)), time];
    // In the COB-ID of TIME, bit 31 means that the node receives TIME, not that TIME is disabled.
    let consumed = consumed.into_iter().flatten().map(|cob_id: u32| cob_id & !DISABLED);
    let sdo = values.device.groups.iter().filter_map(Group::index).filter(|index| (0x1200..0x1300).contains(index));
    let sdo = sdo.flat_map(|index| [1, 2].map(|sub_index| values.number((index, sub_index))));
    consumed.chain(sdo.chain([values.number((0x1014, 0))]).flatten()).collect()
}

/// Returns the COB-ID of a PDO if it does not depend on other PDOs. This is the first that exists of the declared COB-ID,
/// that of the description, and that of the predefined connection set.
fn independent(node: &DescribedNode<'_>, declared: &DeclaredPdo) -> Option<u32> {
    let of_description = || {
        let pdo = pdo(node.initial(), direction(declared), declared.number.value)?;
        (pdo.cob_id & DISABLED == 0 || !declared.enabled).then_some(pdo.cob_id)
    };
    match declared.cob_id.as_ref().map(|cob_id| &cob_id.value) {
        Some(DeclaredCobId::Number(cob_id)) => Some(*cob_id),
        Some(DeclaredCobId::Of(..)) => None,
        Some(DeclaredCobId::Automatic) => predefined(node, declared),
        None => of_description().or_else(|| predefined(node, declared)),
    }
}

/// Returns the COB-ID of the predefined connection set, or `None` for PDOs after the fourth.
fn predefined(node: &DescribedNode<'_>, declared: &DeclaredPdo) -> Option<u32> {
    let first = if declared.is_tpdo { 0x80 } else { 0x100 };
    let number = Some(declared.number.value).filter(|number| (1..=4).contains(number))?;
    Some((u32::from(number) * 0x100 + first + u32::from(node.id)) | flags(node, declared))
}

/// Returns the flags that an assigned COB-ID takes from the description. A device that does not answer RTR can abort the
/// write of a COB-ID without bit 30 (CiA 301 7.5.2.37).
fn flags(node: &DescribedNode<'_>, declared: &DeclaredPdo) -> u32 {
    match pdo(node.initial(), direction(declared), declared.number.value) {
        Some(pdo) if declared.is_tpdo => pdo.cob_id & NO_RTR,
        _ => 0,
    }
}

fn is_of_other(declared: &DeclaredPdo) -> bool {
    matches!(&declared.cob_id, Some(At { value: DeclaredCobId::Of(..), .. }))
}

fn exhausted(declared: &DeclaredPdo) -> Diagnostic {
    let message = format!("no CAN-ID from {} to {} is free", hex(FREE.start), hex(FREE.end - 1));
    Diagnostic::new(&codes::COB_ID_CONFLICT, declared.number.span, message).help("declare `cob_id`")
}
