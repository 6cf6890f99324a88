//! The types of handles: short names, one for each access, and private names of those that there are.

use std::collections::BTreeMap;

use super::code::Doc;
use super::item::ItemModel;
use super::objects::ObjectModel;

/// A short name of the handles with one access.
#[derive(Clone, Copy)]
pub(super) struct Alias {
    pub name: &'static str,
    pub marker: &'static str,
    pub text: &'static str,
}

const ALIASES: [Alias; 4] = [
    Alias { name: "ReadOnly", marker: "rt::Ro", text: "that can be read" },
    Alias { name: "WriteOnly", marker: "rt::Wo", text: "that can be written" },
    Alias { name: "ReadWrite", marker: "rt::Rw", text: "that can be read and written" },
    Alias { name: "Constant", marker: "rt::Const", text: "that can be read and never changes" },
];

/// The short names that there is a handle for.
pub(super) fn aliases(objects: &[ObjectModel]) -> Vec<Alias> {
    let items = || objects.iter().flat_map(|object| &object.items);
    ALIASES.into_iter().filter(|alias| items().any(|item| item.access == alias.name)).collect()
}

/// Each type of a handle once, sorted by name.
pub(super) fn types<'o>(objects: impl IntoIterator<Item = &'o ObjectModel>) -> Vec<(String, &'static str, Vec<Doc>)> {
    let all = objects.into_iter().flat_map(|object| &object.items);
    let names: BTreeMap<&str, &ItemModel> = all.map(|item| (item.alias.as_str(), item)).collect();
    names.into_iter().map(|(name, item)| (name.to_owned(), item.access, item.arguments_beside.clone())).collect()
}
