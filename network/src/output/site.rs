//! Documentation of a network: the page of the network, and the pages of its devices with the values and PDOs of the
//! network. Also the pages of the EtherCAT segment.

use std::collections::BTreeSet;

use lexibus_codegen::facts::item;
use lexibus_codegen::facts::pdo::is_mapping;
use lexibus_codegen::facts::words::PLAIN;
use lexibus_codegen::ir::{Direction, Item, Value};
use lexibus_site::network::{Frame, Node, Parameter, Party};
use lexibus_site::{network, Page, Site};

use super::configured::node_catalog;
use super::segment_site;
use crate::check::{bus_load, frame_bits, Traffic};
use crate::model::{
    MappedObject, Network, NetworkNode, NetworkPdo, BOOT, EXTENDED, KEEP_RUNNING, MANDATORY, UPDATE_SOFTWARE,
    VERIFY_SOFTWARE,
};
use crate::values::Write;

/// Separator between the names of an object and of its entry, or of a network and of a node.
pub(super) const SEPARATOR: &str = " / ";

/// Announces the devices of all nodes and SubDevices. Announce all networks of a site before you add the pages of one of them.
pub fn announce(network: &Network, title: &str, site: &mut Site) {
    for node in &network.nodes {
        // The configuration of a node does not change the folders of its device.
        site.announce(&catalog_name(title, node), node.description.catalog());
    }
    if let Some(segment) = &network.segment {
        segment_site::announce(segment, title, site);
    }
}

/// Returns the pages of a network: those of the devices, the page of the CANopen network, and the page of the EtherCAT segment. `title`
/// is the name of the network or of its file.
pub fn pages(network: &Network, title: &str, site: &mut Site) -> Vec<Page> {
    let mut pages = if network.is_only_segment() { Vec::new() } else { canopen_pages(network, title, site) };
    pages.extend(network.segment.iter().flat_map(|segment| segment_site::pages(segment, title, site)));
    pages
}

fn canopen_pages(network: &Network, title: &str, site: &mut Site) -> Vec<Page> {
    let add = |node| site.add(&catalog_name(title, node), &node_catalog(network, node));
    let mut pages: Vec<Page> = network.nodes.iter().flat_map(add).collect();
    let load = bus_load(network);
    let page = network::Network {
        name: title.to_owned(),
        bit_rate: u32::from(network.bit_rate) * 1000,
        summary: load.summary(),
        nodes: network.nodes.iter().map(|node| shown_node(title, node)).collect(),
        frames: frames(network, &load.traffic),
    };
    pages.push(site.network(&page));
    pages
}

/// Returns the name of a node's catalog in a site.
fn catalog_name(title: &str, node: &NetworkNode) -> String {
    format!("{title}{SEPARATOR}{}", node.name.value)
}

fn shown_node(title: &str, node: &NetworkNode) -> Node {
    let parameter = |write: &Write| {
        let item = node.item(write.object);
        let value = write.value.as_ref().or_else(|| item?.initial());
        Parameter {
            object: write.object,
            name: node.entry_name(write.object, SEPARATOR),
            value: value.zip(item).map_or_else(String::new, |(value, item)| shown_value(node, item, value)),
        }
    };
    Node {
        name: node.name.value.clone(),
        id: node.id,
        catalog: catalog_name(title, node),
        facts: facts(node),
        parameters: node.writes.iter().map(parameter).collect(),
    }
}

/// Returns a value as text with its unit. In parentheses follows the meaning of the value or the name of the mapped object,
/// unless it is unknown or already part of the text.
fn shown_value(node: &NetworkNode, item: &Item, value: &Value) -> String {
    let (value, types) = (value.resolved(node.id), &node.device().types);
    let text = item::value(item, &value, types);
    let meaning = match (item.object(), value.as_int()) {
        (Some((index, 1..)), Some(word)) if is_mapping(index) => {
            let mapped = MappedObject::of_word(word as u32);
            Some(node.entry_name((mapped.index, mapped.sub_index), SEPARATOR)).filter(|name| !name.is_empty())
        }
        _ if PLAIN.is_named(item, &value) => None,
        _ => item::meaning(item.ty, &value, types),
    };
    match meaning {
        Some(meaning) => format!("{text} ({meaning})"),
        None => text,
    }
}

/// Bits of 0x1F81 (CiA 302-2), and the facts that they state.
const ASSIGNMENT: [(u32, &str); 5] = [
    (BOOT, "Booted by the master."),
    (MANDATORY, "Mandatory."),
    (KEEP_RUNNING, "Keeps running if it is Operational when the master starts."),
    (VERIFY_SOFTWARE, "Its software version is verified."),
    (UPDATE_SOFTWARE, "Its software is updated automatically."),
];

fn facts(node: &NetworkNode) -> Vec<String> {
    let mut facts: Vec<String> =
        ASSIGNMENT.iter().filter(|(bit, _)| node.assignment & bit != 0).map(|(_, fact)| (*fact).to_owned()).collect();
    match (node.heartbeat.value, node.guard_time) {
        (0, 0) => facts.push("No error control.".to_owned()),
        (0, time) => facts.push(format!("Node guarding every {time} ms.")),
        (time, _) => facts.push(format!("Heartbeat every {time} ms.")),
    }
    if node.store {
        facts.push("Stores its configuration.".to_owned());
    }
    facts
}

/// Returns one frame for each CAN-ID that PDOs use, then the frames of the other services.
fn frames(network: &Network, traffic: &[Traffic]) -> Vec<Frame> {
    let mut known = BTreeSet::new();
    let sent = network.pdos(Direction::Transmit).chain(network.pdos(Direction::Receive));
    let sent = sent.filter(|(_, pdo)| known.insert(pdo.can_id()));
    let mut frames: Vec<Frame> = sent.map(|(node, pdo)| frame_of(network, traffic, node, pdo)).collect();
    let is_service = |traffic: &&Traffic| !known.contains(&traffic.can_id);
    frames.extend(traffic.iter().filter(is_service).map(|traffic| service(network, traffic)));
    frames
}

fn frame_of(network: &Network, traffic: &[Traffic], node: &NetworkNode, pdo: &NetworkPdo) -> Frame {
    let party = |node: &NetworkNode, pdo: &NetworkPdo| {
        let at = network.nodes.iter().position(|other| other.id == node.id).unwrap_or_default();
        Party::Node(at, pdo.index() + 0x200)
    };
    let receivers = network.pdos(Direction::Receive).filter(|(_, other)| other.can_id() == pdo.can_id());
    let mut receivers: Vec<Party> = receivers.map(|(node, pdo)| party(node, pdo)).collect();
    let sender = match pdo.direction {
        Direction::Transmit => party(node, pdo),
        Direction::Receive if network.is_sent_by_master(pdo.can_id()) => Party::Master,
        Direction::Receive => Party::Unknown,
    };
    if pdo.direction == Direction::Transmit && network.master.as_ref().is_some_and(|master| master.exchanges_pdos) {
        receivers.push(Party::Master);
    }
    let objects = pdo.entries.iter().filter(|entry| !entry.is_gap());
    Frame {
        name: pdo.title(),
        can_id: pdo.can_id() & !EXTENDED,
        sender,
        receivers,
        timing: timing(pdo),
        bytes: pdo.bytes(),
        bits: frame_bits(pdo.can_id(), pdo.bytes()),
        rate: traffic.iter().find(|traffic| traffic.can_id == pdo.can_id()).map(|traffic| traffic.rate),
        objects: objects.map(|entry| node.entry_name((entry.index, entry.sub_index), SEPARATOR)).collect(),
    }
}

/// Returns when a PDO is sent.
fn timing(pdo: &NetworkPdo) -> String {
    match pdo.transmission {
        0 => "on a change, after a SYNC".to_owned(),
        1 => "after each SYNC".to_owned(),
        syncs @ 2..=240 => format!("after every {syncs} SYNCs"),
        252 | 253 => "on a remote request".to_owned(),
        _ => {
            let mut timing = "on an event".to_owned();
            if pdo.inhibit_time > 0 {
                timing += &format!(", at intervals of at least {} ms", f64::from(pdo.inhibit_time) / 10.0);
            }
            if pdo.event_timer > 0 {
                timing += &format!(", at the latest after {} ms", pdo.event_timer);
            }
            timing
        }
    }
}

/// Returns the frame of a service, such as SYNC or a heartbeat.
fn service(network: &Network, traffic: &Traffic) -> Frame {
    let at = network.nodes.iter().position(|node| node.id == traffic.sender);
    Frame {
        name: traffic.service.clone(),
        can_id: traffic.can_id,
        sender: at.map_or(Party::Master, |at| Party::Node(at, 0)),
        timing: format!("every {} ms", 1000.0 / traffic.rate),
        bytes: traffic.bytes,
        bits: traffic.bits,
        rate: Some(traffic.rate),
        ..Frame::default()
    }
}
