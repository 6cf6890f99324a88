//! PDOs that no node receives or sends, and PDOs with a wrong length.

use lexibus_codegen::diagnostics::{codes, Diagnostic, Diagnostics};
use lexibus_codegen::ir::Direction;

use super::cob_ids::place;
use crate::model::Network;

/// Maximum length of a PDO on CAN in bits.
const MAX_BITS: u32 = 64;

pub(super) fn check(network: &Network, diagnostics: &mut Diagnostics) {
    lengths(network, diagnostics);
    if network.master.as_ref().is_none_or(|master| master.exchanges_pdos) {
        return;
    }
    for (node, pdo) in network.pdos(Direction::Transmit) {
        if network.receivers(pdo.cob_id).next().is_none() {
            let message = format!("no node receives {}", node.pdo_title(pdo));
            let found = Diagnostic::new(&codes::PDO_WITHOUT_PARTNER, place(node, pdo), message);
            let receiver = format!("`cob_id = \"{}.tpdo{}\"`", node.name.value, pdo.number);
            diagnostics.push(found.help(format!(
                "declare the RPDO of a node with {receiver}, or disable the PDO with `enabled = false`"
            )));
        }
    }
    let is_sent = |can_id| network.pdos(Direction::Transmit).any(|(_, pdo)| pdo.can_id() == can_id);
    for (node, pdo) in network.pdos(Direction::Receive).filter(|(_, pdo)| !pdo.span.is_empty()) {
        if !is_sent(pdo.can_id()) {
            let message = format!("no node sends {}", node.pdo_title(pdo));
            let found = Diagnostic::new(&codes::PDO_WITHOUT_PARTNER, place(node, pdo), message);
            diagnostics.push(found.help("declare its sender with `cob_id`, such as \"axis1.tpdo1\""));
        }
    }
}

/// Reports PDOs to which the network file maps more than 64 bits, and RPDOs that are longer than the TPDO that they receive.
fn lengths(network: &Network, diagnostics: &mut Diagnostics) {
    for node in &network.nodes {
        for pdo in node.pdos.iter().filter(|pdo| pdo.bits() > MAX_BITS) {
            let span = node.values().set_at((pdo.index() + 0x200, 0));
            if !span.is_empty() {
                let message = format!("{} maps {} bits, but a PDO has at most {MAX_BITS}", pdo.title(), pdo.bits());
                let found = Diagnostic::new(&codes::PDO_LENGTH, span, message);
                diagnostics.push(found.help("move objects to another PDO"));
            }
        }
    }
    for (node, rpdo) in network.pdos(Direction::Receive) {
        let sender = network.pdos(Direction::Transmit).find(|(_, tpdo)| tpdo.can_id() == rpdo.can_id());
        let Some((sender, tpdo)) = sender.filter(|(_, tpdo)| tpdo.bytes() < rpdo.bytes()) else { continue };
        let (whole, sent) = (rpdo.bytes(), tpdo.bytes());
        let message = format!(
            "{} of `{}` maps {whole} bytes, but {} of `{}` maps only {sent}",
            rpdo.title(),
            node.name.value,
            tpdo.title(),
            sender.name.value
        );
        let found = Diagnostic::new(&codes::PDO_LENGTH, place(node, rpdo), message);
        diagnostics.push(found.help("map the same number of bytes in both PDOs"));
    }
}
