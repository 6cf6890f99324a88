//! After this pass every default was held against its limits, and the limits against each other.

use std::cmp::Ordering;
use std::fmt;

use crate::diagnostics::{codes, Diagnostic, Diagnostics};
use crate::ir::owner::Owner;
use crate::ir::{Group, Item, Limits, Type, TypeDef, Value};
use crate::source::Span;

pub(super) fn run<'a>(groups: impl Iterator<Item = &'a Group>, types: &[TypeDef], diagnostics: &mut Diagnostics) {
    let owner = Owner { types, groups: &[] };
    for group in groups {
        for item in &group.items {
            if !item.limits.is_empty() || !item.limits.allowed.is_empty() {
                limits(owner, item, diagnostics);
            }
        }
    }
}

/// What limits that are swapped were meant to be: those of the other integer of the same length.
fn with_other_sign(ty: Type, low: &Value, high: &Value) -> Option<String> {
    let (low, high) = (low.as_int()?, high.as_int()?);
    match ty {
        Type::Unsigned(bits @ 1..=64) if low >> (bits - 1) == 1 => {
            let signed = low - (1i128 << bits);
            (signed <= high).then(|| format!("as INTEGER{bits}, {low:#X} is {signed}: is the type signed?"))
        }
        Type::Integer(bits @ 1..=64) if low >= 0 && high < 0 => {
            let unsigned = high + (1i128 << bits);
            Some(format!("as UNSIGNED{bits}, {unsigned:#X} is {unsigned}: is the type unsigned?"))
        }
        _ => None,
    }
}

fn limits(owner: Owner<'_>, item: &Item, diagnostics: &mut Diagnostics) {
    let (low, high) = (item.limits.low.as_ref(), item.limits.high.as_ref());
    if let (Some(low), Some(high)) = (low, high) {
        if low.compare(high) == Some(Ordering::Greater) {
            let message = format!("the lower limit {low} is greater than the upper limit {high}");
            let found = Diagnostic::new(&codes::LIMITS_SWAPPED, item.at.low.or(item.origin.span), message)
                .label("the limits are kept, and not checked by generated code");
            diagnostics.push(match with_other_sign(owner.basic(item.ty), low, high) {
                Some(help) => found.help(help),
                None => found,
            });
            return;
        }
    }
    let configured = item.configured.as_ref().and_then(|configured| configured.value.as_ref());
    let values = [(item.default.as_ref(), item.at.default, "default"), (configured, item.at.configured, "value")];
    for (value, span, what) in values {
        let Some(value) = value else { continue };
        let Some(reason) = excluded(&item.limits, value) else { continue };
        let limit = match reason {
            Excluded::Above(_) => item.at.high,
            _ => item.at.low,
        };
        report(diagnostics, span.or(item.origin.span), format!("the {what} {value} is {reason}"), limit);
    }
}

/// Why limits exclude a value.
pub(crate) enum Excluded<'l> {
    Below(&'l Value),
    Above(&'l Value),
    NotAllowed,
}

impl fmt::Display for Excluded<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Excluded::Below(low) => write!(f, "below the lower limit {low}"),
            Excluded::Above(high) => write!(f, "above the upper limit {high}"),
            Excluded::NotAllowed => f.write_str("none of the allowed values"),
        }
    }
}

/// Whether limits exclude a value. What is no number they don't.
pub(crate) fn excluded<'l>(limits: &'l Limits, value: &Value) -> Option<Excluded<'l>> {
    let is = |limit: &&Value, order| value.compare(limit) == Some(order);
    let below = || limits.low.as_ref().filter(|low| is(low, Ordering::Less)).map(Excluded::Below);
    let above = || limits.high.as_ref().filter(|high| is(high, Ordering::Greater)).map(Excluded::Above);
    let not_allowed = || (!is_allowed(value, &limits.allowed)).then_some(Excluded::NotAllowed);
    below().or_else(above).or_else(not_allowed)
}

/// Whether a number is in one of the ranges, where there are any.
fn is_allowed(value: &Value, allowed: &[(Value, Value)]) -> bool {
    let within = |(first, last): &(Value, Value)| {
        first.compare(value).is_none_or(|order| order != Ordering::Greater)
            && value.compare(last).is_none_or(|order| order != Ordering::Greater)
    };
    allowed.is_empty() || allowed.iter().any(within)
}

fn report(diagnostics: &mut Diagnostics, span: Span, message: String, limit: Span) {
    let mut diagnostic = Diagnostic::new(&codes::DEFAULT_OUT_OF_LIMITS, span, message)
        .help("one of the numbers is misprinted: compare them with the manual, and correct it");
    if !limit.is_empty() {
        diagnostic = diagnostic.note_at(limit, "the limit");
    }
    diagnostics.push(diagnostic);
}
