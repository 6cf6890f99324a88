//! Compares slots and subslots, and the modules and submodules that fit into them.

use super::change::Judgment;
use super::comparison::{fact, slices, Comparison, Elements};
use lexibus_codegen::ir::{Catalog, SlotNumbers};

/// A module or submodule that fits a slot or subslot.
pub(super) struct Use {
    title: String,
    /// Key that pairs old and new modules or submodules.
    key: String,
    slots: SlotNumbers,
}

impl Use {
    /// Creates the use of the module or submodule with this number. `found` contains its name and its key.
    pub fn new(kind: &str, number: u32, found: Option<(&str, String)>, slots: &SlotNumbers) -> Self {
        let (title, key) = match found {
            Some((name, key)) => (format!("{kind} {name} ({key})"), key),
            None => (format!("{kind} number {number}"), number.to_string()),
        };
        Use { title, key, slots: slots.clone() }
    }
}

/// Compares the modules or submodules that fit, and the slots or subslots into which they fit.
pub(super) fn compare_uses<U>(
    old: &[U],
    new: &[U],
    used: impl Fn(&Catalog, &U) -> Use,
    comparison: &mut Comparison<'_>,
) {
    let elements = Elements {
        name: |plugged: &Use| plugged.key.clone(),
        ..Elements::titled(|plugged: &Use| plugged.title.clone())
    }
    .judged(Judgment::BEHAVIOR_COMPATIBLE, Judgment::BEHAVIOR);
    let compare = |old: &Use, new: &Use, comparison: &mut Comparison<'_>| {
        fact("slots", Judgment::BEHAVIOR)(&old.slots, &new.slots, comparison);
    };
    let uses = |catalog: &Catalog, list: &[U]| list.iter().map(|one| used(catalog, one)).collect::<Vec<_>>();
    let (old_catalog, new_catalog) = comparison.catalogs;
    slices(&uses(old_catalog, old), &uses(new_catalog, new), &elements, compare, comparison);
}
