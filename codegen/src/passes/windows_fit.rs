//! After this pass the windows of a register table were held against the values that go through them, and against the procedures
//! that use them.

use std::collections::HashSet;

use super::owner::{Index, Owner};
use crate::diagnostics::{codes, Diagnostic, Diagnostics};
use crate::ir::{Binding, CompactString, Device, IndirectBinding, Item, Procedure, Step, WindowSide};
use crate::text::brief;

pub(super) fn run(device: &Device, diagnostics: &mut Diagnostics) {
    let groups = [device.groups.as_slice()];
    let owner = Owner { types: &device.types, groups: &groups };
    if !owner.items().any(|item| windows(item).next().is_some()) {
        return;
    }
    let index = Index::new(owner);
    let (mut narrow, mut seen) = (HashSet::new(), HashSet::new());
    for item in owner.items() {
        width(owner, &index, item, &mut narrow, diagnostics);
        for side in windows(item).filter_map(|window| window.write.as_ref()) {
            let procedure = device.procedures.iter().find(|own| Some(&own.name) == side.procedure.as_ref());
            if let Some(procedure) = procedure.filter(|own| seen.insert(&own.name)) {
                order(&index, side, procedure, diagnostics);
            }
        }
    }
}

fn windows(item: &Item) -> impl Iterator<Item = &IndirectBinding> {
    item.bindings.iter().filter_map(|binding| match binding {
        Binding::Indirect(window) => Some(&**window),
        _ => None,
    })
}

/// An item with more bits than any of its windows has. One finding for each window stands for all its items.
fn width<'d>(
    owner: Owner<'d>,
    index: &Index<'d>,
    item: &'d Item,
    told: &mut HashSet<&'d CompactString>,
    diagnostics: &mut Diagnostics,
) {
    let bits_of = |item: &Item| owner.basic(item.ty).bits();
    let Some(bits) = bits_of(item) else { return };
    let read = windows(item).filter_map(|window| Some(&window.read.as_ref()?.value));
    let written = windows(item).filter_map(|window| Some(&window.write.as_ref()?.value));
    let values: [(_, Vec<&CompactString>); 2] = [("read", read.collect()), ("written", written.collect())];
    for (verb, names) in values {
        let widths = names.into_iter().filter_map(|name| Some((bits_of(index.find(name)?)?, name)));
        let Some((own, name)) = widths.max_by_key(|(own, _)| *own) else { continue };
        if own < bits && told.insert(name) {
            let (item_name, through) = (brief(&item.name), brief(name));
            let message = format!("`{item_name}` has {bits} bits, and is {verb} through `{through}`, which has {own}");
            let found = Diagnostic::new(&codes::NARROW_WINDOW, item.at.name, message);
            diagnostics.push(found.label("the first that doesn't fit"));
        }
    }
}

/// A procedure that writes the number, and the value after it.
fn order(index: &Index<'_>, side: &WindowSide, procedure: &Procedure, diagnostics: &mut Diagnostics) {
    let (number_item, value) = (&side.number, &side.value);
    let is_cyclic = |item: &Item| item.bindings.iter().any(|binding| matches!(binding, Binding::Image { .. }));
    if index.find(value).is_some_and(is_cyclic) {
        return;
    }
    let writes = |step: &Step, wanted: &CompactString| match step {
        Step::Write(item, _) | Step::WriteBits(item, ..) | Step::WriteArgument(item, _) => item == wanted,
        _ => false,
    };
    let number = procedure.steps.iter().position(|step| writes(step, number_item));
    let behind = procedure.steps.iter().rposition(|step| writes(step, value));
    let Some((at, _)) = behind.zip(number).filter(|(behind, number)| number < behind) else { return };
    let (name, address, value) = (brief(&procedure.name), brief(number_item), brief(value));
    let message = format!("`{name}` writes the number to `{address}` before the value to `{value}`");
    let span = procedure.step_spans.get(at).copied().unwrap_or(procedure.origin.span);
    diagnostics.push(Diagnostic::new(&codes::WINDOW_ORDER, span, message).help("write the value first"));
}
