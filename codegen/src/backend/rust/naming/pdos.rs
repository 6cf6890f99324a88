//! Names of PDOs and their fields.

use std::borrow::Cow;

use super::handles::HandleNames;
use crate::backend::rust::scope::{ObjectBus, Scope};
use crate::collections::{HashMap, HashSet};
use crate::ir::{Direction, Pdo, PdoEntry, PdoEntryKind};
use crate::names::{self, Case, NameRequest};

/// A PDO and the names of its struct and fields.
pub(in crate::backend::rust) struct NamedPdo<'a> {
    pub pdo: &'a Pdo,
    pub name: String,
    /// Fields of the PDO. The list is empty if no struct is generated for the PDO.
    pub fields: Vec<NamedField<'a>>,
}

/// A PDO entry that becomes a field, with the name of the field. The name is not escaped.
pub(in crate::backend::rust) struct NamedField<'a> {
    pub entry: &'a PdoEntry,
    pub name: String,
}

/// Returns the PDOs with the names of their structs and fields.
pub(super) fn names<'a>(scope: &Scope<'a>, handles: &HandleNames<'_>) -> Vec<NamedPdo<'a>> {
    let named = scope.pdos.iter().zip(struct_names(scope));
    named.map(|(pdo, name)| NamedPdo { pdo, name, fields: fields(scope, handles, pdo) }).collect()
}

/// Returns the fields of a PDO. A field has the name of its item's accessor. The names of the object and the entry are
/// combined for array elements, unnamed entries, and entries with ambiguous names. The name in the PDO is used only if
/// the object dictionary does not contain the item.
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
    let mut count: HashMap<&str, usize> = HashMap::default();
    for name in &short {
        *count.entry(name).or_default() += 1;
    }
    let named = entries.iter().zip(&short);
    let plain: Vec<String> =
        named.map(|(entry, short)| if count[short.as_str()] > 1 { whole(entry) } else { short.clone() }).collect();
    let mut seen = HashSet::default();
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

/// Returns the name of a mapped entry in the description. On EtherCAT, this is the name in the PDO, if there is one.
/// Otherwise, it is the name of the object. If the object has several values, the name of the entry is appended. If the
/// object dictionary does not contain the object, returns the name in the PDO.
pub(in crate::backend::rust) fn title(scope: &Scope<'_>, entry: &PdoEntry) -> String {
    if scope.bus == ObjectBus::CoE && !entry.name.is_empty() {
        return entry.name.to_string();
    }
    let Some(group) = scope.object(entry.index) else { return entry.name.to_string() };
    if !group.has_entries() {
        return group.name.to_string();
    }
    // If the file describes the entries of an object in compact form, the names of the entries already start with the
    // name of the object.
    match entry.name.starts_with(group.name.as_str()) {
        true => entry.name.to_string(),
        false => format!("{} {}", group.name, entry.name),
    }
}

/// Returns the names of the PDO structs. The name of a CANopen PDO contains the number of the PDO. If all PDOs of the
/// device have communication parameters, the names of EtherCAT PDOs contain the number too. Other EtherCAT PDOs have
/// the names of the description.
fn struct_names(scope: &Scope<'_>) -> Vec<String> {
    let all_numbered = scope.pdos.iter().all(|pdo| pdo.communication.is_some());
    let by_number = |pdo: &Pdo| all_numbered || scope.bus_of(pdo) == ObjectBus::CanOpen;
    let numbers = numbered(scope.pdos.iter().filter(|pdo| by_number(pdo)));
    let mut named = names_by_source(scope, |pdo| !by_number(pdo), &numbers).into_iter();
    let mut numbers = numbers.into_iter();
    let name = |pdo: &Pdo| if by_number(pdo) { numbers.next() } else { named.next() };
    scope.pdos.iter().filter_map(name).collect()
}

/// Returns names such as `RxPdo1`. If several PDOs have the same number, the next names are `RxPdo1_2`, and so on. PDOs
/// have the same number, for example, if a register table and the object dictionary describe the same PDO.
fn numbered<'p>(pdos: impl Iterator<Item = &'p Pdo>) -> Vec<String> {
    let mut seen: HashMap<String, usize> = HashMap::default();
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

/// Returns names that are based on the PDO names in the description. None of the names is in `numbers`.
fn names_by_source(scope: &Scope<'_>, is_named: impl Fn(&Pdo) -> bool, numbers: &[String]) -> Vec<String> {
    let mut seen = HashSet::default();
    let name_requests = scope.pdos.iter().filter(|pdo| is_named(pdo)).map(|pdo| {
        // Several PDOs may have the same index, for example PDOs of different sync managers. The line number then
        // makes the suffix unique.
        let twice = if seen.insert(pdo.mapping_index) { String::new() } else { format!("_{}", pdo.origin.line) };
        NameRequest::new(&pdo.name, prefix(pdo.direction), format!("{:04X}{twice}", pdo.mapping_index))
    });
    let reserved: Vec<&str> = RESERVED.iter().copied().chain(numbers.iter().map(String::as_str)).collect();
    names::unique(name_requests, &reserved, Case::Pascal)
}

/// Reserved names: the keyword `Self`, names that the generated code of PDOs uses, and names of constructors, because
/// clippy reports a constructor that has the name of its type.
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

/// Returns whether an entry becomes a field.
pub(in crate::backend::rust) fn is_field(entry: &PdoEntry) -> bool {
    entry.kind != PdoEntryKind::Padding && entry.bits > 0
}
