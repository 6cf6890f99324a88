//! Types of handles: a public short name for the handles with the same access rights, and private aliases of all types
//! in use.

use std::collections::BTreeMap;

use super::code::Doc;
use super::item::ItemModel;
use super::objects::ObjectModel;

/// The short name of handles with the same access rights.
#[derive(Clone, Copy)]
pub(super) struct Alias {
    pub name: &'static str,
    pub marker: &'static str,
    pub text: &'static str,
}

const ALIASES: [Alias; 4] = [
    Alias { name: "ReadOnly", marker: "rt::Ro", text: "read-only" },
    Alias { name: "WriteOnly", marker: "rt::Wo", text: "write-only" },
    Alias { name: "ReadWrite", marker: "rt::Rw", text: "read-write" },
    Alias { name: "Constant", marker: "rt::Const", text: "constant" },
];

/// Returns the short names that at least one handle uses.
pub(super) fn aliases(objects: &[ObjectModel]) -> Vec<Alias> {
    let items = || objects.iter().flat_map(|object| &object.items);
    ALIASES.into_iter().filter(|alias| items().any(|item| item.access == alias.name)).collect()
}

/// Returns the private aliases of all handle types (name, access and arguments) without repetitions, sorted by name.
pub(super) fn types<'o>(objects: impl IntoIterator<Item = &'o ObjectModel>) -> Vec<(String, &'static str, Vec<Doc>)> {
    let all = objects.into_iter().flat_map(|object| &object.items);
    let names: BTreeMap<&str, &ItemModel> = all.map(|item| (item.alias.as_str(), item)).collect();
    names.into_iter().map(|(name, item)| (name.to_owned(), item.access, item.arguments.clone())).collect()
}
