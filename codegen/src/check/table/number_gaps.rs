//! Reports parameter numbers that are missing between the numbers of other parameters.

use crate::check::context::Context;
use crate::diagnostics::{codes, Diagnostics};
use crate::ir::{Binding, Group, GroupKind, Item};
use crate::number::hex16;
use crate::text::brief;

/// The minimum number of parameters with consecutive numbers on each side of a reported gap.
const ROW: usize = 2;

pub(crate) fn check(context: &Context<'_>, diagnostics: &mut Diagnostics) {
    for group in context.device.groups.iter().filter(|group| group.kind == GroupKind::Chapter) {
        chapter(group, diagnostics);
    }
}

/// Reports single missing numbers between parameters with consecutive numbers.
fn chapter(group: &Group, diagnostics: &mut Diagnostics) {
    let numbered: Vec<(u32, &Item)> = group.items.iter().filter_map(|item| Some((code(item)?, item))).collect();
    for (at, pair) in numbered.windows(2).enumerate() {
        let [(before, _), (after, item)] = pair else { continue };
        let missing = after.saturating_sub(*before).saturating_sub(1);
        if missing != 1 {
            continue;
        }
        let counts_up = |from: usize| {
            let row = numbered.get(from..from + ROW).unwrap_or_default();
            row.len() == ROW
                && row.windows(2).all(|pair| matches!(pair, [(one, _), (two, _)] if one.checked_add(1) == Some(*two)))
        };
        if (at + 1).checked_sub(ROW).is_some_and(counts_up) && counts_up(at + 1) {
            let (name, number, missing) = (brief(&item.name), hex16(*after), hex16(before + 1));
            let message = format!("`{name}` has the number {number}, but no row has {missing}");
            let found = codes::NUMBER_GAP.at(item.at.name.or(item.origin.span), message);
            diagnostics
                .push(found.help("add the missing row of the manual's table, unless the device has no such parameter"));
        }
    }
}

fn code(item: &Item) -> Option<u32> {
    item.bindings.iter().find_map(|binding| match binding {
        Binding::Parameter(parameter) => Some(parameter.code),
        _ => None,
    })
}
