//! Limits: default values and configured values outside of the limits, and swapped limits.

use std::cmp::Ordering;

use super::context::Context;
use crate::diagnostics::{codes, Diagnostic, Diagnostics};
use crate::ir::owner::Owner;
use crate::ir::{excluded, Excluded, Item, Type, Value};
use crate::number::hex;
use crate::text::brief;

/// Reports default values and configured values outside of the limits of their items, and swapped limits.
pub(super) fn check(owner: Owner<'_>, diagnostics: &mut Diagnostics) {
    for item in owner.items() {
        if !item.limits.is_empty() || !item.limits.allowed.is_empty() {
            limits(owner, item, diagnostics);
        }
    }
}

/// Reports items with only a minimum or only a maximum.
pub(super) fn one_given(context: &Context<'_>, diagnostics: &mut Diagnostics) {
    for item in context.owner.items() {
        let (given, other, span) = match (&item.limits.low, &item.limits.high) {
            (Some(_), None) => ("minimum", "maximum", item.at.others.low),
            (None, Some(_)) => ("maximum", "minimum", item.at.others.high),
            _ => continue,
        };
        let message = format!("`{}` has a {given}, but no {other}", brief(&item.name));
        diagnostics.push(codes::ONE_LIMIT.at(span.or(item.origin.span), message));
    }
}

/// Returns a help text if the limits are swapped only because `ty` has the wrong signedness: signed instead of unsigned, or the
/// reverse.
fn with_other_sign(ty: Type, low: &Value, high: &Value) -> Option<String> {
    let (low, high) = (low.as_int()?, high.as_int()?);
    match ty {
        Type::Unsigned(bits @ 1..=64) if low >> (bits - 1) == 1 => {
            let signed = low - (1i128 << bits);
            (signed <= high)
                .then(|| format!("use INTEGER{bits} if the value is signed: {} is {signed} in this type", hex(low)))
        }
        Type::Integer(bits @ 1..=64) if low >= 0 && high < 0 => {
            let unsigned = high + (1i128 << bits);
            Some(format!("use UNSIGNED{bits} if the value is unsigned: {} is {unsigned} in this type", hex(unsigned)))
        }
        _ => None,
    }
}

fn limits(owner: Owner<'_>, item: &Item, diagnostics: &mut Diagnostics) {
    let (low, high) = (item.limits.low.as_ref(), item.limits.high.as_ref());
    if let (Some(low), Some(high)) = (low, high) {
        if low.compare(high) == Some(Ordering::Greater) {
            let message = format!("the minimum {low} is greater than the maximum {high}");
            let found = codes::LIMITS_SWAPPED.at(item.at.others.low.or(item.origin.span), message);
            let found = found.label("the limits are kept, but generated code does not check them");
            let help = with_other_sign(owner.basic(item.ty), low, high);
            diagnostics.push(Diagnostic { help, ..found });
            return;
        }
    }
    let default = (item.default.as_ref(), item.at.default, "default");
    for (value, span, what) in [default, (item.configured_value(), item.at.others.configured, "configured value")] {
        let Some(value) = value else { continue };
        let Some(reason) = excluded(&item.limits, value) else { continue };
        let limit = match reason {
            Excluded::Above(_) => item.at.others.high,
            _ => item.at.others.low,
        };
        let message = format!("the {what} {value} is {reason}");
        let (help, note) = match reason {
            Excluded::NotAllowed => ("compare the number with the allowed values in the manual", "the allowed values"),
            _ => ("compare both numbers with the manual, and correct the misprinted one", "the limit"),
        };
        let found = codes::DEFAULT_OUT_OF_LIMITS.at(span.or(item.origin.span), message).help(help);
        diagnostics.push(if limit.is_empty() { found } else { found.note_at(limit, note) });
    }
}

/// Returns the limit that a number violates, as text for diagnostics. Returns `None` if the number is within the limits.
pub(super) fn beyond(item: &Item, number: i128) -> Option<String> {
    let (low, high) = item.limits.integers();
    let low = low.filter(|&low| number < low).map(|low| format!("minimum is {low}"));
    low.or_else(|| high.filter(|&high| number > high).map(|high| format!("maximum is {high}")))
}
