//! The names of PDOs.

use std::collections::{HashMap, HashSet};

use crate::backend::rust::scope::{ObjectBus, Scope};
use crate::ir::{Direction, Pdo, PdoEntry, PdoEntryKind};
use crate::names::{self, Case, Wish};

/// Those of CANopen go by their number, on EtherCAT too if the device is on both; those of EtherCAT have names.
pub(super) fn names(scope: &Scope<'_>) -> Vec<String> {
    let all_numbered = scope.pdos.iter().all(|pdo| pdo.communication.is_some());
    let by_number = |pdo: &Pdo| all_numbered || scope.bus_of(pdo) == ObjectBus::CanOpen;
    let numbers = numbered(scope.pdos.iter().filter(|pdo| by_number(pdo)));
    let mut named = names_by_source(scope, |pdo| !by_number(pdo), &numbers).into_iter();
    let mut numbers = numbers.into_iter();
    let own = |pdo: &Pdo| if by_number(pdo) { numbers.next() } else { named.next() };
    scope.pdos.iter().filter_map(own).collect()
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

/// The names that PDOs have in their source; none of them is one of `taken`.
fn names_by_source(scope: &Scope<'_>, wanted: impl Fn(&Pdo) -> bool, taken: &[String]) -> Vec<String> {
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
    let reserved: Vec<&str> = RESERVED.iter().copied().chain(taken.iter().map(String::as_str)).collect();
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
