//! Checks the times of heartbeats, and reports nodes that use both heartbeat and node guarding.

use std::collections::BTreeSet;

use lexibus_codegen::diagnostics::{codes, Diagnostic, Diagnostics};
use lexibus_codegen::source::Span;

use crate::model::{consumer_time, Network, NetworkNode};
use crate::syntax::At;

/// Maximum consumer time: 0x1016 has 16 bits for it.
const MAX_TIME: u32 = 0xFFFF;

pub(super) fn check(network: &Network, diagnostics: &mut Diagnostics) {
    for node in &network.nodes {
        consumers(network, node, diagnostics);
        let is_monitored = network.master.as_ref().is_some_and(|master| master.consumes_heartbeats);
        if is_monitored {
            times(
                &format!("`{}`", node.name.value),
                &node.heartbeat,
                &node.heartbeat_multiplier,
                node.name.span,
                diagnostics,
            );
        }
        if node.heartbeat.value != 0 && node.guard_time != 0 && node.life_time_factor != 0 {
            let message = format!("`{}` uses both heartbeat and node guarding", node.name.value);
            let found = Diagnostic::new(&codes::HEARTBEAT_TIME, node.heartbeat.span.or(node.name.span), message);
            diagnostics.push(found.help("set the guard time or the heartbeat to 0"));
        }
    }
    if let Some(master) = &network.master {
        times("the master", &master.heartbeat, &master.heartbeat_multiplier, master.span, diagnostics);
    }
}

/// Reports a consumer time that is longer than `MAX_TIME`, or not longer than the producer time.
fn times(who: &str, heartbeat: &At<u16>, multiplier: &At<f64>, span: Span, diagnostics: &mut Diagnostics) {
    let (producer, consumer) = (heartbeat.value, consumer_time(heartbeat.value, multiplier.value));
    if producer == 0 {
        return;
    }
    let of = format!("the consumer time for the heartbeat of {who} is {consumer} ms");
    if consumer <= producer.into() {
        let found = Diagnostic::new(&codes::HEARTBEAT_TIME, multiplier.span.or(span), of);
        diagnostics.push(
            found.label(format!("the producer time is {producer} ms")).help("use a multiplier above 1, such as 3"),
        );
    } else if consumer > MAX_TIME {
        let found = Diagnostic::new(&codes::HEARTBEAT_TIME, heartbeat.span.or(span), of);
        diagnostics.push(found.label(format!("the maximum is {MAX_TIME} ms")).help("use a shorter heartbeat"));
    }
}

/// Reports entries of 0x1016 that the configuration writes, if the producer does not exist, sends no heartbeat, or sends its
/// heartbeat too rarely.
fn consumers(network: &Network, node: &NetworkNode, diagnostics: &mut Diagnostics) {
    let written: BTreeSet<(u16, u8)> = node.writes.iter().map(|write| write.object).collect();
    for object in written.range((0x1016, 1)..=(0x1016, u8::MAX)) {
        let value: u32 = node.values().number(*object).unwrap_or(0);
        let (time, producer) = (value & 0xFFFF, (value >> 16) as u8);
        if time == 0 || !(1..=127).contains(&producer) {
            continue;
        }
        let problem = match heartbeat_of(network, producer) {
            // If the file has no master, another program is the master. It can have any node-ID.
            None if network.master.is_none() => continue,
            None => format!("no node has the node-ID {producer}"),
            Some((_, _, computed)) if time == computed => continue,
            Some((name, 0, _)) => format!("{name} sends no heartbeat"),
            Some((name, sent, _)) if u32::from(sent) >= time => format!("{name} sends its heartbeat every {sent} ms"),
            Some(_) => continue,
        };
        let message = format!("`{}` expects a heartbeat from node {producer} every {time} ms", node.name.value);
        let span = node.values().set_at(*object).or(node.name.span);
        diagnostics.push(Diagnostic::new(&codes::HEARTBEAT_TIME, span, message).label(problem));
    }
}

/// Returns the name and the heartbeat producer time of a node or of the master. The third value is the consumer time that results
/// from the master's multiplier, or 0 for a node. `times` checks this consumer time.
fn heartbeat_of(network: &Network, id: u8) -> Option<(String, u16, u32)> {
    if let Some(master) = network.master.as_ref().filter(|_| id == network.master_id()) {
        let computed = consumer_time(master.heartbeat.value, master.heartbeat_multiplier.value) & 0xFFFF;
        return Some(("the master".to_owned(), master.heartbeat.value, computed));
    }
    let node = network.nodes.iter().find(|node| node.id == id)?;
    Some((format!("`{}`", node.name.value), node.heartbeat.value, 0))
}
