//! Determines the Rust identifiers of elements.

use lexibus_codegen::facts::address;
use lexibus_codegen::ir::{Group, GroupKind, Item};
use lexibus_codegen::names::{self, unique, Case, NameRequest};

/// Returns the Rust identifier of an element whose name is unique.
pub(super) fn identifier(name: &str) -> String {
    names::identifier(&NameRequest::new(name, "item", ""), Case::Snake)
}

/// The Rust identifiers of the groups and items of a device or module.
pub(super) struct Identifiers {
    /// Identifier of each group; empty if the group is not an object.
    pub groups: Vec<String>,
    /// Identifiers of registers and object entries, by group; empty for the value of an object without entries.
    pub items: Vec<Vec<String>>,
}

impl Identifiers {
    /// Returns the identifiers for these groups. An identifier is created from the name; if several elements have the
    /// same name, also from the address.
    pub fn of(groups: &[Group]) -> Self {
        let mut names = unique(groups.iter().flat_map(name_requests), &[], Case::Snake).into_iter();
        let mut identifiers = Identifiers { groups: Vec::new(), items: Vec::new() };
        for group in groups {
            let (name, items) = match group.index() {
                Some(_) => (names.next().unwrap_or_default(), entries(group)),
                None => (String::new(), names.by_ref().take(group.items.len()).collect()),
            };
            identifiers.groups.push(name);
            identifiers.items.push(items);
        }
        identifiers
    }
}

/// Returns the names for which a group needs identifiers: one for an object, and one for each item of any other group.
fn name_requests(group: &Group) -> Vec<NameRequest<'_>> {
    match group.kind {
        GroupKind::Object { index, .. } => vec![NameRequest::new(&group.name, "object", format!("{index:04X}"))],
        _ => group.items.iter().map(|item| NameRequest::new(&item.name, "register", suffix(item))).collect(),
    }
}

fn entries(group: &Group) -> Vec<String> {
    if !group.has_entries() {
        return vec![String::new(); group.items.len()];
    }
    let sub_index = |item: &Item| item.object().map_or(0, |(_, sub_index)| sub_index);
    let name_requests = group.items.iter().map(|item| NameRequest::new(&item.name, "sub", sub_index(item)));
    unique(name_requests, &[], Case::Snake)
}

fn suffix(item: &Item) -> String {
    item.bindings.first().map(address::number).unwrap_or_default()
}
