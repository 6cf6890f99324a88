//! Compares the restrictions of an element: conditions, models, firmware versions, options and buses.

use std::fmt::Debug;

use super::change::Judgment;
use super::comparison::{fact, judged, rules, text, Comparison};
use super::show::Show;
use lexibus_codegen::ir::{Availability, Bus, Buses, Condition};

/// Returns a rule that compares the values to which an element is restricted. An empty list means no restriction.
pub(super) fn restricted<T: PartialEq + Debug + Show>(
    name: &'static str,
) -> impl Fn(&Vec<T>, &Vec<T>, &mut Comparison<'_>) {
    judged(name, |old: &Vec<T>, new: &Vec<T>| {
        let is_narrower = !new.is_empty() && (old.is_empty() || old.iter().any(|value| !new.contains(value)));
        if is_narrower {
            Judgment::BEHAVIOR
        } else {
            Judgment::BEHAVIOR_COMPATIBLE
        }
    })
}

/// Returns a rule that compares lists of conditions. All conditions of a list must be true.
pub(super) fn conditions(name: &'static str) -> impl Fn(&Vec<Condition>, &Vec<Condition>, &mut Comparison<'_>) {
    move |old, new, comparison| {
        let text = |list: &[Condition]| list.iter().map(Condition::show).collect::<Vec<_>>().join(" and ");
        if old != new {
            let is_weaker = new.iter().all(|condition| old.contains(condition));
            let judgment = if is_weaker { Judgment::BEHAVIOR_COMPATIBLE } else { Judgment::BEHAVIOR };
            comparison.values(name, [old, new], [text(old), text(new)], judgment);
        }
    }
}

/// Compares the buses to which an element is restricted.
pub(super) fn only_on(old: &Buses, new: &Buses, comparison: &mut Comparison<'_>) {
    restricted("only on")(&Vec::<Bus>::from(*old), &Vec::from(*new), comparison);
}

// Compares the models, firmware versions, options and buses to which an element is restricted.
rules!(pub(super) fn availability(Availability) {
    models: restricted("models"),
    since: fact("since firmware", Judgment::BEHAVIOR),
    until: fact("until firmware", Judgment::BEHAVIOR),
    replaced_by: text("replaced by"),
    options: fact("needs", Judgment::BEHAVIOR),
    buses: only_on,
});
