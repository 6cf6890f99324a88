//! Slots and subslots with their modules and submodules.

use super::change::Judgement;
use super::comparison::{fact, slices, Comparison, Elements};
use lexibus_codegen::ir::SlotNumbers;

/// A module or submodule that fits into a device or module.
pub(super) struct Use {
    pub title: String,
    /// Key that pairs uses.
    pub key: String,
    pub slots: SlotNumbers,
}

/// Compares the pluggable modules or submodules and their slots or subslots.
pub(super) fn compare_slots(old: &[Use], new: &[Use], comparison: &mut Comparison<'_>) {
    let elements = Elements {
        name: |plugged: &Use| plugged.key.clone(),
        ..Elements::titled(|plugged: &Use| plugged.title.clone())
    }
    .judged(|_| Judgement::BEHAVIOR_COMPATIBLE, |_| Judgement::BEHAVIOR);
    let compare = |old: &Use, new: &Use, comparison: &mut Comparison<'_>| {
        fact("slots", Judgement::BEHAVIOR)(&old.slots, &new.slots, comparison);
    };
    slices(old, new, &elements, compare, comparison);
}
