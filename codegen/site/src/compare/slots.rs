//! Compares slots and subslots, and the modules and submodules that fit into them.

use super::change::Judgment;
use super::comparison::{fact, slices, Comparison, Elements};
use lexibus_codegen::ir::SlotNumbers;

/// A module or submodule that fits a slot or subslot.
pub(super) struct Use {
    pub title: String,
    /// Key that pairs old and new modules or submodules.
    pub key: String,
    pub slots: SlotNumbers,
}

/// Compares the modules or submodules that fit, and the slots or subslots into which they fit.
pub(super) fn compare_slots(old: &[Use], new: &[Use], comparison: &mut Comparison<'_>) {
    let elements = Elements {
        name: |plugged: &Use| plugged.key.clone(),
        ..Elements::titled(|plugged: &Use| plugged.title.clone())
    }
    .judged(|_| Judgment::BEHAVIOR_COMPATIBLE, |_| Judgment::BEHAVIOR);
    let compare = |old: &Use, new: &Use, comparison: &mut Comparison<'_>| {
        fact("slots", Judgment::BEHAVIOR)(&old.slots, &new.slots, comparison);
    };
    slices(old, new, &elements, compare, comparison);
}
