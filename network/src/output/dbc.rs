//! DBC of all PDOs, with scales, units, limits and names of values.

use std::collections::HashSet;
use std::fmt::Write as _;

use lexibus_codegen::facts::physical::shown_unit;
use lexibus_codegen::facts::types;
use lexibus_codegen::ir::owner::Owner;
use lexibus_codegen::ir::{Direction, Item, Scale, Type, Value};

use crate::model::{MappedObject, Network, NetworkNode, NetworkPdo, EXTENDED};

/// Maximum length of a name in DBC. Longer names are in an attribute.
const MAX_NAME: usize = 32;

/// Name of the master in the DBC.
const MASTER: &str = "master";

/// Name of no node.
const NOBODY: &str = "Vector__XXX";

/// Returns a DBC with a message for each PDO.
pub fn dbc(network: &Network) -> String {
    let mut out = Dbc::default();
    let mut names = Names::default();
    let nodes: Vec<String> = network.nodes.iter().map(|node| names.unique(&node.name.value).short).collect();
    let nodes = Nodes { network, names: nodes };
    for (node, pdo) in network.pdos(Direction::Transmit) {
        let receivers = network.receivers(pdo.cob_id).map(|node| nodes.of(node).to_owned());
        let master = network.master.as_ref().filter(|master| master.exchanges_pdos).map(|_| MASTER.to_owned());
        message(&mut out, &mut names, (node, pdo), nodes.of(node), receivers.chain(master).collect());
    }
    for (node, pdo) in sent_by_others(network) {
        let receivers = network.receivers(pdo.cob_id).map(|node| nodes.of(node).to_owned()).collect();
        let sender = if network.is_sent_by_master(pdo.can_id()) { MASTER } else { NOBODY };
        message(&mut out, &mut names, (node, pdo), sender, receivers);
    }
    out.text(&nodes)
}

/// Returns the RPDOs that no node sends. RPDOs with one CAN-ID are one message.
fn sent_by_others(network: &Network) -> Vec<(&NetworkNode, &NetworkPdo)> {
    let mut known: HashSet<u32> = network.pdos(Direction::Transmit).map(|(_, pdo)| pdo.can_id()).collect();
    network.pdos(Direction::Receive).filter(|(_, pdo)| known.insert(pdo.can_id())).collect()
}

struct Nodes<'n> {
    network: &'n Network,
    names: Vec<String>,
}

impl Nodes<'_> {
    fn of(&self, node: &NetworkNode) -> &str {
        let at = self.network.nodes.iter().position(|other| other.id == node.id);
        at.map_or(NOBODY, |at| self.names[at].as_str())
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
    fn text(&self, nodes: &Nodes<'_>) -> String {
        let master = nodes.network.master.as_ref().map(|_| MASTER);
        let names: Vec<&str> = nodes.names.iter().map(String::as_str).chain(master).collect();
        let name = &nodes.network.name;
        let comment = if name.is_empty() { String::new() } else { format!("CM_ \"{}\";\n", escaped(name)) };
        format!(
            "VERSION \"\"\n\nNS_ :\n\nBS_:\n\nBU_: {}\n\n{}{comment}{}\
             BA_DEF_ BO_ \"SystemMessageLongSymbol\" STRING ;\nBA_DEF_ SG_ \"SystemSignalLongSymbol\" STRING ;\n\
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

/// A name with at most [`MAX_NAME`] characters, and the whole name.
struct Name {
    short: String,
    long: String,
}

/// Names that are in use.
#[derive(Default)]
struct Names(HashSet<String>);

impl Names {
    /// Returns the name for a text: letters, digits and `_`. A number makes it unique.
    fn unique(&mut self, text: &str) -> Name {
        let long = identifier(text);
        let mut short: String = long.chars().take(MAX_NAME).collect();
        let mut number = 2;
        while short == MASTER || !self.0.insert(short.clone()) {
            let suffix = format!("_{number}");
            short = long.chars().take(MAX_NAME - suffix.len()).collect::<String>() + &suffix;
            number += 1;
        }
        let is_changed = long.len() <= MAX_NAME;
        Name { long: if is_changed { short.clone() } else { long }, short }
    }
}

/// Returns an identifier of DBC.
fn identifier(text: &str) -> String {
    let mut name = String::new();
    for letter in text.chars() {
        match letter.is_ascii_alphanumeric() {
            true => name.push(letter),
            false if !name.ends_with('_') && !name.is_empty() => name.push('_'),
            false => {}
        }
    }
    let name = name.trim_end_matches('_').to_owned();
    match name.chars().next() {
        None => "_".to_owned(),
        Some(first) if first.is_ascii_digit() => format!("_{name}"),
        Some(_) => name,
    }
}

fn escaped(text: &str) -> String {
    text.replace('\\', "\\\\").replace('"', "'").replace(['\r', '\n'], " ")
}

fn message(
    out: &mut Dbc,
    names: &mut Names,
    (node, pdo): (&NetworkNode, &NetworkPdo),
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
    if name.long != name.short {
        let _ = writeln!(out.attributes, "BA_ \"SystemMessageLongSymbol\" BO_ {id} \"{}\";", name.long);
    }
    let receivers = if receivers.is_empty() { NOBODY.to_owned() } else { receivers.join(",") };
    let (mut start, mut names) = (0, Names::default());
    for entry in &pdo.entries {
        let item = node.item((entry.index, entry.sub_index)).filter(|_| entry.index >= 0x1000);
        if let Some(item) = item {
            signal(out, id, &mut names, &Signal { node, item, entry, start }, &receivers);
        }
        start += u32::from(entry.bits);
    }
    out.messages.push('\n');
}

/// A mapped object with its first bit.
struct Signal<'n> {
    node: &'n NetworkNode,
    item: &'n Item,
    entry: &'n MappedObject,
    start: u32,
}

fn signal(out: &mut Dbc, id: u32, names: &mut Names, signal: &Signal<'_>, receivers: &str) {
    let Signal { node, item, entry, start } = signal;
    let name = names.unique(&path(node, item, entry));
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
        escaped(unit)
    );
    let _ = writeln!(out.comments, "CM_ SG_ {id} {short} \"{}\";", escaped(&comment(item, entry)));
    if name.long != name.short {
        let _ = writeln!(out.attributes, "BA_ \"SystemSignalLongSymbol\" SG_ {id} {short} \"{}\";", name.long);
    }
    if let Some((values, _)) = Owner::of_types(&node.device().types).enumeration(item.object_type()) {
        let single = values.iter().filter(|value| value.last.is_none() && value.is_named());
        let list: Vec<String> = single.map(|value| format!("{} \"{}\"", value.value, escaped(&value.name))).collect();
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

/// Returns the type of a mapped object. If the mapping has another length than a real number, the bits have no known meaning.
fn mapped_type(ty: Type, bits: u8) -> Type {
    match (ty, bits) {
        (Type::Real32, 32) | (Type::Real64, 64) => ty,
        (Type::Real32 | Type::Real64, _) => Type::Unsigned(bits),
        _ => ty,
    }
}

/// Returns the name of an item, after the name of its object if the object has several items.
fn path(node: &NetworkNode, item: &Item, entry: &MappedObject) -> String {
    match node.device().object(entry.index).filter(|group| group.items.len() > 1) {
        Some(group) => format!("{} {}", group.name, item.name),
        None => item.name.to_string(),
    }
}

fn comment(item: &Item, entry: &MappedObject) -> String {
    let address = format!("0x{:04X}:{:02X}", entry.index, entry.sub_index);
    match item.documentation.as_ref().map(|documentation| documentation.text.as_str()) {
        Some(text) if !text.is_empty() => format!("{address} {}: {text}", item.name),
        _ => format!("{address} {}", item.name),
    }
}

/// Returns factor and offset of the physical value. A scale that is not linear cannot be expressed.
fn scale(item: &Item) -> (f64, f64) {
    match item.quantity.as_ref().and_then(|quantity| quantity.scale.as_ref()) {
        Some(Scale::Linear { factor, offset }) => (*factor, *offset),
        _ => (1.0, 0.0),
    }
}

/// Returns the unit of the physical value. Raw values of a scale that is not linear have no unit.
fn unit(item: &Item) -> &str {
    match &item.quantity {
        Some(quantity) if matches!(quantity.scale, None | Some(Scale::Linear { .. })) => shown_unit(quantity),
        _ => "",
    }
}

/// Returns the limits of the physical value; 0 and 0 = no limits.
fn limits(item: &Item, id: u8, factor: f64, offset: f64) -> (f64, f64) {
    let physical = |limit: &Option<Value>| Some(limit.as_ref()?.resolved(id).as_real()? * factor + offset);
    match (physical(&item.limits.low), physical(&item.limits.high)) {
        (Some(low), Some(high)) if low <= high => (low, high),
        (Some(low), Some(high)) => (high, low),
        _ => (0.0, 0.0),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn identifiers_are_unique_and_short() {
        let mut names = Names::default();
        assert_eq!(names.unique("Target velocity (rpm)").short, "Target_velocity_rpm");
        assert_eq!(names.unique("Target velocity, rpm").short, "Target_velocity_rpm_2");
        assert_eq!(names.unique("1st").short, "_1st");
        assert_eq!(names.unique("°").short, "_");
        let long = names.unique("A very long name of a parameter of a drive");
        assert_eq!((long.short.len(), long.long.as_str()), (32, "A_very_long_name_of_a_parameter_of_a_drive"));
    }
}
