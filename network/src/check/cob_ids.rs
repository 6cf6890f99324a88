//! CAN-IDs that two senders use.

use std::collections::BTreeMap;

use lexibus_codegen::diagnostics::{codes, Diagnostic, Diagnostics};
use lexibus_codegen::ir::Direction;
use lexibus_codegen::source::Span;

use crate::model::{can_id, Network, NetworkNode, NetworkPdo, DISABLED};

/// A sender of a CAN-ID.
struct Sender {
    name: String,
    span: Span,
}

pub(super) fn check(network: &Network, diagnostics: &mut Diagnostics) {
    let mut senders = services(network);
    let sent = network.pdos(Direction::Transmit).chain(sent_by_master(network));
    for (node, pdo) in sent {
        let span = place(node, pdo);
        let name = match pdo.direction {
            Direction::Transmit => format!("{} of `{}`", pdo.title(), node.name.value),
            Direction::Receive => format!("{} of `{}` (sent by the master)", pdo.title(), node.name.value),
        };
        match senders.get(&pdo.can_id()) {
            Some(other) => {
                let message = format!("the CAN-ID 0x{:X} of {name} is also that of {}", pdo.can_id(), other.name);
                let found = Diagnostic::new(&codes::COB_ID_CONFLICT, span, message);
                let found =
                    if other.span.is_empty() { found } else { found.note_at(other.span, "the other sender is here") };
                diagnostics.push(found.help("choose another `cob_id`, or use `auto`"));
            }
            None => {
                senders.insert(pdo.can_id(), Sender { name, span });
            }
        }
    }
}

/// Returns the location of a PDO: its number in the file, or the name of its node.
pub(super) fn place(node: &NetworkNode, pdo: &NetworkPdo) -> Span {
    pdo.cob_id_at.or(pdo.span).or(node.name.span)
}

/// Returns the RPDOs that the master sends. Of several RPDOs with one CAN-ID and one length, the master sends one PDO.
fn sent_by_master(network: &Network) -> impl Iterator<Item = (&NetworkNode, &NetworkPdo)> {
    let mut known: Vec<(u32, u32)> = Vec::new();
    let is_sent = move |(_, pdo): &(&NetworkNode, &NetworkPdo)| {
        let key = (pdo.can_id(), pdo.bytes());
        let is_new = !known.contains(&key);
        known.push(key);
        is_new && network.is_sent_by_master(pdo.can_id())
    };
    network.pdos(Direction::Receive).filter(is_sent)
}

/// Returns the CAN-IDs of all services except PDOs.
fn services(network: &Network) -> BTreeMap<u32, Sender> {
    let mut senders = BTreeMap::new();
    let mut add = |id: u32, name: String| {
        senders.entry(id).or_insert(Sender { name, span: Span::MISSING });
    };
    add(0, "NMT".to_owned());
    for id in [0x7E4, 0x7E5] {
        add(id, "LSS".to_owned());
    }
    if let Some(master) = &network.master {
        add(0x80, "SYNC".to_owned());
        add(can_id(master.time_cob_id), "TIME".to_owned());
        add(0x700 + u32::from(network.master_id()), "the heartbeat of the master".to_owned());
    }
    for node in &network.nodes {
        let (id, name) = (u32::from(node.id), format!("`{}`", node.name.value));
        add(0x580 + id, format!("the SDO replies of {name}"));
        add(0x600 + id, format!("the SDO requests to {name}"));
        add(0x700 + id, format!("the heartbeat of {name}"));
        if node.emcy_cob_id & DISABLED == 0 {
            add(can_id(node.emcy_cob_id), format!("the EMCY of {name}"));
        }
    }
    senders
}
