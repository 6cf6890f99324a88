//! CAN-IDs that two senders use, and CAN-IDs that no PDO or service can use.

use lexibus_codegen::number::hex;
use std::collections::{BTreeMap, HashSet};

use lexibus_codegen::diagnostics::{codes, Diagnostic, Diagnostics};
use lexibus_codegen::ir::Direction;
use lexibus_codegen::source::Span;

use super::restricted;
use super::sync_producers::sync_producers;
use crate::model::{can_id, Network, NetworkNode, NetworkPdo, DISABLED};

/// Bits of a COB-ID that contain the CAN-ID, and the bit that states its length.
const CAN_ID: u32 = 0x3FFF_FFFF;

/// A sender of SYNC, TIME, EMCY or a PDO.
struct Sender {
    cob_id: u32,
    name: String,
    /// Location in the network file. Empty for TIME and EMCY if the file does not set the COB-ID. Also empty for SYNC with
    /// the CAN-ID 0x80 if no known node sends it.
    span: Span,
    is_pdo: bool,
}

pub(super) fn check(network: &Network, diagnostics: &mut Diagnostics) {
    // COB-IDs of SYNC, TIME and EMCY without a location are not checked, because some descriptions state a wrong COB-ID of
    // EMCY. However, the CAN-IDs of all other senders must differ from these COB-IDs.
    let (unplaced, placed): (Vec<Sender>, Vec<Sender>) =
        services(network).into_iter().partition(|sender| sender.span.is_empty());
    let mut senders = BTreeMap::new();
    for sender in unplaced {
        senders.entry(can_id(sender.cob_id)).or_insert(sender);
    }
    let mut known = HashSet::new();
    for sender in placed.into_iter().chain(network.sent().into_iter().map(|(node, pdo)| of_pdo(node, pdo))) {
        known.insert(sender.cob_id & CAN_ID);
        if let Some(fault) = restricted::fault(sender.cob_id, &sender.name, sender.span) {
            diagnostics.push(fault);
            continue;
        }
        match senders.get(&can_id(sender.cob_id)) {
            Some(other) => diagnostics.push(conflict(&sender, other)),
            None => drop(senders.insert(can_id(sender.cob_id), sender)),
        }
    }
    for (node, pdo) in network.pdos(Direction::Receive).filter(|(_, pdo)| !known.contains(&(pdo.cob_id & CAN_ID))) {
        let name = node.pdo_title(pdo);
        if let Some(fault) = restricted::fault(pdo.cob_id, &name, place(node, pdo)) {
            diagnostics.push(fault);
        }
    }
}

fn conflict(sender: &Sender, other: &Sender) -> Diagnostic {
    let can_id = can_id(sender.cob_id);
    let message = format!("{} and {} use the same CAN-ID {}", sender.name, other.name, hex(can_id));
    let found = Diagnostic::new(&codes::COB_ID_CONFLICT, sender.span, message);
    let found = if other.span.is_empty() { found } else { found.note_at(other.span, "the other sender is here") };
    found.help(if sender.is_pdo { "choose another `cob_id`, or use `auto`" } else { "choose another COB-ID" })
}

fn of_pdo(node: &NetworkNode, pdo: &NetworkPdo) -> Sender {
    let name = node.pdo_title(pdo);
    let name = if pdo.direction == Direction::Transmit { name } else { name + " (sent by the master)" };
    Sender { cob_id: pdo.cob_id, name, span: place(node, pdo), is_pdo: true }
}

/// Returns the location of a PDO in the file: its COB-ID, its section, or the name of its node.
pub(super) fn place(node: &NetworkNode, pdo: &NetworkPdo) -> Span {
    pdo.cob_id_at.or(pdo.span).or(node.name.span)
}

/// Returns the senders of SYNC, TIME and EMCY.
fn services(network: &Network) -> Vec<Sender> {
    let mut senders = Vec::new();
    let mut add = |cob_id: u32, name: String, span: Span| senders.push(Sender { cob_id, name, span, is_pdo: false });
    let producers = sync_producers(network);
    if let Some(master) = &network.master {
        if producers.iter().all(|producer| can_id(producer.cob_id) != 0x80) {
            add(0x80, "SYNC".to_owned(), Span::MISSING);
        }
        add(master.time_cob_id.value, "TIME".to_owned(), master.time_cob_id.span);
    }
    producers.into_iter().for_each(|producer| add(producer.cob_id, producer.name, producer.span));
    for node in network.nodes.iter().filter(|node| node.emcy_cob_id & DISABLED == 0) {
        add(node.emcy_cob_id, format!("the EMCY of `{}`", node.name.value), node.values().set_at((0x1014, 0)));
    }
    senders
}
