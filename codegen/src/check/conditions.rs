//! Conditions: values that the item of a condition cannot have, and modes of operation for which no bits are defined.

use std::collections::BTreeMap;

use super::context::Context;
use crate::collections::HashSet;
use crate::diagnostics::{codes, Diagnostics};
use crate::ir::owner::reserved;
use crate::ir::{stated, Condition, ItemRef, Shape, TypeDef, Value};
use crate::source::Span;
use crate::text::brief;

pub(super) fn check(context: &Context<'_>, diagnostics: &mut Diagnostics) {
    let owner = context.owner;
    for item in owner.items() {
        for condition in stated::behavior(item).into_iter().flat_map(|behavior| &behavior.write_when) {
            possible(context, condition, item.origin.span, diagnostics);
        }
    }
    for (_, definition) in stated::types(owner.types) {
        match &definition.shape {
            Shape::Enumeration { values, .. } => {
                for (value, condition) in values.iter().filter_map(|value| Some((value, value.when.as_deref()?))) {
                    possible(context, condition, value.at.0, diagnostics);
                }
            }
            Shape::BitField { fields, .. } => {
                let conditions: Vec<&Condition> = fields.iter().filter_map(|field| field.when.as_deref()).collect();
                for condition in &conditions {
                    possible(context, condition, definition.origin.span, diagnostics);
                }
                complete(context, definition, &conditions, diagnostics);
            }
            _ => {}
        }
    }
}

fn possible(context: &Context<'_>, condition: &Condition, span: Span, diagnostics: &mut Diagnostics) {
    // The limits and value names of an item apply to its whole value, and not to the bits that a mask selects.
    let whole = context.device.referred(&condition.item).filter(|_| condition.mask.is_none());
    let Some(item) = whole else { return };
    let (low, high) = item.limits.integers();
    for value in condition.values.iter().filter_map(Value::as_int) {
        let is_outside = low.is_some_and(|low| value < low) || high.is_some_and(|high| value > high);
        let why = match stated::enumeration(context.owner, item) {
            _ if is_outside => "is outside of the limits of the item",
            Some((labels, _)) => match reserved(labels, value) {
                None => "has no name",
                Some(true) => "is reserved",
                Some(false) => continue,
            },
            None => continue,
        };
        let message = format!("the condition `{}` = {value} is never true: {value} {why}", brief(&condition.item));
        let found = codes::UNNAMED_VALUE.at(span, message).note_at(item.origin.span, "the item of the condition");
        let help = "correct the value in the condition, or name the value in its enumeration if the manual does";
        diagnostics.push(found.help(help));
    }
}

/// Reports modes without bits: values of an enumeration for which a bit field defines no bits, although other values of
/// the enumeration select bits. The value 0 is not reported.
fn complete(context: &Context<'_>, definition: &TypeDef, conditions: &[&Condition], diagnostics: &mut Diagnostics) {
    if !diagnostics.wants(&codes::MODE_WITHOUT_BITS) {
        return;
    }
    let items = conditions.iter().map(|condition| (condition.item.as_str(), &condition.item));
    let items: BTreeMap<&str, &ItemRef> = items.collect();
    let name = brief(&definition.name);
    for (name_of_other, other) in items {
        let enumeration = context.device.referred(other).and_then(|item| stated::enumeration(context.owner, item));
        let Some((labels, _)) = enumeration else { continue };
        let of_item = conditions.iter().filter(|condition| condition.item == *other && condition.mask.is_none());
        let values: HashSet<i128> = of_item.flat_map(|condition| &condition.values).filter_map(Value::as_int).collect();
        let missing = labels.iter().filter(|label| label.is_named() && label.last.is_none());
        let missing = missing.filter(|label| label.value != 0 && !values.contains(&label.value));
        let missing: Vec<String> = missing.map(|label| format!("{} (`{}`)", label.value, brief(&label.name))).collect();
        if !missing.is_empty() {
            let message = format!("`{name}` describes no bits for `{}` = {}", brief(name_of_other), missing.join(", "));
            diagnostics.push(codes::MODE_WITHOUT_BITS.at(definition.origin.span, message));
        }
    }
}
