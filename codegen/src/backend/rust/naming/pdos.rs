//! Names of PDOs.

use std::borrow::Cow;
use std::collections::{HashMap, HashSet};

use super::handles::HandleNames;
use crate::backend::rust::reachable::is_module;
use crate::backend::rust::scope::{ObjectBus, Scope};
use crate::ir::{Direction, Pdo, PdoEntry, PdoEntryKind};
use crate::names::{self, Case, NameRequest};

/// A PDO and the names of its struct and fields.
pub(in crate::backend::rust) struct NamedPdo<'a> {
    pub pdo: &'a Pdo,
    pub name: String,
    /// Fields of the PDO; empty if the PDO has no struct.
    pub fields: Vec<NamedField<'a>>,
}

/// An entry with a field, and its name before escaping.
pub(in crate::backend::rust) struct NamedField<'a> {
    pub entry: &'a PdoEntry,
    pub name: String,
}

/// Returns the names of the PDOs and of their fields.
pub(super) fn names<'a>(scope: &Scope<'a>, handles: &HandleNames<'_>) -> Vec<NamedPdo<'a>> {
    let named = scope.pdos.iter().zip(struct_names(scope));
    named.map(|(pdo, name)| NamedPdo { pdo, name, fields: fields(scope, handles, pdo) }).collect()
}

/// Returns the fields of a PDO. A field has the name of its item's accessor. Elements of arrays, entries without a
/// name, and entries whose name is not unique are named after object and entry. The name in the PDO is used only if the
/// dictionary does not contain the item.
fn fields<'a>(scope: &Scope<'_>, handles: &HandleNames<'_>, pdo: &'a Pdo) -> Vec<NamedField<'a>> {
    if !is_generated(pdo) {
        return Vec::new();
    }
    let entries: Vec<&PdoEntry> = pdo.entries.iter().filter(|entry| is_field(entry)).collect();
    let name_in_pdo = |entry: &PdoEntry| {
        let fallback = format!("object {:04X} {:02X}", entry.index, entry.sub_index);
        let name_request = NameRequest { name: &title(scope, entry), fallback, suffix: String::new() };
        names::identifier(&name_request, Case::Snake)
    };
    let whole = |entry: &PdoEntry| {
        entry.item.and_then(|id| handles.whole(id)).map_or_else(|| name_in_pdo(entry), Cow::into_owned)
    };
    let of_entry = |entry: &PdoEntry| entry.item.and_then(|id| handles.of_entry(id));
    let short: Vec<String> =
        entries.iter().map(|entry| of_entry(entry).map_or_else(|| whole(entry), str::to_owned)).collect();
    let mut count: HashMap<&str, usize> = HashMap::new();
    for name in &short {
        *count.entry(name).or_default() += 1;
    }
    let named = entries.iter().zip(&short);
    let plain: Vec<String> =
        named.map(|(entry, short)| if count[short.as_str()] > 1 { whole(entry) } else { short.clone() }).collect();
    let mut seen = HashSet::new();
    let suffix = |entry: &&PdoEntry| {
        let is_again = !seen.insert((entry.index, entry.sub_index));
        let position = if is_again { format!("_{}", entry.bit_offset) } else { String::new() };
        format!("{:04X}_{}{position}", entry.index, entry.sub_index)
    };
    let suffixes: Vec<String> = entries.iter().map(suffix).collect();
    let suffixes = suffixes.iter().map(String::as_str);
    let names = names::distinct(&plain, suffixes, &["self", "super", "crate"], Case::Snake);
    entries.into_iter().zip(names).map(|(entry, name)| NamedField { entry, name }).collect()
}

/// Returns the name of a mapped entry in the description: its name in the PDO, otherwise the name of its object. For an
/// object with several values, the name of the entry follows.
pub(in crate::backend::rust) fn title(scope: &Scope<'_>, entry: &PdoEntry) -> String {
    if scope.bus == ObjectBus::CoE && !entry.name.is_empty() {
        return entry.name.to_string();
    }
    let Some(group) = scope.object(entry.index) else { return entry.name.to_string() };
    if !is_module(group) {
        return group.name.to_string();
    }
    // Entries of compact objects repeat the name of the object.
    match entry.name.starts_with(group.name.as_str()) {
        true => entry.name.to_string(),
        false => format!("{} {}", group.name, entry.name),
    }
}

/// Returns the names of the structs. PDOs of CANopen are named by their number, also on EtherCAT if the device supports
/// both. PDOs of EtherCAT have names.
fn struct_names(scope: &Scope<'_>) -> Vec<String> {
    let all_numbered = scope.pdos.iter().all(|pdo| pdo.communication.is_some());
    let by_number = |pdo: &Pdo| all_numbered || scope.bus_of(pdo) == ObjectBus::CanOpen;
    let numbers = numbered(scope.pdos.iter().filter(|pdo| by_number(pdo)));
    let mut named = names_by_source(scope, |pdo| !by_number(pdo), &numbers).into_iter();
    let mut numbers = numbers.into_iter();
    let name = |pdo: &Pdo| if by_number(pdo) { numbers.next() } else { named.next() };
    scope.pdos.iter().filter_map(name).collect()
}

/// Returns names such as `RxPdo1`. Further PDOs with the same number are `RxPdo1_2`, …: a table and the dictionary may
/// both describe a PDO.
fn numbered<'p>(pdos: impl Iterator<Item = &'p Pdo>) -> Vec<String> {
    let mut seen: HashMap<String, usize> = HashMap::new();
    let name = |pdo: &Pdo| {
        let name = format!("{}{}", prefix(pdo.direction), pdo.number);
        let count = seen.entry(name.clone()).or_default();
        *count += 1;
        if *count == 1 {
            name
        } else {
            format!("{name}_{count}")
        }
    };
    pdos.map(name).collect()
}

/// Returns the names of PDOs in the description. None of them is one of `numbers`.
fn names_by_source(scope: &Scope<'_>, is_named: impl Fn(&Pdo) -> bool, numbers: &[String]) -> Vec<String> {
    let mut seen = HashSet::new();
    let name_requests: Vec<NameRequest<'_>> = scope
        .pdos
        .iter()
        .filter(|pdo| is_named(pdo))
        .map(|pdo| {
            // A PDO index that is used on two sync managers is an error in the description.
            let twice = if seen.insert(pdo.mapping_index) { String::new() } else { format!("_{}", pdo.origin.line) };
            NameRequest::new(&pdo.name, prefix(pdo.direction), format!("{:04X}{twice}", pdo.mapping_index))
        })
        .collect();
    let reserved: Vec<&str> = RESERVED.iter().copied().chain(numbers.iter().map(String::as_str)).collect();
    names::unique(&name_requests, &reserved, Case::Pascal)
}

/// Names that the generated code of PDOs uses, and the type names that would match one of its constructors.
const RESERVED: [&str; 13] =
    ["Self", "Result", "Ok", "Err", "Option", "Some", "None", "AsRef", "AsMut", "B", "At", "New", "Unpack"];

fn prefix(direction: Direction) -> &'static str {
    match direction {
        Direction::Receive => "RxPdo",
        Direction::Transmit => "TxPdo",
    }
}

/// Returns whether a struct is generated for a PDO.
pub(in crate::backend::rust) fn is_generated(pdo: &Pdo) -> bool {
    let mut mapped = pdo.entries.iter().filter(|entry| is_field(entry)).peekable();
    mapped.peek().is_some() && mapped.all(|entry| entry.bits <= crate::limits::MAX_FIELD_BITS)
}

/// Returns whether an entry has a field.
pub(in crate::backend::rust) fn is_field(entry: &PdoEntry) -> bool {
    entry.kind != PdoEntryKind::Padding && entry.bits > 0
}
