//! Rust modules of a network: a module for each node with the bindings of its device, and the module of the network.

use std::fmt::Write as _;

use lexibus_codegen::backend::rust::{emit_catalog, RustOptions};
use lexibus_codegen::facts::configuration::Setting;
use lexibus_codegen::ir::Bus;
use lexibus_codegen::names::{unique, Case, NameRequest};
use lexibus_codegen::number::hex32;
use lexibus_codegen::source::Source;

use super::configured::node_catalog;
use super::identity::checked;
use super::rust_text::{one_line, HEADER};
use crate::check::bus_load;
use crate::model::{Network, NetworkNode, KEEP_RUNNING};
use crate::values::Write;

/// Names that the Rust module of a node must not have. The module of a node with such a name gets the node-ID as a suffix.
const RESERVED: [&str; 6] = ["boot", "bit_rate", "network_node", "node_id", "duration", "rt"];

/// Returns the Rust files with their names: `network.rs`, and `network/<node>.rs` for each node. `options` are the options of the
/// bindings; their device name and configuration are replaced by those of the node.
pub fn rust(network: &Network, options: &RustOptions) -> Vec<(String, String)> {
    let requests: Vec<NameRequest<'_>> =
        network.nodes.iter().map(|node| NameRequest::new(&node.name.value, "node", node.id)).collect();
    let modules = unique(requests.clone(), &RESERVED, Case::Snake);
    let types = unique(requests, &["NetworkNode", "Node", "Boot", "Booted", "BootError"], Case::Pascal);
    let mut files = Vec::new();
    let mut named = Vec::new();
    for ((node, module), ty) in network.nodes.iter().zip(&modules).zip(&types) {
        let Some(text) = bindings(network, node, ty, options) else { continue };
        files.push((format!("network/{module}.rs"), text));
        named.push(Named { node, module, ty });
    }
    files.push(("network.rs".to_owned(), module(network, &named)));
    files
}

/// A node with its names in Rust.
struct Named<'n> {
    node: &'n NetworkNode,
    module: &'n str,
    ty: &'n str,
}

/// Returns the bindings of a node's device with the configured values and PDOs of the node. Returns `None` if there are none.
fn bindings(network: &Network, node: &NetworkNode, ty: &str, options: &RustOptions) -> Option<String> {
    let configuration = node.writes.iter().map(|write| setting(node, write)).collect();
    let options =
        RustOptions { device_name: Some(ty.to_owned()), configuration: Some(configuration), ..options.clone() };
    emit_catalog(&node_catalog(network, node), &options)
}

/// Returns a write as a setting of the constant `CONFIGURATION`.
fn setting(node: &NetworkNode, write: &Write) -> Setting {
    Setting {
        object: write.object,
        bytes: write.bytes.clone(),
        adds_node_id: false,
        is_default: false,
        is_write_only: node.item(write.object).is_some_and(|item| !item.access_on(Bus::CanOpen).readable()),
    }
}

/// Returns the module of the network.
fn module(network: &Network, nodes: &[Named<'_>]) -> String {
    let mut text = format!("{HEADER}\n");
    text += "use core::time::Duration;\n\nuse ::lexibus::clients::canopen::{Boot, BootError, Booted, CanPort, ErrorControl, Node};\n";
    text += "use ::lexibus::NodeId;\n\n";
    for Named { node, module, .. } in nodes {
        let name = one_line(&node.name.value);
        let _ = writeln!(text, "/// Bindings and configuration of the node `{name}`.");
        let _ = writeln!(text, "#[path = \"network/{module}.rs\"]\npub mod {module};");
    }
    text.push('\n');
    for Named { module, ty, .. } in nodes {
        let _ = writeln!(text, "pub use {module}::{ty};");
    }
    let _ = write!(text, "\n/// Bit rate in kbit/s.\npub const BIT_RATE: u16 = {};\n\n", network.bit_rate);
    documentation(&mut text, network, nodes);
    text += TRAIT;
    for named in nodes {
        implementation(&mut text, network, named);
    }
    text
}

const TRAIT: &str = r"pub trait NetworkNode<P: CanPort>: Sized {
    /// Node-ID of the node.
    const NODE_ID: NodeId;

    /// Steps of the boot of the node (CiA 302-2): identity, configuration, start and error control.
    const BOOT: Boot;

    /// Creates the driver of the node on a port.
    fn on(port: P) -> Self;

    /// Boots the node: compares its identity, writes the configuration unless the node has stored it, and starts the node.
    ///
    /// # Errors
    ///
    /// Returns the step that failed.
    fn boot(&mut self) -> Result<Booted, BootError<P::Error>>;
}

/// Returns a node-ID of this file.
const fn node_id(id: u8) -> NodeId {
    match NodeId::new(id) {
        Some(id) => id,
        None => panic!(),
    }
}
";

fn documentation(text: &mut String, network: &Network, nodes: &[Named<'_>]) {
    let name = if network.name.is_empty() { String::new() } else { format!(" `{}`", one_line(&network.name)) };
    let _ = writeln!(text, "/// A node of the network{name}.\n///");
    text.push_str("/// | node | node-ID | device | type |\n/// |---|---|---|---|\n");
    for Named { node, ty, .. } in nodes {
        let (name, device) = (one_line(&node.name.value), one_line(&node.device().name));
        let _ = writeln!(text, "/// | {name} | {} | {device} | [`{ty}`] |", node.id);
    }
    let load = bus_load(network);
    let _ = writeln!(text, "///\n/// Bus load of all cyclic frames: {}.", load.share());
}

fn implementation(text: &mut String, network: &Network, named: &Named<'_>) {
    let Named { node, ty, .. } = named;
    let _ = write!(
        text,
        "\nimpl<P: CanPort> NetworkNode<P> for {ty}<Node<P>> {{\n    const NODE_ID: NodeId = node_id({});\n\n    const BOOT: Boot = {};\n\n    \
         fn on(port: P) -> Self {{\n        {ty}::new(Node::new(port, node_id({})))\n    }}\n\n    \
         fn boot(&mut self) -> Result<Booted, BootError<P::Error>> {{\n        \
         self.client().boot(&<Self as NetworkNode<P>>::BOOT)\n    }}\n}}\n",
        node.id,
        boot(network, named),
        node.id,
    );
}

/// Returns the Rust expression of a node's constant `BOOT`.
fn boot(network: &Network, named: &Named<'_>) -> String {
    let Named { node, module, .. } = named;
    let mut text = format!("Boot::new({})", error_control(node));
    let mut call = |method: &str, argument: String| {
        let _ = write!(text, "\n        .{method}({argument})");
    };
    if node.assignment & KEEP_RUNNING != 0 {
        call("keep_running", String::new());
    }
    let patience = network.master.as_ref().map_or(0, |master| master.boot_time);
    call("reset", format!("Duration::from_millis({})", if patience == 0 { BOOT_TIME } else { patience }));
    let [vendor, product, revision, serial] = checked(node);
    let numbers = [
        ("device_type", node.device_type),
        ("vendor_id", vendor),
        ("product_code", product),
        ("revision_number", revision),
        ("serial_number", serial),
    ];
    for (method, number) in numbers.into_iter().filter(|(_, number)| *number != 0) {
        call(method, hex32(number));
    }
    for (method, version) in ["hardware_version", "software_version"].into_iter().zip(&node.versions) {
        version.iter().for_each(|version| call(method, format!("{version:?}")));
    }
    if !node.writes.is_empty() {
        call("configuration", format!("{module}::CONFIGURATION"));
    }
    if node.store {
        let (milliseconds, days) = date(node);
        call("configuration_date", format!("::lexibus::TimeOfDay::new({milliseconds}, {days})"));
        call("store", String::new());
    }
    text
}

/// Timeout in ms for the boot-up message of a node if the `boot_time` of the master is 0 or missing.
const BOOT_TIME: u32 = 5000;

fn error_control(node: &NetworkNode) -> String {
    match (node.heartbeat.value, node.guard_time, node.life_time_factor) {
        (1.., ..) => format!("ErrorControl::Heartbeat(Duration::from_millis({}))", node.heartbeat_time()),
        (0, time @ 1.., factor @ 1..) => {
            format!(
                "ErrorControl::Guarding {{ guard_time: Duration::from_millis({time}), life_time_factor: {factor} }}"
            )
        }
        _ => "ErrorControl::None".to_owned(),
    }
}

/// Returns the date of the configuration: milliseconds and days for 0x1020. The date is computed from the SHA-256 of the
/// configuration. Equal configurations therefore have equal dates, and different configurations almost certainly have
/// different dates.
fn date(node: &NetworkNode) -> (u32, u16) {
    let entries = node.writes.iter().map(|write| (write.object, write.bytes.as_slice()));
    let digest = Source::new("", super::concise(entries)).sha256().to_owned();
    let number = |range: std::ops::Range<usize>| u32::from_str_radix(&digest[range], 16).unwrap_or(1);
    // The date must not be January 1, 1984, which represents a missing date.
    (number(0..8) % 86_400_000, (number(8..12) as u16).max(1))
}
