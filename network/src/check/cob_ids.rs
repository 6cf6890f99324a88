//! CAN-IDs that two senders use.

use std::collections::BTreeMap;

use lexibus_codegen::diagnostics::{codes, Diagnostic, Diagnostics};
use lexibus_codegen::ir::Direction;
use lexibus_codegen::source::Span;

use super::sync_producers::sync_producers;
use crate::model::{can_id, Network, NetworkNode, NetworkPdo, DISABLED};

/// A sender of a CAN-ID.
struct Sender {
    can_id: u32,
    name: String,
    /// Location in the network file; empty if the description or CiA 301 states the CAN-ID.
    span: Span,
}

pub(super) fn check(network: &Network, diagnostics: &mut Diagnostics) {
    // CAN-IDs of services whose location is unknown are not compared with each other, because many descriptions state a wrong EMCY.
    let (unplaced, placed): (Vec<Sender>, Vec<Sender>) =
        services(network).into_iter().partition(|sender| sender.span.is_empty());
    let mut senders = BTreeMap::new();
    for sender in unplaced {
        senders.entry(sender.can_id).or_insert(sender);
    }
    for sender in placed.into_iter().chain(network.sent().into_iter().map(of_pdo)) {
        match senders.get(&sender.can_id) {
            Some(other) => diagnostics.push(conflict(&sender, other)),
            None => drop(senders.insert(sender.can_id, sender)),
        }
    }
}

fn conflict(sender: &Sender, other: &Sender) -> Diagnostic {
    let message = format!("the CAN-ID 0x{:X} of {} is also that of {}", sender.can_id, sender.name, other.name);
    let found = Diagnostic::new(&codes::COB_ID_CONFLICT, sender.span, message);
    let found = if other.span.is_empty() { found } else { found.note_at(other.span, "the other sender is here") };
    found.help("choose another `cob_id`, or use `auto`")
}

fn of_pdo((node, pdo): (&NetworkNode, &NetworkPdo)) -> Sender {
    let name = match pdo.direction {
        Direction::Transmit => format!("{} of `{}`", pdo.title(), node.name.value),
        Direction::Receive => format!("{} of `{}` (sent by the master)", pdo.title(), node.name.value),
    };
    Sender { can_id: pdo.can_id(), name, span: place(node, pdo) }
}

/// Returns the location of a PDO: its number in the file, or the name of its node.
pub(super) fn place(node: &NetworkNode, pdo: &NetworkPdo) -> Span {
    pdo.cob_id_at.or(pdo.span).or(node.name.span)
}

/// Returns the senders of all services except PDOs.
fn services(network: &Network) -> Vec<Sender> {
    let mut senders = Vec::new();
    let mut add = |can_id: u32, name: String, span: Span| senders.push(Sender { can_id, name, span });
    add(0, "NMT".to_owned(), Span::MISSING);
    for id in [0x7E4, 0x7E5] {
        add(id, "LSS".to_owned(), Span::MISSING);
    }
    let producers = sync_producers(network);
    if let Some(master) = &network.master {
        if producers.iter().all(|producer| producer.can_id != 0x80) {
            add(0x80, "SYNC".to_owned(), Span::MISSING);
        }
        add(can_id(master.time_cob_id), "TIME".to_owned(), Span::MISSING);
        add(0x700 + u32::from(network.master_id()), "the heartbeat of the master".to_owned(), Span::MISSING);
    }
    producers.into_iter().for_each(|producer| add(producer.can_id, producer.name, producer.span));
    for node in &network.nodes {
        let (id, name) = (u32::from(node.id), format!("`{}`", node.name.value));
        add(0x580 + id, format!("the SDO replies of {name}"), Span::MISSING);
        add(0x600 + id, format!("the SDO requests to {name}"), Span::MISSING);
        add(0x700 + id, format!("the heartbeat of {name}"), Span::MISSING);
        if node.emcy_cob_id & DISABLED == 0 {
            add(can_id(node.emcy_cob_id), format!("the EMCY of {name}"), node.set_at((0x1014, 0)));
        }
    }
    senders
}
