//! After this pass every default was held against its limits, and the limits against each other.

use std::cmp::Ordering;

use crate::diagnostics::{codes, Diagnostic, Diagnostics};
use crate::ir::{Group, Item, Value};
use crate::source::Span;

pub(super) fn run<'a>(groups: impl Iterator<Item = &'a Group>, diagnostics: &mut Diagnostics) {
    for group in groups {
        for item in &group.items {
            if !item.limits.is_empty() {
                limits(item, diagnostics);
            }
        }
    }
}

/// How two numbers compare; `None` where one is no number.
fn compare(left: &Value, right: &Value) -> Option<Ordering> {
    match (left.as_int(), right.as_int()) {
        (Some(left), Some(right)) => Some(left.cmp(&right)),
        _ => left.as_real()?.partial_cmp(&right.as_real()?),
    }
}

fn limits(item: &Item, diagnostics: &mut Diagnostics) {
    let (low, high) = (item.limits.low.as_ref(), item.limits.high.as_ref());
    if let (Some(low), Some(high)) = (low, high) {
        if compare(low, high) == Some(Ordering::Greater) {
            let message = format!("the lower limit {low} is greater than the upper limit {high}");
            diagnostics.push(
                Diagnostic::new(&codes::LIMITS_SWAPPED, item.at.low.or(item.origin.span), message)
                    .label("the limits are kept, and not checked by generated code"),
            );
            return;
        }
    }
    let configured = item.configured.as_ref().and_then(|configured| configured.value.as_ref());
    let values = [(item.default.as_ref(), item.at.default, "default"), (configured, item.at.configured, "value")];
    for (value, span, what) in values {
        let Some(value) = value else { continue };
        let below = low.filter(|low| compare(value, low) == Some(Ordering::Less));
        let above = high.filter(|high| compare(value, high) == Some(Ordering::Greater));
        let (relation, limit, at) = match (below, above) {
            (Some(low), _) => ("below the lower", low, item.at.low),
            (_, Some(high)) => ("above the upper", high, item.at.high),
            _ => {
                if !is_allowed(value, &item.limits.allowed) {
                    let message = format!("the {what} {value} is none of the allowed values");
                    report(diagnostics, span.or(item.origin.span), message, item.at.low);
                }
                continue;
            }
        };
        report(diagnostics, span.or(item.origin.span), format!("the {what} {value} is {relation} limit {limit}"), at);
    }
}

/// Whether a number is in one of the ranges, where there are any.
fn is_allowed(value: &Value, allowed: &[(Value, Value)]) -> bool {
    let within = |(first, last): &(Value, Value)| {
        compare(first, value).is_none_or(|order| order != Ordering::Greater)
            && compare(value, last).is_none_or(|order| order != Ordering::Greater)
    };
    allowed.is_empty() || allowed.iter().any(within)
}

fn report(diagnostics: &mut Diagnostics, span: Span, message: String, limit: Span) {
    let mut diagnostic = Diagnostic::new(&codes::DEFAULT_OUT_OF_LIMITS, span, message);
    if !limit.is_empty() {
        diagnostic = diagnostic.note_at(limit, "the limit");
    }
    diagnostics.push(diagnostic);
}
