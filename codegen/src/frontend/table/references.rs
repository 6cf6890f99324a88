//! Names that refer to other elements of the table, such as items, models, messages and states.

use std::cell::OnceCell;

use super::at::At;
use super::notation;
use super::numbered::{self, Numbered};
use super::tree::Reader;
use crate::collections::{HashMap, HashSet};
use crate::diagnostics::codes;
use crate::ir::{Device, Entries, GroupKind, ItemNames, Shape};
use crate::text::brief;
use crate::text::glob;

/// Names with their spans, and the kinds of elements to which they refer, such as `item`, `model` or `message`.
pub(super) type References = Vec<(At<String>, &'static str)>;

/// Kind of element to which most names refer.
pub(super) const ITEM: &str = "item";

/// Kinds of elements that may indicate the completion of a command: items, and fields of replies.
pub(super) const ITEM_OR_FIELD: &str = "item or field";

/// Reports names without a definition, and item names that occur in several chapters.
pub(super) fn resolve(reader: &mut Reader<'_, '_>, references: &References, device: &Device, numbered: &[Numbered]) {
    let known = Known::new(device);
    let mut seen = HashSet::default();
    for &(ref name, kind) in references {
        // The names in a unit or space occur again for each row that uses the unit or space, but are checked only once.
        if !seen.insert((name.start, name.value.as_str(), kind)) {
            continue;
        }
        let text = name.value.as_str();
        if !known.has(kind, text) {
            if matches!(kind, ITEM | ITEM_OR_FIELD) && numbered::report(reader, numbered, text, reader.span(name)) {
                continue;
            }
            let names = if reader.helps() { known.names(kind) } else { Vec::new() };
            reader.unresolved(kind, text, reader.span(name), names.into_iter());
        } else if kind == ITEM {
            ambiguous(reader, &known, name);
        }
    }
}

fn ambiguous(reader: &mut Reader<'_, '_>, known: &Known<'_>, name: &At<String>) {
    let Some([first, second, ..]) = known.chapters.get(name.value.as_str()).map(Vec::as_slice) else { return };
    let text = brief(&name.value);
    let message = format!("several chapters have an item `{text}`, such as `{}` and `{}`", brief(first), brief(second));
    let found = codes::UNRESOLVED_NAME.at(reader.span(name), message);
    reader.diagnostics.push(found.help(format!("write `\"{}/{text}\"`", brief(first))));
}

struct Known<'d> {
    device: &'d Device,
    entries: Entries<'d>,
    names: ItemNames<'d>,
    items: HashSet<&'d str>,
    /// Titles of the chapters that contain an item, by the item's name.
    chapters: HashMap<&'d str, Vec<&'d str>>,
    /// Names of the elements of each kind in `KINDS`, collected at the first lookup.
    others: [OnceCell<HashSet<&'d str>>; KINDS.len()],
}

/// Kinds of elements that have their own namespace, except models, whose references can be glob patterns.
const KINDS: [&str; 5] = ["constant", "given number", "message", "procedure", "state"];

impl<'d> Known<'d> {
    fn new(device: &'d Device) -> Self {
        let all = device.groups.iter().flat_map(|group| &group.items).map(|item| item.name.as_str());
        let groups = device.groups.iter().map(|group| group.name.as_str());
        let mut chapters: HashMap<&str, Vec<&str>> = HashMap::default();
        for group in device.groups.iter().filter(|group| group.kind == GroupKind::Chapter) {
            for item in &group.items {
                chapters.entry(&item.name).or_default().push(&group.name);
            }
        }
        let entries = Entries::new(&device.groups);
        let names = ItemNames::new(&device.groups);
        Known { device, entries, names, items: all.chain(groups).collect(), chapters, others: Default::default() }
    }

    fn has(&self, kind: &str, text: &str) -> bool {
        let device = self.device;
        match kind {
            "model" => device.variants.is_empty() || device.variants.iter().any(|model| glob(text, &model.name)),
            _ if KINDS.contains(&kind) => {
                let names = KINDS.iter().position(|known| *known == kind).and_then(|at| self.others.get(at));
                names.is_some_and(|names| names.get_or_init(|| self.names(kind).into_iter().collect()).contains(text))
            }
            _ => self.items.contains(text) || self.is_object(text) || self.names.by_path(text).is_some(),
        }
    }

    fn is_object(&self, name: &str) -> bool {
        let found = notation::objects(name).filter(|objects| objects.indices.0 == objects.indices.1);
        found.is_some_and(|objects| {
            self.entries.get(objects.indices.0, objects.subs.map_or(0, |(first, _)| first)).is_some()
        })
    }

    fn names(&self, kind: &str) -> Vec<&'d str> {
        let device = self.device;
        match kind {
            "model" => device.variants.iter().map(|model| model.name.as_str()).collect(),
            "constant" => {
                device.variants.iter().flat_map(|model| &model.constants).map(|(name, _)| name.as_str()).collect()
            }
            "given number" => device.given.iter().map(|number| number.name.as_str()).collect(),
            "message" => device.messages.iter().map(|message| message.name.as_str()).collect(),
            "procedure" => device.procedures.iter().map(|procedure| procedure.name.as_str()).collect(),
            "state" => states(device).collect(),
            _ => device.groups.iter().flat_map(|group| &group.items).map(|item| item.name.as_str()).collect(),
        }
    }
}

/// Returns the states of a device: those of its state machines, and the values of its enumerations, which may report a state.
fn states(device: &Device) -> impl Iterator<Item = &str> {
    let machines = device.machines.iter().flat_map(|machine| machine.states.iter().map(|state| state.name.as_str()));
    let values = device.types.iter().flat_map(|definition| match &definition.shape {
        Shape::Enumeration { values, .. } => values.as_slice(),
        _ => &[],
    });
    machines.chain(values.map(|value| value.name.as_str()))
}
