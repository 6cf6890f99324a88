//! The SYNC period and the synchronous PDOs.

use lexibus_codegen::diagnostics::{codes, Diagnostic, Diagnostics};
use lexibus_codegen::ir::Direction;

use super::bus_load::frame_bits;
use super::cob_ids::place;
use crate::model::{Network, NetworkNode, NetworkPdo};

/// Bit of 0x1005: the node sends SYNC.
const PRODUCER: i128 = 1 << 30;

pub(super) fn check(network: &Network, diagnostics: &mut Diagnostics) {
    let synchronous: Vec<(&NetworkNode, &NetworkPdo)> = network
        .pdos(Direction::Transmit)
        .chain(network.pdos(Direction::Receive).filter(|(_, pdo)| network.is_sent_by_master(pdo.can_id())))
        .filter(|(_, pdo)| pdo.syncs().is_some())
        .collect();
    let Some(master) = &network.master else { return };
    let Some(period) = master.sync_period.as_ref().filter(|period| period.value > 0) else {
        return without_sync(network, &synchronous, diagnostics);
    };
    let sync = frame_bits(0x80, u32::from(master.sync_overflow > 0));
    let bits = synchronous.iter().fold(sync, |bits, (_, pdo)| bits + frame_bits(pdo.can_id(), pdo.bytes()));
    let time = f64::from(bits) * 1000.0 / f64::from(network.bit_rate);
    let (available, name) = match master.sync_window {
        0 => (period.value, "SYNC period"),
        window => (window, "synchronous window"),
    };
    if time > f64::from(available) {
        let count = synchronous.len();
        let message =
            format!("SYNC and {count} synchronous PDOs take up to {time:.0} µs, but the {name} is {available} µs");
        let found = Diagnostic::new(&codes::SYNC_PERIOD, period.span, message);
        diagnostics.push(found.help(format!("use a {name} of at least {:.0} µs", time.ceil())));
    }
}

/// Reports declared synchronous PDOs if no node sends SYNC.
fn without_sync(network: &Network, synchronous: &[(&NetworkNode, &NetworkPdo)], diagnostics: &mut Diagnostics) {
    let sends_sync = |node: &NetworkNode| {
        node.value((0x1005, 0)).is_some_and(|cob_id| cob_id & PRODUCER != 0)
            && node.value((0x1006, 0)).is_some_and(|period| period > 0)
    };
    if network.nodes.iter().any(sends_sync) {
        return;
    }
    if let Some((node, pdo)) = synchronous.iter().find(|(_, pdo)| !pdo.span.is_empty()) {
        let message = format!("{} of `{}` is synchronous, but no node sends SYNC", pdo.title(), node.name.value);
        let found = Diagnostic::new(&codes::SYNC_PERIOD, place(node, pdo), message);
        diagnostics.push(found.help("declare `sync_period` of the master, or another `transmission`"));
    }
}
