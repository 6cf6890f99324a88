//! `.cpj`, the nodelist project of CiA 306-3: the nodes of each network with their DCF.

use lexibus_codegen::diagnostics::{codes, Diagnostic, Diagnostics};
use lexibus_codegen::source::{FileId, Source, Span};

use crate::declared::{DeclaredNetwork, DeclaredNode};
use crate::syntax::At;

/// Reads the section `[Topology]` of a file. Sections of further networks (`[Topology2]`) are reported and skipped.
pub(super) fn read(source: &Source, file: FileId, diagnostics: &mut Diagnostics) -> DeclaredNetwork {
    let entries = entries(source, file, diagnostics);
    let text =
        |key: &str| entries.iter().find(|(name, _)| name.eq_ignore_ascii_case(key)).map(|(_, value)| value.clone());
    let mut network = DeclaredNetwork { is_master_optional: true, ..DeclaredNetwork::default() };
    network.name = text("NetName").filter(|name| !name.is_empty());
    let folder = text("EDSBaseName").filter(|folder| !folder.is_empty());
    for id in 1..=127u8 {
        let Some(present) = text(&format!("Node{id}Present")).filter(|value| number(value) == Some(1)) else {
            continue;
        };
        let name = text(&format!("Node{id}Name")).filter(|name| !name.is_empty());
        let mut node = DeclaredNode::new(name.unwrap_or(At::new(format!("node{id}"), present.span)));
        node.node_id = Some(At::new(id, present.span));
        node.has_node_id = true;
        node.device = text(&format!("Node{id}DCFName"));
        node.folders.extend(folder.clone());
        network.nodes.push(node);
    }
    let declared = text("Nodes");
    if let Some((declared, count)) = declared.and_then(|declared| Some((number(&declared)?, declared))) {
        if declared != network.nodes.len() as u64 {
            let message = format!("`Nodes` is {declared}, but the number of present nodes is {}", network.nodes.len());
            diagnostics.push(Diagnostic::new(&codes::NETWORK_VALUE, count.span, message));
        }
    }
    network
}

fn number(text: &str) -> Option<u64> {
    match text.strip_prefix("0x").or_else(|| text.strip_prefix("0X")) {
        Some(digits) => u64::from_str_radix(digits, 16).ok(),
        None => text.parse().ok(),
    }
}

/// Returns the keys and values of the section `[Topology]`.
fn entries(source: &Source, file: FileId, diagnostics: &mut Diagnostics) -> Vec<(String, At<String>)> {
    let (mut is_topology, mut entries, mut start) = (false, Vec::new(), 0u32);
    for line in source.text().split_inclusive('\n') {
        let (at, text) = (start + (line.len() - line.trim_start().len()) as u32, line.trim());
        start += line.len() as u32;
        let span = |from: usize, to: usize| Span::new(file, at + from as u32, at + to as u32);
        if let Some(name) = text.strip_prefix('[').and_then(|text| text.strip_suffix(']')) {
            is_topology = name.eq_ignore_ascii_case("Topology");
            if !is_topology && name.to_ascii_lowercase().starts_with("topology") {
                let message = format!("Lexibus reads only the network in `[Topology]`, not the one in `[{name}]`");
                let found = Diagnostic::new(&codes::NETWORK_VALUE, span(0, text.len()), message);
                diagnostics.push(found.help("write each network to a separate file, in the section `[Topology]`"));
            }
        } else if let Some((key, value)) = text.split_once('=').filter(|_| is_topology && !text.starts_with(';')) {
            let (from, value) = (text.len() - value.trim_start().len(), value.trim());
            entries.push((key.trim().to_owned(), At::new(value.to_owned(), span(from, from + value.len()))));
        }
    }
    entries
}
