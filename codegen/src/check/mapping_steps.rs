//! PDO mappings that procedures write: the mapped items, and the number of entries.

use std::collections::{BTreeMap, BTreeSet};

use super::context::Context;
use super::mapped_object::{direction_of, Described, Mapped, CAN_BITS};
use crate::diagnostics::{codes, Diagnostics};
use crate::ir::{Item, Procedure, Step};
use crate::number::hex16;
use crate::source::Span;
use crate::text::brief;

pub(super) fn check(context: &Context<'_>, diagnostics: &mut Diagnostics) {
    let device = context.device;
    let described = Described::new(device);
    for procedure in &device.procedures {
        let mut mapping =
            Mapping { described: &described, procedure, words: BTreeMap::new(), cleared: BTreeSet::new() };
        for (step, span) in procedure.spanned() {
            let Step::Write(name, value) = step else { continue };
            let (object, value) = (device.referred(name).and_then(Item::object), value.as_int());
            if let (Some(object), Some(value)) = (object, value) {
                mapping.step(object, value, span, diagnostics);
            }
        }
    }
}

/// The mappings that a procedure has written up to a step.
struct Mapping<'a> {
    described: &'a Described<'a>,
    procedure: &'a Procedure,
    /// Mapping values by index and sub-index.
    words: BTreeMap<u16, BTreeMap<u8, i128>>,
    /// Mappings whose number of entries is 0 at this step.
    cleared: BTreeSet<u16>,
}

impl Mapping<'_> {
    fn step(&mut self, object: (u16, u8), value: i128, span: Span, diagnostics: &mut Diagnostics) {
        let (index, sub) = object;
        let Some(direction) = direction_of(index) else { return };
        let name = brief(&self.procedure.name);
        if sub > 0 {
            let before = self.words.entry(index).or_default().insert(sub, value);
            if before.is_some() && self.cleared.contains(&index) {
                let message = format!("the procedure `{name}` writes entry {sub} of {} twice", hex16(index));
                let found = codes::STEP_IMPOSSIBLE.at(span, message);
                diagnostics.push(found.help(format!("write the next entry to sub-index {}", sub.saturating_add(1))));
            }
            if let Some(mapped) = Mapped::word(value, direction, span) {
                mapped.check(self.described, false, diagnostics);
            }
            return;
        }
        if let Some(problem) = self.count(index, value) {
            let mapping = hex16(index);
            let message =
                format!("the procedure `{name}` writes {value} as the number of entries of {mapping}, but {problem}");
            diagnostics.push(codes::STEP_IMPOSSIBLE.at(span, message));
        }
        let bits = self.bits(index, value);
        if self.described.device.ethercat.is_none() && bits > i128::from(CAN_BITS) {
            let message = format!(
                "the mapping {} has {bits} bits after this step, but a CAN frame carries at most 64 data bits",
                hex16(index)
            );
            diagnostics.push(codes::PDO_TOO_LONG.at(span, message));
        }
    }

    /// Returns the problem with the number of mapped objects in sub-index 0, or `None` if there is none. This number may exceed
    /// neither the number of sub-indices, nor the number of entries that were written since sub-index 0 was set to 0.
    fn count(&mut self, index: u16, value: i128) -> Option<String> {
        if value == 0 {
            self.cleared.insert(index);
            self.words.remove(&index);
            return None;
        }
        let entries = self.described.device.object(index).map_or(0, |group| group.items.len().saturating_sub(1));
        let was_cleared = self.cleared.remove(&index);
        if entries > 0 && value > entries as i128 {
            return Some(format!("the object has only {entries}"));
        }
        let written = self.words.get(&index).map_or(0, BTreeMap::len);
        (was_cleared && value > written as i128).then(|| format!("has written only {written} of these entries"))
    }

    /// Returns the length of the first `count` entries in bits. Entries that were not written have their default values.
    fn bits(&self, index: u16, count: i128) -> i128 {
        let by_default = |sub| self.described.entries.get(index, sub)?.default_integer();
        let written = |sub| self.words.get(&index)?.get(&sub).copied();
        let word = |sub| written(sub).or_else(|| by_default(sub)).unwrap_or(0);
        let last = u8::try_from(count.clamp(0, 64)).unwrap_or(0);
        (1..=last).map(|sub| word(sub) & 0xFF).sum()
    }
}
