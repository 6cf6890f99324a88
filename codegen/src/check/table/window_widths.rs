//! Checks that windows are wide enough for the values, and that procedures write the value before the number.

use std::collections::BTreeMap;

use super::windows::{behind, windows};
use crate::check::context::Context;
use crate::collections::HashSet;
use crate::diagnostics::{codes, Diagnostics};
use crate::ir::owner::Owner;
use crate::ir::{stated, Binding, Bus, CompactString, Item, Procedure, Step, WindowSide};
use crate::text::brief;

pub(crate) fn check(context: &Context<'_>, diagnostics: &mut Diagnostics) {
    let (mut narrow, mut seen) = (HashSet::default(), HashSet::default());
    for item in behind(context) {
        width(context, item, &mut narrow, diagnostics);
        for side in windows(item).filter_map(|window| window.write.as_ref()).filter(|side| seen.insert(*side)) {
            let procedure = side.procedure.as_ref().and_then(|procedure| context.device.procedure(procedure));
            order(context, side, procedure, item, diagnostics);
        }
    }
}

/// Reports items with more bits than their widest window on a bus. For each value item of a window, only the first item
/// that does not fit is reported.
fn width<'d>(
    context: &Context<'d>,
    item: &'d Item,
    reported: &mut HashSet<&'d CompactString>,
    diagnostics: &mut Diagnostics,
) {
    let bits_of = |item: &Item| context.owner.basic(item.ty).bits();
    let Some(bits) = bits_of(item).map(|bits| bits.min(needed(context.owner, item))) else { return };
    // The item is compared with the widest window on each bus.
    let mut widest: BTreeMap<(&str, Bus), (u32, &CompactString)> = BTreeMap::new();
    for window in windows(item) {
        let sides = [("read", &window.read), ("written", &window.write)];
        for (verb, side) in sides.into_iter().filter_map(|(verb, side)| Some((verb, side.as_ref()?))) {
            let Some(bits) = context.device.referred(&side.value).and_then(bits_of) else { continue };
            for bus in window.buses.iter() {
                let entry = widest.entry((verb, bus)).or_insert((bits, &side.value));
                *entry = if bits > entry.0 { (bits, &side.value) } else { *entry };
            }
        }
    }
    for ((verb, _), (width, name)) in widest {
        if width < bits && reported.insert(name) {
            let (item_name, through) = (brief(&item.name), brief(name));
            let message =
                format!("`{item_name}` has {bits} bits, but is {verb} through `{through}`, which has {width}");
            diagnostics.push(codes::NARROW_WINDOW.at(item.at.name, message).label("the first item that does not fit"));
        }
    }
}

/// Reports a window (or its procedure) that writes the number before the value, if the device clears the number after
/// the transfer. Such a device starts the transfer when it receives the number. In a process image, the number and the
/// value are sent together, so their order is not checked.
fn order(
    context: &Context<'_>,
    side: &WindowSide,
    procedure: Option<&Procedure>,
    item: &Item,
    diagnostics: &mut Diagnostics,
) {
    let number = context.device.referred(&side.number);
    let is_cyclic = |item: &Item| item.bindings.iter().any(|binding| matches!(binding, Binding::Image(_)));
    let by_row = number.and_then(stated::behavior).is_some_and(|behavior| behavior.self_clearing);
    if context.device.referred(&side.value).is_some_and(is_cyclic) || !(by_row || side.clears == Some(true)) {
        return;
    }
    let (address, value) = (brief(&side.number), brief(&side.value));
    let begins = "writing the register number starts the transfer";
    if side.number_first == Some(true) {
        let message =
            format!("the register number is written to `{address}` before the value to `{value}`, but {begins}");
        let found = codes::WINDOW_ORDER.at(number.unwrap_or(item).at.name, message);
        let help = "write `first = \"value\"`, or delete `clears` if the device does not clear the register number";
        diagnostics.push(found.help(help));
    }
    let Some(procedure) = procedure else { return };
    let writes = |step: &Step, wanted: &CompactString| match step {
        Step::Write(item, _) | Step::WriteBits(item, ..) | Step::WriteArgument(item, _) => item == wanted,
        _ => false,
    };
    let first = procedure.steps.iter().position(|step| writes(step, &side.number));
    let last_value = procedure.steps.iter().rposition(|step| writes(step, &side.value));
    let Some((at, _)) = last_value.zip(first).filter(|(last_value, first)| first < last_value) else { return };
    let name = brief(&procedure.name);
    let message = format!(
        "the procedure `{name}` writes the register number to `{address}` before the value to `{value}`, but {begins}"
    );
    let span = procedure.step_spans.get(at).copied().unwrap_or(procedure.origin.span);
    diagnostics.push(codes::WINDOW_ORDER.at(span, message).help("write the value before the register number"));
}

/// Returns the number of bits that the maximum needs, or `u32::MAX` if the maximum is unknown or values can be negative.
fn needed(owner: Owner<'_>, item: &Item) -> u32 {
    let (low, high) = item.limits.integers();
    match (low.or_else(|| Some(owner.basic(item.ty).integer_range()?.0)), high) {
        (Some(0..), Some(high @ 0..)) => i128::BITS - high.leading_zeros(),
        _ => u32::MAX,
    }
}
