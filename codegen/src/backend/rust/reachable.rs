//! What a client can reach of a device or a module: objects that have values, and registers.

use super::place::Place;
use super::scope::Scope;
use crate::ir::{Group, GroupKind, Item, ObjectCode};

/// Objects that have values to read or write; the definitions of types have none.
pub(super) fn addressable<'a>(scope: &Scope<'a>) -> impl Iterator<Item = &'a Group> + use<'a> {
    scope.groups.iter().filter(|group| {
        let is_type =
            matches!(group.object_code(), Some(ObjectCode::DefType | ObjectCode::DefStruct | ObjectCode::Null));
        group.index().is_some() && !is_type && !group.items.is_empty()
    })
}

/// The items of chapters and images that a client can reach, with the titles of those: `Scope::registers`.
pub(super) fn registers<'a>(scope: &Scope<'a>) -> Vec<(&'a str, &'a Item)> {
    let is_chapter = |group: &&Group| matches!(group.kind, GroupKind::Chapter | GroupKind::Image { .. });
    let chapters = scope.groups.iter().filter(is_chapter);
    // An image is told with the place of its fields.
    let title = |group: &'a Group| if group.kind == GroupKind::Chapter { group.name.as_str() } else { "" };
    let items = chapters.flat_map(|group| group.items.iter().map(move |item| (title(group), item)));
    items.filter(|(_, item)| !Place::of(scope, item).buses().is_empty()).collect()
}

/// Whether an object is a module of several values, and not one value.
pub(super) fn is_module(group: &Group) -> bool {
    group.object_code().is_some_and(ObjectCode::has_subs) || group.items.len() != 1
}

/// What the handles are of, and what one of them is of at the start of a sentence and within it.
pub(super) fn handles(scope: &Scope<'_>) -> [&'static str; 3] {
    let has_objects = addressable(scope).next().is_some();
    match (scope.registers.is_empty(), has_objects) {
        (true, _) => ["entry of the object dictionary", "An entry", "an entry"],
        (false, true) => {
            ["register and every entry of the object dictionary", "A register or an entry", "a register or an entry"]
        }
        (false, false) => ["register", "A register", "a register"],
    }
}
