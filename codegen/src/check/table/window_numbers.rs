//! Windows against the numbers of the items behind them, and against the values of items that are nowhere else.

use std::collections::HashSet;

use super::windows::{behind, windows};
use crate::check::context::Context;
use crate::diagnostics::{codes, Diagnostic, Diagnostics};
use crate::ir::owner::Owner;
use crate::ir::{Binding, Item, Type};
use crate::text::brief;

pub(crate) fn check(context: &Context<'_>, diagnostics: &mut Diagnostics) {
    let mut told = HashSet::new();
    for item in behind(context) {
        for window in windows(item) {
            for side in [&window.read, &window.write].into_iter().flatten() {
                let (taker, holder) = (context.device.referred(&side.number), context.device.referred(&side.value));
                for (part, what) in [(taker, "the number"), (holder, "the value")] {
                    let Some(part) = part.filter(|part| integer(context.owner, part).is_none()) else { continue };
                    if told.insert(part.name.as_str()) {
                        diagnostics.push(no_integer(part, what));
                    }
                }
                number(context.owner, item, window.number, taker, diagnostics);
            }
        }
        value(context.owner, item, diagnostics);
    }
}

/// A part of a window that is none.
fn no_integer(part: &Item, what: &str) -> Diagnostic {
    let message = format!("`{}` has {what} of a window, which is an integer of up to 64 bits", brief(&part.name));
    codes::TABLE_VALUE.at(part.at.ty.or(part.at.name), message)
}

/// Bits of an integer.
fn integer(owner: Owner<'_>, item: &Item) -> Option<u32> {
    match owner.basic(item.ty) {
        Type::Boolean => Some(1),
        Type::Integer(bits @ 1..=64) | Type::Unsigned(bits @ 1..=64) => Some(bits.into()),
        _ => None,
    }
}

/// Whether the number of an item fits what takes it.
fn number(owner: Owner<'_>, item: &Item, number: u32, taker: Option<&Item>, diagnostics: &mut Diagnostics) {
    let Some((taker, bits)) = taker.and_then(|taker| Some((taker, integer(owner, taker)?))) else { return };
    if u64::from(number).checked_shr(bits).unwrap_or(0) == 0 {
        return;
    }
    let (name, taker) = (brief(&item.name), brief(&taker.name));
    let message = format!("the number {number} of `{name}` doesn't fit `{taker}`, which has {bits} bits");
    let found = codes::TABLE_PLACE.at(item.at.name.or(item.origin.span), message);
    diagnostics.push(found.help("`numbers` of the window says which it takes"));
}

/// Whether a value that is nowhere else can come through a window.
fn value(owner: Owner<'_>, item: &Item, diagnostics: &mut Diagnostics) {
    let is_only = item.bindings.iter().all(|binding| matches!(binding, Binding::Indirect(_)));
    let is_number = integer(owner, item).is_some() || matches!(owner.basic(item.ty), Type::Real32 | Type::Real64);
    if is_only && !is_number {
        let name = brief(&item.name);
        let message = format!("`{name}` is only found behind a window, which has integers, and is none");
        diagnostics.push(codes::TABLE_VALUE.at(item.at.ty.or(item.at.name), message));
    }
}
