//! Resolves all nodes.

use std::collections::BTreeMap;

use lexibus_codegen::diagnostics::{codes, Diagnostic, Diagnostics};
use lexibus_codegen::ir::Bus;
use lexibus_codegen::source::{FileId, Source, Span};

use super::cob_ids::CobIds;
use super::described_node::DescribedNode;
use super::{heartbeat, mapping, node};
use crate::declared::{DeclaredNetwork, DeclaredNode};
use crate::description::{Descriptions, DeviceReference};
use crate::model::{file_stem, Network};

/// Default bit rate in kbit/s, as in `dcfgen`.
const BIT_RATE: u16 = 1000;

/// Resolves a declared network. Leaves out nodes that cannot be resolved.
pub fn resolve(source: &Source, declared: DeclaredNetwork, diagnostics: &mut Diagnostics) -> Network {
    check_master(&declared, diagnostics);
    let mut repeated = check_node_ids(&declared, diagnostics);
    repeated.extend(check_names(&declared, diagnostics));
    let mut descriptions = Descriptions::new(source, Bus::CanOpen);
    let mut nodes = Vec::new();
    for node in declared.nodes.iter().filter(|node| !repeated.contains(&node.name.span)) {
        let description = descriptions.of(&reference(node), diagnostics);
        if let (Some(id), Some(description)) = (&node.node_id, description) {
            nodes.push(DescribedNode::new(node, id.value, description, diagnostics));
        }
    }
    let cob_ids = CobIds::new(&nodes, declared.master.as_ref(), diagnostics);
    let resolved = nodes.into_iter().map(|node| node::resolve(node, &cob_ids, diagnostics)).collect();
    let mut network = Network {
        name: declared.name.map_or(String::new(), |name| name.value),
        bit_rate: declared.bit_rate.as_ref().map_or(BIT_RATE, |rate| rate.value),
        bit_rate_at: declared.bit_rate.map_or(Span::MISSING, |rate| rate.span),
        master: declared.master,
        nodes: resolved,
        segment: None,
    };
    let consumers: Vec<bool> = network.nodes.iter().map(|node| consumes(&declared.nodes, &node.name.value)).collect();
    network.nodes.iter().for_each(|node| mapping::check(node, diagnostics));
    heartbeat::monitor_master(&mut network, &consumers, diagnostics);
    network
}

fn reference(node: &DeclaredNode) -> DeviceReference<'_> {
    DeviceReference {
        title: format!("the node `{}`", node.name.value),
        span: node.name.span,
        device: node.device.as_ref(),
        model: node.model.as_ref(),
        folders: &node.folders,
        overlays: &node.overlays,
    }
}

fn consumes(nodes: &[DeclaredNode], name: &str) -> bool {
    nodes.iter().any(|node| node.name.value == name && node.consumes_heartbeat)
}

/// Reports nodes whose output files would have the name of an earlier node, of the master or of the network. Ignores case. Returns
/// the locations of the names of these nodes.
fn check_names(declared: &DeclaredNetwork, diagnostics: &mut Diagnostics) -> Vec<Span> {
    let reserved = |stem: &str, owner: &str| (stem.to_owned(), (owner.to_owned(), Span::MISSING));
    let mut known = BTreeMap::from([reserved("network", "the network")]);
    known.extend(declared.master.as_ref().map(|_| reserved("master", "the master")));
    let mut repeated = Vec::new();
    for node in &declared.nodes {
        let name = format!("the node `{}`", node.name.value);
        let stem = file_stem(&node.name.value).to_lowercase();
        let Some((other, span)) = known.insert(stem.clone(), (name.clone(), node.name.span)) else { continue };
        let message = format!("the output files of {name} would share a file name with those of {other}");
        let found = Diagnostic::new(&codes::NETWORK_VALUE, node.name.span, message)
            .label(format!("the file name `{stem}` is in use"));
        let found = if span.is_empty() { found } else { found.note_at(span, format!("{other} is here")) };
        diagnostics.push(found.help("give the node another name"));
        repeated.push(node.name.span);
    }
    repeated
}

fn check_master(declared: &DeclaredNetwork, diagnostics: &mut Diagnostics) {
    match &declared.master {
        None if !declared.is_master_optional => {
            let found = Diagnostic::new(&codes::NO_MASTER, Span::new(FileId(0), 0, 0), "the network has no master");
            diagnostics.push(found.help("add the section `master` with the node-ID of the master"));
        }
        Some(master) if !master.has_node_id => {
            let found = Diagnostic::new(&codes::NO_NODE_ID, master.span, "the master has no node-ID");
            diagnostics.push(found.help("add a node-ID from 1 to 127"));
        }
        _ => {}
    }
}

/// Reports nodes without a node-ID, and nodes with the node-ID of the master or of an earlier node. Returns the locations of the names
/// of the nodes with a repeated node-ID.
fn check_node_ids(declared: &DeclaredNetwork, diagnostics: &mut Diagnostics) -> Vec<Span> {
    let mut repeated = Vec::new();
    let mut known: BTreeMap<u8, (String, Span)> = BTreeMap::new();
    if let Some(id) = declared.master.as_ref().and_then(|master| master.node_id.as_ref()) {
        known.insert(id.value, ("the master".to_owned(), id.span));
    }
    let used: Vec<u8> = declared.nodes.iter().filter_map(|node| Some(node.node_id.as_ref()?.value)).collect();
    for node in &declared.nodes {
        let name = format!("the node `{}`", node.name.value);
        let Some(id) = &node.node_id else {
            if !node.has_node_id {
                let found = Diagnostic::new(&codes::NO_NODE_ID, node.name.span, format!("{name} has no node-ID"));
                diagnostics.push(found.help("add a node-ID from 1 to 127"));
            }
            continue;
        };
        match known.get(&id.value) {
            Some((other, span)) => {
                let message = format!("{name} has the node-ID {} of {other}", id.value);
                let free = (1..=127).find(|free| !used.contains(free) && !known.contains_key(free));
                let help =
                    free.map_or("remove a node".to_owned(), |free| format!("use a free node-ID, such as {free}"));
                let found = Diagnostic::new(&codes::NODE_ID_TWICE, id.span, message);
                diagnostics.push(found.note_at(*span, format!("{other} is here")).help(help));
                repeated.push(node.name.span);
            }
            None => {
                known.insert(id.value, (name, id.span));
            }
        }
    }
    repeated
}
