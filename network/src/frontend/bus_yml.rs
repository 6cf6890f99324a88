//! `bus.yml` of Lely's `dcfgen`, with the extensions of ros2_canopen: `nodes`, `defaults`, and keys for its drivers.

use lexibus_codegen::diagnostics::{codes, Diagnostic, Diagnostics};
use lexibus_codegen::source::Span;

use super::common::{self, Names};
use super::reader::{Reader, Table};
use super::section::{keys, Form, Section};
use crate::declared::{
    DeclaredNetwork, DeclaredNode, DeclaredParameter, ObjectName, HEARTBEAT_MULTIPLIER, RETRY_FACTOR,
};
use crate::syntax::{extent, At, Content, Entry, Node, Scalar, MAX_ELEMENTS};

const U8: Form = Form::Integer(0, 0xFF);
const U16: Form = Form::Integer(0, 0xFFFF);
const U32: Form = Form::Integer(0, 0xFFFF_FFFF);
const NODE_ID: Form = Form::Integer(1, 127);

static OPTIONS: Section = Section {
    name: "the section `options`",
    keys: keys! {
        "dcf_path" Form::Text;
        "heartbeat_multiplier" Form::Number;
        "retry_factor" U8;
    },
};

static MASTER: Section = Section {
    name: "the section `master`",
    keys: keys! {
        "node_id" NODE_ID;
        "baudrate" Form::Integer(10, 1000);
        "vendor_id" U32;
        "product_code" U32;
        "revision_number" U32;
        "serial_number" U32;
        "sync_period" U32;
        "sync_window" U32;
        "sync_overflow" Form::Integer(0, 240);
        "time_cob_id" U32;
        "emcy_inhibit_time" U16;
        "heartbeat_producer" U16;
        "heartbeat_multiplier" Form::Number;
        "heartbeat_consumer" Form::Flag;
        "error_behavior" Form::Values;
        "nmt_inhibit_time" U16;
        "start" Form::Flag;
        "start_nodes" Form::Flag;
        "start_all_nodes" Form::Flag;
        "reset_all_nodes" Form::Flag;
        "stop_all_nodes" Form::Flag;
        "boot_time" U32;
        "dcf_path" Form::Ignored;
        "driver" Form::Ignored;
        "package" Form::Ignored;
        "namespace" Form::Ignored;
        "remappings" Form::Ignored;
        "container_name" Form::Ignored;
        "boot_timeout" Form::Ignored;
        "boot_timeout_ms" Form::Ignored;
        "non_transmit_timeout" Form::Ignored;
    },
};

static NODE: Section = Section {
    name: "the section of a node",
    keys: keys! {
        "node_id" NODE_ID;
        "dcf" Form::Text;
        "dcf_path" Form::Text;
        "revision_number" U32;
        "serial_number" U32;
        "time_cob_id" U32;
        "heartbeat_producer" U16;
        "heartbeat_multiplier" Form::Number;
        "heartbeat_consumer" Form::Flag;
        "guard_time" U16;
        "life_time_factor" U8;
        "retry_factor" U8;
        "error_behavior" Form::Values;
        "rpdo" Form::Named(&PDO);
        "tpdo" Form::Named(&PDO);
        "boot" Form::Flag;
        "mandatory" Form::Flag;
        "reset_communication" Form::Flag;
        "software_file" Form::Text;
        "software_version" U32;
        "configuration_file" Form::Ignored;
        "restore_configuration" U8;
        "sdo" Form::Objects;
        "vendor_id" Form::Ignored;
        "product_code" Form::Ignored;
        "driver" Form::Ignored;
        "package" Form::Ignored;
        "namespace" Form::Ignored;
        "remappings" Form::Ignored;
        "container_name" Form::Ignored;
        "enable_lazy_load" Form::Ignored;
        "boot_timeout_ms" Form::Ignored;
        "sdo_timeout_ms" Form::Ignored;
        "non_transmit_timeout" Form::Ignored;
        "polling" Form::Ignored;
        "period" Form::Ignored;
        "diagnostics" Form::Ignored;
        "switching_state" Form::Ignored;
        "position_mode" Form::Ignored;
        "velocity_mode" Form::Ignored;
        "effort_mode" Form::Ignored;
        "homing_timeout_seconds" Form::Ignored;
        "scale_pos_to_dev" Form::Ignored;
        "scale_pos_from_dev" Form::Ignored;
        "scale_vel_to_dev" Form::Ignored;
        "scale_vel_from_dev" Form::Ignored;
        "scale_eff_from_dev" Form::Ignored;
        "offset_pos_to_dev" Form::Ignored;
        "offset_pos_from_dev" Form::Ignored;
    },
};

static PDO: Section = Section {
    name: "the section of a PDO",
    keys: keys! {
        "enabled" Form::Flag;
        "cob_id" Form::IntegerOrText;
        "transmission" U8;
        "inhibit_time" U16;
        "event_timer" U16;
        "event_deadline" U16;
        "sync_start" Form::Integer(0, 240);
        "mapping" Form::Objects;
    },
};

static MAPPED: Section = Section {
    name: "a mapped object",
    keys: keys! {
        "index" U16;
        "sub_index" U8;
    },
};

static SDO: Section = Section {
    name: "a value in `sdo`",
    keys: keys! {
        "index" U16;
        "sub_index" U8;
        "value" Form::IntegerOrText;
    },
};

static SECTIONS: [&Section; 6] = [&OPTIONS, &MASTER, &NODE, &PDO, &MAPPED, &SDO];

const NAMES: Names = Names { id: "node_id", heartbeat: "heartbeat_producer", mapping: "mapping" };

/// Values of the section `options`, or their defaults.
struct Defaults {
    dcf_path: Option<At<String>>,
    heartbeat_multiplier: f64,
    retry_factor: u8,
}

/// Reads the tree of a file.
pub(super) fn read(root: &Node, diagnostics: &mut Diagnostics) -> DeclaredNetwork {
    let mut reader = Reader { diagnostics, sections: &SECTIONS };
    let entries = reader.entries(root, "sections of the master and of the nodes");
    let section = |name: &str| entries.iter().find(|entry| *entry.key.value == *name);
    let mut defaults =
        Defaults { dcf_path: None, heartbeat_multiplier: HEARTBEAT_MULTIPLIER, retry_factor: RETRY_FACTOR };
    if let Some(options) = section("options") {
        let options = reader.table(&options.value, &OPTIONS);
        defaults.dcf_path = reader.text(options, "dcf_path");
        let multiplier = reader.number(options, "heartbeat_multiplier");
        defaults.heartbeat_multiplier = multiplier.map_or(HEARTBEAT_MULTIPLIER, |multiplier| multiplier.value);
        let factor = reader.integer(options, "retry_factor");
        defaults.retry_factor = factor.map_or(RETRY_FACTOR, |factor| factor.value);
    }
    let mut network = DeclaredNetwork::default();
    if let Some(entry) = section("master") {
        let table = reader.table(&entry.value, &MASTER);
        network.bit_rate = reader.integer(table, "baudrate");
        let mut master = common::master(&mut reader, table, &NAMES);
        if table.get("heartbeat_multiplier").is_none() {
            master.heartbeat_multiplier.value = defaults.heartbeat_multiplier;
        }
        master.span = entry.key.span;
        network.master = Some(master);
    }
    let is_node = |entry: &&Entry| {
        !matches!(entry.key.as_str(), "master" | "options" | "defaults" | "nodes") && !entry.key.starts_with('.')
    };
    for entry in entries.iter().filter(is_node) {
        network.nodes.push(node(&mut reader, entry.key.clone(), &entry.value, &defaults));
    }
    let nodes = section("nodes").map_or(&[][..], |entry| reader.entries(&entry.value, "name of the node = table"));
    let common = section("defaults").filter(|defaults| is_repeatable(&mut reader, defaults, nodes.len()));
    let common = common.map_or(&[][..], |entry| reader.entries(&entry.value, "defaults of `nodes`"));
    for entry in nodes {
        let whole = with_defaults(&mut reader, &entry.value, common);
        network.nodes.push(node(&mut reader, entry.key.clone(), &whole, &defaults));
    }
    network
}

/// Returns whether the section `defaults` is short enough to be repeated for each node. Reports a section that is too long.
fn is_repeatable(reader: &mut Reader<'_>, defaults: &Entry, nodes: usize) -> bool {
    let (elements, _) = extent(&defaults.value);
    let is_repeatable = elements.saturating_mul(nodes) <= MAX_ELEMENTS;
    if !is_repeatable {
        let message = format!("`defaults`, repeated for {nodes} nodes, has more than {MAX_ELEMENTS} elements");
        reader.diagnostics.push(Diagnostic::new(&codes::NETWORK_VALUE, defaults.key.span, message));
    }
    is_repeatable
}

/// Returns a node of the section `nodes` with the entries of `defaults` whose keys the node does not have.
fn with_defaults(reader: &mut Reader<'_>, node: &Node, defaults: &[Entry]) -> Node {
    let mut entries = reader.entries(node, NODE.name).to_vec();
    let is_missing = |default: &&Entry| entries.iter().all(|entry| entry.key.value != default.key.value);
    let missing: Vec<Entry> = defaults.iter().filter(is_missing).cloned().collect();
    entries.extend(missing);
    Node { span: node.span, content: Content::Table(entries) }
}

fn node(reader: &mut Reader<'_>, name: At<String>, content: &Node, defaults: &Defaults) -> DeclaredNode {
    let table = reader.table(content, &NODE);
    let mut node = DeclaredNode::new(name);
    node.heartbeat_multiplier.value = defaults.heartbeat_multiplier;
    node.retry_factor = defaults.retry_factor;
    node.is_description_written = false;
    common::node(reader, table, &NAMES, &mut node);
    node.device = reader.text(table, "dcf");
    node.folders = reader.text(table, "dcf_path").into_iter().chain(defaults.dcf_path.clone()).collect();
    node.upload_folder = node.folders.first().cloned();
    for key in ["rpdo", "tpdo"] {
        node.pdos.extend(common::pdos(reader, table, key, &PDO, &NAMES, mapped));
    }
    node.parameters = parameters(reader, table);
    node
}

fn mapped(reader: &mut Reader<'_>, node: &Node) -> Option<At<ObjectName>> {
    let table = reader.table(node, &MAPPED);
    address(reader, table)
}

/// Returns the address in the keys `index` and `sub_index`. Without `sub_index`, the sub-index is 0.
fn address(reader: &mut Reader<'_>, table: Table<'_>) -> Option<At<ObjectName>> {
    if table.get("index").is_none() {
        reader.missing(table, "index");
        return None;
    }
    let index: At<u16> = reader.integer(table, "index")?;
    let sub_index: Option<At<u8>> = reader.integer(table, "sub_index");
    let end = sub_index.as_ref().map_or(0, |sub_index| sub_index.span.end).max(index.span.end);
    let object = ObjectName::Address(index.value, sub_index.map_or(0, |sub_index| sub_index.value));
    Some(At::new(object, Span { end, ..index.span }))
}

fn parameters(reader: &mut Reader<'_>, table: Table<'_>) -> Vec<DeclaredParameter> {
    let list = table.get("sdo").map_or(&[][..], |node| reader.list(node));
    let parameter = |node: &Node| {
        let table = reader.table(node, &SDO);
        let object = address(reader, table)?;
        let value = match table.get("value") {
            Some(value) => reader.scalar(value)?,
            None => At::new(Scalar::Integer(0), node.span),
        };
        Some(DeclaredParameter { object, value })
    };
    list.iter().filter_map(parameter).collect()
}

#[cfg(test)]
mod tests {
    use lexibus_codegen::diagnostics::Levels;
    use lexibus_codegen::source::{FileId, Source};

    use super::*;
    use crate::syntax::parse_yaml;

    #[test]
    fn long_defaults_are_not_repeated_without_limit() {
        let of = |values: usize, nodes: usize| {
            let values = "{index: 0x2000}, ".repeat(values);
            let nodes: String = (0..nodes).map(|node| format!("  n{node}: {{node_id: 1}}\n")).collect();
            let text = format!("defaults:\n  sdo: [{values}]\nnodes:\n{nodes}");
            let tree = parse_yaml(&Source::new("bus.yml", text.into_bytes()), FileId(0)).expect("a tree");
            let mut diagnostics = Diagnostics::new(Levels::lenient());
            let network = read(&tree, &mut diagnostics);
            let messages: Vec<String> = diagnostics.list().iter().map(|found| found.message.clone()).collect();
            (network.nodes[0].parameters.len(), messages)
        };
        assert_eq!(of(1000, 100), (1000, Vec::new()));
        let message = "`defaults`, repeated for 1000 nodes, has more than 1000000 elements".to_owned();
        assert_eq!(of(1000, 1000), (0, vec![message]));
    }
}
