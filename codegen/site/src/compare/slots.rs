//! Slots and subslots, and what can be plugged into them.

use super::change::Judgement;
use super::comparison::{fact, slices, Comparison, Elements};
use lexibus_codegen::ir::Places;

/// What can be plugged into a device or module.
pub(super) struct Use {
    pub title: String,
    /// By what it is paired.
    pub key: String,
    pub places: Places,
}

/// Compares what can be plugged in, and into which slots or subslots.
pub(super) fn places(old: &[Use], new: &[Use], comparison: &mut Comparison<'_>) {
    let elements = Elements {
        name: |plugged: &Use| plugged.key.clone(),
        ..Elements::titled(|plugged: &Use| plugged.title.clone())
    }
    .judged(|_| Judgement::BEHAVIOR_COMPATIBLE, |_| Judgement::BEHAVIOR);
    let compare = |old: &Use, new: &Use, comparison: &mut Comparison<'_>| {
        fact("slots", Judgement::BEHAVIOR)(&old.places, &new.places, comparison);
    };
    slices(old, new, &elements, compare, comparison);
}
