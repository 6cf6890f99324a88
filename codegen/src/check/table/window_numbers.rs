//! Checks that the numbers of items fit into the windows, and that the items of a window are integers. Also checks that
//! windows can transfer the values of items that have no other address.

use super::windows::{behind, windows};
use crate::check::context::Context;
use crate::collections::HashSet;
use crate::diagnostics::{codes, Diagnostic, Diagnostics};
use crate::ir::owner::Owner;
use crate::ir::{Binding, Item, Type};
use crate::text::brief;

pub(crate) fn check(context: &Context<'_>, diagnostics: &mut Diagnostics) {
    let mut reported = HashSet::default();
    for item in behind(context) {
        for window in windows(item) {
            for side in [&window.read, &window.write].into_iter().flatten() {
                let (receiver, holder) = (context.device.referred(&side.number), context.device.referred(&side.value));
                for (part, what) in [(receiver, "the register number"), (holder, "the value")] {
                    let Some(part) = part.filter(|part| integer(context.owner, part).is_none()) else { continue };
                    if reported.insert(part.name.as_str()) {
                        diagnostics.push(no_integer(part, what));
                    }
                }
                number(context.owner, item, window.number, receiver, diagnostics);
            }
        }
        value(context.owner, item, diagnostics);
    }
}

/// Creates the diagnostic about a window whose number item or value item is not an integer.
fn no_integer(part: &Item, what: &str) -> Diagnostic {
    let message = format!("`{}` holds {what} of a window, but is not an integer of up to 64 bits", brief(&part.name));
    codes::TABLE_VALUE.at(part.at.ty.or(part.at.name), message)
}

/// Returns the length in bits of an item that is a BOOLEAN or an integer of up to 64 bits, or `None` for another item.
fn integer(owner: Owner<'_>, item: &Item) -> Option<u32> {
    match owner.basic(item.ty) {
        Type::Boolean => Some(1),
        Type::Integer(bits @ 1..=64) | Type::Unsigned(bits @ 1..=64) => Some(bits.into()),
        _ => None,
    }
}

/// Checks that the number of an item fits into the item of the window that receives this number.
fn number(owner: Owner<'_>, item: &Item, number: u32, receiver: Option<&Item>, diagnostics: &mut Diagnostics) {
    let Some((receiver, bits)) = receiver.and_then(|receiver| Some((receiver, integer(owner, receiver)?))) else {
        return;
    };
    if u64::from(number).checked_shr(bits).unwrap_or(0) == 0 {
        return;
    }
    let (name, receiver) = (brief(&item.name), brief(&receiver.name));
    let message = format!("the register number {number} of `{name}` does not fit `{receiver}`, which has {bits} bits");
    let found = codes::TABLE_PLACE.at(item.at.name.or(item.origin.span), message);
    diagnostics.push(found.help("limit the window to valid numbers with `numbers`"));
}

/// Checks that a window can transfer the value of an item, if the item has no other address.
fn value(owner: Owner<'_>, item: &Item, diagnostics: &mut Diagnostics) {
    let is_only = item.bindings.iter().all(|binding| matches!(binding, Binding::Indirect(_)));
    let is_number = integer(owner, item).is_some() || matches!(owner.basic(item.ty), Type::Real32 | Type::Real64);
    if is_only && !is_number {
        let name = brief(&item.name);
        let message =
            format!("`{name}` is accessible only through a window, which transfers integers, but is not an integer");
        diagnostics.push(codes::TABLE_VALUE.at(item.at.ty.or(item.at.name), message));
    }
}
