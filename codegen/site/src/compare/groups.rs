//! Compares groups (objects, chapters, records, process images) and their items.

use std::ops::Range;

use super::change::Judgment;
use super::comparison::{compare_fields, each, fact, fact_as, or_default, rules, Comparison, COMPARED, POSITION};
use super::item;
use super::names::Identifiers;
use super::pairing::{Key, Matching};
use super::show::{index, indices};
use lexibus_codegen::facts::address;
use lexibus_codegen::facts::item::entry_name;
use lexibus_codegen::ir::{CompactString, Group, GroupKind, Item, Record, ToolFlags};
use lexibus_codegen::number::{bytes, hex, hex16};

/// Compares groups and their items. An item that moved to another group is still compared with its old version.
pub(super) fn compare(old: &[Group], new: &[Group], comparison: &mut Comparison<'_>) {
    let (old, new) = (Side::of(old), Side::of(new));
    let groups = Matching::of(&old.group_keys(), &new.group_keys());
    let items = Matching::of(&old.item_keys(), &new.item_keys());
    for (at, group) in old.groups.iter().enumerate() {
        let entries = old.entries_of(at);
        match groups.new_of_old[at] {
            Some(other) => comparison.within(&title(&new.groups[other]), |comparison| {
                facts(group, &new.groups[other], [old.identifier(at), new.identifier(other)], comparison);
            }),
            None => {
                let is_whole = entries.clone().all(|entry| items.new_of_old[entry].is_none());
                let judgment = if is_whole { Judgment::API_AND_WIRE } else { Judgment::NONE };
                comparison.within(&title(group), |comparison| comparison.removed(judgment));
                if is_whole {
                    continue;
                }
            }
        }
        for entry in entries {
            let old_entry = &old.entries[entry];
            match items.new_of_old[entry] {
                Some(other) => pair(old_entry, &new.entries[other], comparison),
                None => comparison.within(&old_entry.title(), |comparison| comparison.removed(Judgment::API_AND_WIRE)),
            }
        }
    }
    for (at, group) in new.groups.iter().enumerate() {
        let entries = new.entries_of(at);
        if !groups.is_new_paired[at] {
            let is_whole = entries.clone().all(|entry| !items.is_new_paired[entry]);
            let judgment = if is_whole { Judgment::ADDITION } else { Judgment::NONE };
            comparison.within(&title(group), |comparison| comparison.added(judgment));
            if is_whole {
                continue;
            }
        }
        for entry in entries.filter(|entry| !items.is_new_paired[*entry]) {
            comparison.within(&new.entries[entry].title(), |comparison| comparison.added(Judgment::ADDITION));
        }
    }
}

/// The groups of one description, with a list of all their items.
struct Side<'a> {
    groups: &'a [Group],
    identifiers: Identifiers,
    entries: Vec<Entry<'a>>,
    /// For each group, the range of its entries in the list of all items.
    ranges: Vec<Range<usize>>,
}

/// An item with its group.
struct Entry<'a> {
    group: &'a Group,
    item: &'a Item,
    /// Rust identifier of the item; empty for the value of an object without entries.
    identifier: String,
}

impl<'a> Side<'a> {
    fn of(groups: &'a [Group]) -> Self {
        let mut identifiers = Identifiers::of(groups);
        let (mut entries, mut ranges) = (Vec::new(), Vec::new());
        for (group, names) in groups.iter().zip(std::mem::take(&mut identifiers.items)) {
            let start = entries.len();
            entries.extend(group.items.iter().zip(names).map(|(item, identifier)| Entry { group, item, identifier }));
            ranges.push(start..entries.len());
        }
        Side { groups, identifiers, entries, ranges }
    }

    fn identifier(&self, group: usize) -> &str {
        &self.identifiers.groups[group]
    }

    fn entries_of(&self, group: usize) -> Range<usize> {
        self.ranges[group].clone()
    }

    fn group_keys(&self) -> Vec<Key> {
        self.groups.iter().map(|group| Key { name: group.name.to_string(), position: position(group) }).collect()
    }

    fn item_keys(&self) -> Vec<Key> {
        self.entries.iter().map(Entry::key).collect()
    }
}

impl Entry<'_> {
    fn key(&self) -> Key {
        let name = match self.item.name.as_str() {
            "" => String::new(),
            name => format!("{}/{name}", self.group.name),
        };
        Key { name, position: self.position() }
    }

    fn position(&self) -> String {
        self.item.bindings.first().map(address::number).unwrap_or_default()
    }

    /// Returns the address and name of an item, for reports.
    fn title(&self) -> String {
        let name = match entry_name(self.item, self.group) {
            name if name.is_empty() => self.group.name.to_string(),
            name => name,
        };
        format!("{} {name}", self.position()).trim().to_owned()
    }
}

/// Returns the second key that pairs groups: the index of an object or record, or the kind of any other group.
fn position(group: &Group) -> String {
    match &group.kind {
        GroupKind::Object { index, .. } => hex16(*index),
        GroupKind::Chapter => "chapter".to_owned(),
        GroupKind::Record(record) => format!("record {}", hex16(record.index)),
        GroupKind::Image { .. } => "image".to_owned(),
    }
}

fn title(group: &Group) -> String {
    format!("{} {}", position(group), group.name).trim().to_owned()
}

/// Compares two items. Even if their names are equal, their Rust identifiers can differ because of the names of other
/// items.
fn pair(old: &Entry<'_>, new: &Entry<'_>, comparison: &mut Comparison<'_>) {
    let name = |one: &CompactString, other: &CompactString, comparison: &mut Comparison<'_>| {
        // An object without entries and its value have the same name, so the comparison of the object already reports a
        // changed name.
        let is_of_group = old.identifier.is_empty() && (one, other) == (&old.group.name, &new.group.name);
        if !is_of_group {
            names([one, other], [&old.identifier, &new.identifier], comparison);
        }
    };
    comparison.within(&new.title(), |comparison| item::compare_named(old.item, new.item, name, comparison));
}

/// Compares names and the Rust identifiers that are created from them.
fn names(names: [&CompactString; 2], identifiers: [&str; 2], comparison: &mut Comparison<'_>) {
    let [old, new] = names.map(CompactString::to_string);
    let [old_identifier, new_identifier] = identifiers.map(str::to_owned);
    let judgment = if old_identifier == new_identifier { Judgment::NONE } else { Judgment::API };
    if old != new {
        comparison.push("name", old, new, judgment);
    } else {
        comparison.texts("identifier", old_identifier, new_identifier, judgment);
    }
}

rules!(fn tool_flags(ToolFlags) {
    attribute: fact("attribute for tools", Judgment::NONE),
    transition: fact("state transition of the write access", Judgment::BEHAVIOR),
    sdo_access: fact("SDO access", Judgment::BEHAVIOR),
    overwritten_by_module: fact("replaced by a module", Judgment::WIRE),
});

/// Compares the facts of a group. The items of the group are compared separately.
fn facts(old: &Group, new: &Group, identifiers: [&str; 2], comparison: &mut Comparison<'_>) {
    compare_fields!(Group, old, new, comparison, {
        name: |one: &CompactString, other: &CompactString, comparison: &mut Comparison<'_>| {
            names([one, other], identifiers, comparison);
        },
        names,
        kind: |_: &GroupKind, _: &GroupKind, comparison: &mut Comparison<'_>| kind(old, new, comparison),
        links: fact_as("linked objects", Judgment::NONE, |links: &Vec<u16>| indices(links)),
        flags: fact_as("flags of the object", Judgment::BEHAVIOR, |flags| hex(*flags)),
        depends_on_slot: fact("index grows with the slot", Judgment::WIRE),
        depends_on_slot_group: fact("index grows with the slot group", Judgment::WIRE),
        tool_flags: or_default(tool_flags),
        described: fact("number of described entries", Judgment::NONE),
        documentation, doubts, extensions, origins,
    }, COMPARED => [items], POSITION => [origin, name_at]);
}

fn kind(old: &Group, new: &Group, comparison: &mut Comparison<'_>) {
    match (&old.kind, &new.kind) {
        (
            GroupKind::Object { index: one, code: old_code, category: old_category },
            GroupKind::Object { index: other, code, category },
        ) => {
            // If all items have the index of their object, the comparison of the items' addresses reports the changed index.
            if !(has_index_of_items(old) && has_index_of_items(new)) {
                fact_as("index", Judgment::WIRE, index)(one, other, comparison);
            }
            // In Rust, an object with entries becomes a type, and an object without entries becomes a constant.
            let judgment = if old.has_entries() == new.has_entries() { Judgment::NONE } else { Judgment::API };
            fact("object code", judgment)(old_code, code, comparison);
            fact("category", Judgment::NONE)(old_category, category, comparison);
        }
        (GroupKind::Record(old), GroupKind::Record(new)) => record(old, new, comparison),
        (GroupKind::Image { length: old }, GroupKind::Image { length: new }) => {
            fact("length in bytes", Judgment::WIRE)(old, new, comparison);
        }
        _ => comparison.texts("kind", position(old), position(new), Judgment::API_AND_WIRE),
    }
}

/// Returns whether an object has items and all of them have its index.
fn has_index_of_items(group: &Group) -> bool {
    let is_at_index = |item: &Item| item.object().map(|(index, _)| index) == group.index();
    !group.items.is_empty() && group.items.iter().all(is_at_index)
}

rules!(fn record(Record) {
    index: fact_as("index", Judgment::WIRE, index),
    length: fact("length in bytes", Judgment::API_AND_WIRE),
    transfer_sequence: fact("order of transfer", Judgment::WIRE),
    changeable_with_bump: fact("a change disturbs operation", Judgment::BEHAVIOR),
    constants: each("fixed bytes", Judgment::WIRE, |(offset, constant): &(u32, Vec<u8>)| {
        format!("{offset}: {}", bytes(constant))
    }),
});
