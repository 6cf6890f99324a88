//! The SYNC period and the synchronous PDOs.

use lexibus_codegen::diagnostics::{codes, Diagnostic, Diagnostics};

use super::bus_load::frame_bits;
use super::cob_ids::place;
use super::sync_producers::{fastest, sync_producers, SyncProducer};
use crate::model::{can_id, Network, NetworkNode, NetworkPdo};

pub(super) fn check(network: &Network, diagnostics: &mut Diagnostics) {
    let synchronous: Vec<(&NetworkNode, &NetworkPdo)> =
        network.sent().into_iter().filter(|(_, pdo)| pdo.syncs().is_some()).collect();
    match fastest(&sync_producers(network)) {
        Some(producer) => period(network, producer, &synchronous, diagnostics),
        // If the file has no master, the sender of SYNC can be a device that the file does not list.
        None if network.master.is_none() => {}
        None => without_sync(&synchronous, diagnostics),
    }
}

/// Reports SYNC and synchronous PDOs that together take longer than the synchronous window or, without a window, the SYNC period.
fn period(
    network: &Network,
    producer: &SyncProducer,
    synchronous: &[(&NetworkNode, &NetworkPdo)],
    diagnostics: &mut Diagnostics,
) {
    let sync = frame_bits(can_id(producer.cob_id), producer.has_counter.into());
    let bits = synchronous.iter().fold(sync, |bits, (_, pdo)| bits + frame_bits(pdo.can_id(), pdo.bytes()));
    let time = f64::from(bits) * 1000.0 / f64::from(network.bit_rate);
    let (available, name) = match producer.window {
        0 => (producer.period, "SYNC period"),
        window => (window, "synchronous window"),
    };
    if time > f64::from(available) {
        let pdos = match synchronous.len() {
            1 => "1 synchronous PDO".to_owned(),
            count => format!("{count} synchronous PDOs"),
        };
        let message = format!("SYNC and {pdos} take up to {time:.0} µs, but the {name} is {available} µs");
        let found = Diagnostic::new(&codes::SYNC_PERIOD, producer.span, message);
        diagnostics.push(found.help(format!("use a {name} of at least {:.0} µs", time.ceil())));
    }
}

/// Reports the first synchronous PDO that the network file declares, for a network in which no node sends SYNC.
fn without_sync(synchronous: &[(&NetworkNode, &NetworkPdo)], diagnostics: &mut Diagnostics) {
    if let Some((node, pdo)) = synchronous.iter().find(|(_, pdo)| !pdo.span.is_empty()) {
        let message = format!("{} of `{}` is synchronous, but no node sends SYNC", pdo.title(), node.name.value);
        let found = Diagnostic::new(&codes::SYNC_PERIOD, place(node, pdo), message);
        diagnostics.push(found.help("declare `sync_period` of the master, or use another `transmission`"));
    }
}
