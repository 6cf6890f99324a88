//! The names of PDOs.

use std::borrow::Cow;
use std::collections::{HashMap, HashSet};

use super::handles::HandleNames;
use crate::backend::rust::reachable::is_module;
use crate::backend::rust::scope::{ObjectBus, Scope};
use crate::ir::{Direction, Pdo, PdoEntry, PdoEntryKind};
use crate::names::{self, Case, Wish};

/// A PDO, and the names of its struct and fields.
pub(in crate::backend::rust) struct NamedPdo<'a> {
    pub pdo: &'a Pdo,
    pub name: String,
    /// The fields of a PDO that has a struct.
    pub fields: Vec<NamedField<'a>>,
}

/// An entry that has a field, and its name, as yet without an escape.
pub(in crate::backend::rust) struct NamedField<'a> {
    pub entry: &'a PdoEntry,
    pub name: String,
}

/// The names of PDOs and of their fields.
pub(super) fn names<'a>(scope: &Scope<'a>, handles: &HandleNames<'_>) -> Vec<NamedPdo<'a>> {
    let named = scope.pdos.iter().zip(struct_names(scope));
    named.map(|(pdo, name)| NamedPdo { pdo, name, fields: fields(scope, handles, pdo) }).collect()
}

/// The fields of a PDO. A field is called as the accessor of its item; an element of an array, an entry without a name, and an entry whose
/// name another field has, as object and entry. What the description of the PDO calls the entry counts only if the dictionary doesn't have the
/// item.
fn fields<'a>(scope: &Scope<'_>, handles: &HandleNames<'_>, pdo: &'a Pdo) -> Vec<NamedField<'a>> {
    if !is_generated(pdo) {
        return Vec::new();
    }
    let entries: Vec<&PdoEntry> = pdo.entries.iter().filter(|entry| is_field(entry)).collect();
    let own_name = |entry: &PdoEntry| {
        let fallback = format!("object {:04X} {:02X}", entry.index, entry.sub_index);
        let wish = Wish { name: &title(scope, entry), fallback, suffix: String::new() };
        names::identifier(&wish, Case::Snake)
    };
    let whole =
        |entry: &PdoEntry| entry.item.and_then(|id| handles.whole(id)).map_or_else(|| own_name(entry), Cow::into_owned);
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
        let place = if is_again { format!("_{}", entry.bit_offset) } else { String::new() };
        format!("{:04X}_{}{place}", entry.index, entry.sub_index)
    };
    let suffixes: Vec<String> = entries.iter().map(suffix).collect();
    let suffixes = suffixes.iter().map(String::as_str);
    let names = names::distinct(&plain, suffixes, &["self", "super", "crate"], Case::Snake);
    entries.into_iter().zip(names).map(|(entry, name)| NamedField { entry, name }).collect()
}

/// What the source calls a mapped entry: its name in the PDO, else that of its object, and of one of several values also its own.
pub(in crate::backend::rust) fn title(scope: &Scope<'_>, entry: &PdoEntry) -> String {
    if scope.bus == ObjectBus::CoE && !entry.name.is_empty() {
        return entry.name.to_string();
    }
    let Some(group) = scope.object(entry.index) else { return entry.name.to_string() };
    if !is_module(group) {
        return group.name.to_string();
    }
    // Compact objects repeat the object's name in that of each entry.
    match entry.name.starts_with(group.name.as_str()) {
        true => entry.name.to_string(),
        false => format!("{} {}", group.name, entry.name),
    }
}

/// Those of CANopen go by their number, on EtherCAT too if the device is on both; those of EtherCAT have names.
fn struct_names(scope: &Scope<'_>) -> Vec<String> {
    let all_numbered = scope.pdos.iter().all(|pdo| pdo.communication.is_some());
    let by_number = |pdo: &Pdo| all_numbered || scope.bus_of(pdo) == ObjectBus::CanOpen;
    let numbers = numbered(scope.pdos.iter().filter(|pdo| by_number(pdo)));
    let mut named = names_by_source(scope, |pdo| !by_number(pdo), &numbers).into_iter();
    let mut numbers = numbers.into_iter();
    let name = |pdo: &Pdo| if by_number(pdo) { numbers.next() } else { named.next() };
    scope.pdos.iter().filter_map(name).collect()
}

/// `RxPdo1`; of several with one number, as where a table and the dictionary describe one, the others are `RxPdo1_2`, ….
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

/// The names that PDOs have in their source; none of them is one of `numbers`.
fn names_by_source(scope: &Scope<'_>, wanted: impl Fn(&Pdo) -> bool, numbers: &[String]) -> Vec<String> {
    let mut seen = HashSet::new();
    let wishes: Vec<Wish<'_>> = scope
        .pdos
        .iter()
        .filter(|pdo| wanted(pdo))
        .map(|pdo| {
            // One index twice, on two sync managers, is a fault of the description.
            let twice = if seen.insert(pdo.mapping_index) { String::new() } else { format!("_{}", pdo.origin.line) };
            Wish::new(&pdo.name, prefix(pdo.direction), format!("{:04X}{twice}", pdo.mapping_index))
        })
        .collect();
    let reserved: Vec<&str> = RESERVED.iter().copied().chain(numbers.iter().map(String::as_str)).collect();
    names::unique(&wishes, &reserved, Case::Pascal)
}

/// Names that the code of PDOs uses itself, and those of its constructors, which must not be that of the type.
const RESERVED: [&str; 13] =
    ["Self", "Result", "Ok", "Err", "Option", "Some", "None", "AsRef", "AsMut", "B", "At", "New", "Unpack"];

fn prefix(direction: Direction) -> &'static str {
    match direction {
        Direction::Receive => "RxPdo",
        Direction::Transmit => "TxPdo",
    }
}

/// Whether there is a struct for a PDO.
pub(in crate::backend::rust) fn is_generated(pdo: &Pdo) -> bool {
    let mut mapped = pdo.entries.iter().filter(|entry| is_field(entry)).peekable();
    mapped.peek().is_some() && mapped.all(|entry| entry.bits <= crate::limits::MAX_FIELD_BITS)
}

/// Whether an entry has a field.
pub(in crate::backend::rust) fn is_field(entry: &PdoEntry) -> bool {
    entry.kind != PdoEntryKind::Padding && entry.bits > 0
}
