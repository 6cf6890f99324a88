//! DBC of the enabled PDOs, with scales, units, limits and names of values.

use std::collections::HashSet;
use std::fmt::Write as _;

use lexibus_codegen::facts::physical::shown_unit;
use lexibus_codegen::facts::types;
use lexibus_codegen::ir::owner::Owner;
use lexibus_codegen::ir::{Direction, Documentation, Item, Scale, Type, Value};
use lexibus_codegen::number;

use super::dbc_names::{Name, Names, MASTER};
use super::dbc_text::{encoded, text};
use crate::model::{MappedObject, Network, NetworkNode, NetworkPdo, EXTENDED};

/// Name that a DBC contains if the sender is unknown or there is no receiver.
const NOBODY: &str = "Vector__XXX";

/// Returns a DBC in Windows-1252, with a message for each enabled TPDO, and for each CAN-ID that only RPDOs have.
pub fn dbc(network: &Network) -> Vec<u8> {
    let mut out = Dbc::default();
    let mut names = Names::default();
    let nodes: Vec<Name> = network.nodes.iter().map(|node| names.unique(&node.name.value)).collect();
    nodes.iter().for_each(|name| out.long_name("Node", &format!("BU_ {}", name.short), name));
    let nodes = Nodes { network, names: nodes };
    for (node, pdo) in network.pdos(Direction::Transmit) {
        let receivers = network.receivers(pdo.cob_id).map(|node| nodes.of(node).to_owned());
        let master = network.master.as_ref().filter(|master| master.exchanges_pdos).map(|_| MASTER.to_owned());
        message(&mut out, &mut names, node, pdo, nodes.of(node), receivers.chain(master).collect());
    }
    for (node, pdo) in sent_by_others(network) {
        let receivers = network.receivers(pdo.cob_id).map(|node| nodes.of(node).to_owned()).collect();
        let sender = if network.is_sent_by_master(pdo.can_id()) { MASTER } else { NOBODY };
        message(&mut out, &mut names, node, pdo, sender, receivers);
    }
    encoded(&out.text(&nodes))
}

/// Returns the RPDOs whose CAN-ID no TPDO has. RPDOs with the same CAN-ID are one message, so only the first of them is
/// returned.
fn sent_by_others(network: &Network) -> Vec<(&NetworkNode, &NetworkPdo)> {
    let mut known: HashSet<u32> = network.pdos(Direction::Transmit).map(|(_, pdo)| pdo.can_id()).collect();
    network.pdos(Direction::Receive).filter(|(_, pdo)| known.insert(pdo.can_id())).collect()
}

struct Nodes<'n> {
    network: &'n Network,
    names: Vec<Name>,
}

impl Nodes<'_> {
    fn of(&self, node: &NetworkNode) -> &str {
        let at = self.network.nodes.iter().position(|other| other.id == node.id);
        at.map_or(NOBODY, |at| self.names[at].short.as_str())
    }
}

/// The sections of a DBC file.
#[derive(Default)]
struct Dbc {
    messages: String,
    comments: String,
    attributes: String,
    values: String,
    types: String,
}

impl Dbc {
    /// Writes the attribute with the long form of a name if the short form differs.
    fn long_name(&mut self, kind: &str, element: &str, name: &Name) {
        if name.long != name.short {
            let _ = writeln!(self.attributes, "BA_ \"System{kind}LongSymbol\" {element} \"{}\";", name.long);
        }
    }

    fn text(&self, nodes: &Nodes<'_>) -> String {
        let master = nodes.network.master.as_ref().map(|_| MASTER);
        let names: Vec<&str> = nodes.names.iter().map(|name| name.short.as_str()).chain(master).collect();
        let name = &nodes.network.name;
        let comment = if name.is_empty() { String::new() } else { format!("CM_ \"{}\";\n", text(name)) };
        format!(
            "VERSION \"\"\n\nNS_ :\n\nBS_:\n\nBU_: {}\n\n{}{comment}{}\
             BA_DEF_ BU_ \"SystemNodeLongSymbol\" STRING ;\nBA_DEF_ BO_ \"SystemMessageLongSymbol\" STRING ;\n\
             BA_DEF_ SG_ \"SystemSignalLongSymbol\" STRING ;\nBA_DEF_DEF_ \"SystemNodeLongSymbol\" \"\";\n\
             BA_DEF_DEF_ \"SystemMessageLongSymbol\" \"\";\nBA_DEF_DEF_ \"SystemSignalLongSymbol\" \"\";\n{}{}{}",
            names.join(" "),
            self.messages,
            self.comments,
            self.attributes,
            self.values,
            self.types
        )
    }
}

fn message(
    out: &mut Dbc,
    names: &mut Names,
    node: &NetworkNode,
    pdo: &NetworkPdo,
    sender: &str,
    receivers: Vec<String>,
) {
    let id = match pdo.can_id() {
        id if id & EXTENDED != 0 => 1 << 31 | id & 0x1FFF_FFFF,
        id => id,
    };
    let direction = if pdo.direction == Direction::Transmit { "TPDO" } else { "RPDO" };
    let name = names.unique(&format!("{}_{direction}{}", node.name.value, pdo.number));
    let _ = writeln!(out.messages, "BO_ {id} {}: {} {sender}", name.short, pdo.bytes());
    out.long_name("Message", &format!("BO_ {id}"), &name);
    let receivers = if receivers.is_empty() { NOBODY.to_owned() } else { receivers.join(",") };
    let (mut start, mut names) = (0, Names::default());
    for entry in &pdo.entries {
        if let Some(item) = node.mapped_item(entry) {
            signal(out, id, &mut names, &Signal { node, item, entry, start }, &receivers);
        }
        start += u32::from(entry.bits);
    }
    out.messages.push('\n');
}

/// A mapped object with the position of its first bit.
struct Signal<'n> {
    node: &'n NetworkNode,
    item: &'n Item,
    entry: &'n MappedObject,
    start: u32,
}

fn signal(out: &mut Dbc, id: u32, names: &mut Names, signal: &Signal<'_>, receivers: &str) {
    let Signal { node, item, entry, start } = signal;
    let name = names.unique(&node.entry_name((entry.index, entry.sub_index), " "));
    let ty = mapped_type(types::basic(&node.device().types, item.object_type()), entry.bits);
    let (factor, offset) = scale(item);
    let sign = if matches!(ty, Type::Integer(_) | Type::Real32 | Type::Real64) { '-' } else { '+' };
    let (low, high) = limits(item, node.id, factor, offset);
    let unit = unit(item);
    let bits = entry.bits;
    let short = &name.short;
    let _ = writeln!(
        out.messages,
        " SG_ {short} : {start}|{bits}@1{sign} ({factor},{offset}) [{low}|{high}] \"{}\" {receivers}",
        text(unit)
    );
    let _ = writeln!(out.comments, "CM_ SG_ {id} {short} \"{}\";", text(&comment(item, entry)));
    out.long_name("Signal", &format!("SG_ {id} {short}"), &name);
    if let Some((values, _)) = Owner::of_types(&node.device().types).enumeration(item.object_type()) {
        let single = values.iter().filter(|value| value.last.is_none() && value.is_named());
        let list: Vec<String> = single.map(|value| format!("{} \"{}\"", value.value, text(&value.name))).collect();
        if !list.is_empty() {
            let _ = writeln!(out.values, "VAL_ {id} {short} {} ;", list.join(" "));
        }
    }
    match ty {
        Type::Real32 => drop(writeln!(out.types, "SIG_VALTYPE_ {id} {short} : 1;")),
        Type::Real64 => drop(writeln!(out.types, "SIG_VALTYPE_ {id} {short} : 2;")),
        _ => {}
    }
}

/// Returns the type of a mapped object. A real number that is mapped with a wrong length becomes an unsigned integer, because its
/// bits have no known meaning.
fn mapped_type(ty: Type, bits: u8) -> Type {
    match (ty, bits) {
        (Type::Real32, 32) | (Type::Real64, 64) => ty,
        (Type::Real32 | Type::Real64, _) => Type::Unsigned(bits),
        _ => ty,
    }
}

fn comment(item: &Item, entry: &MappedObject) -> String {
    let address = number::object(entry.index, entry.sub_index);
    match Documentation::text_of(item.documentation.as_deref()) {
        "" => format!("{address} {}", item.name),
        text => format!("{address} {}: {text}", item.name),
    }
}

/// Returns factor and offset of the physical value. They are 1 and 0 if the item has no scale, or a scale that is not linear, which a
/// DBC cannot express.
fn scale(item: &Item) -> (f64, f64) {
    match item.quantity.as_ref().and_then(|quantity| quantity.scale.as_ref()) {
        Some(Scale::Linear { factor, offset }) => (*factor, *offset),
        _ => (1.0, 0.0),
    }
}

/// Returns the unit of the physical value. The unit is empty if the scale is not linear, because the DBC then contains raw values.
fn unit(item: &Item) -> &str {
    match &item.quantity {
        Some(quantity) if matches!(quantity.scale, None | Some(Scale::Linear { .. })) => shown_unit(quantity),
        _ => "",
    }
}

/// Returns minimum and maximum of the physical value. Returns 0 and 0, which mean no limits in a DBC, unless both are known.
fn limits(item: &Item, id: u8, factor: f64, offset: f64) -> (f64, f64) {
    let physical = |limit: &Option<Value>| Some(limit.as_ref()?.resolved(id).as_real()? * factor + offset);
    match (physical(&item.limits.low), physical(&item.limits.high)) {
        (Some(low), Some(high)) if low <= high => (low, high),
        (Some(low), Some(high)) => (high, low),
        _ => (0.0, 0.0),
    }
}
