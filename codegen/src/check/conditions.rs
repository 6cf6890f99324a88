//! Values of conditions against the values that the other item can have.

use std::collections::{BTreeMap, HashSet};

use super::context::Context;
use crate::diagnostics::{codes, Diagnostic, Diagnostics};
use crate::ir::owner::{reserved, Owner};
use crate::ir::{Condition, Device, ItemRef, Shape, Value};
use crate::source::Span;
use crate::text::brief;

pub(super) fn check(context: &Context<'_>, diagnostics: &mut Diagnostics) {
    let (owner, device) = (context.owner, context.device);
    for item in owner.items() {
        for condition in item.behaviour.iter().flat_map(|behaviour| &behaviour.write_when) {
            possible(owner, device, condition, item.origin.span, diagnostics);
        }
    }
    for definition in owner.types {
        if let Shape::Enumeration { values, .. } = &definition.shape {
            for value in values {
                let condition = value.when.iter();
                condition.for_each(|own| possible(owner, device, own, value.at.0, diagnostics));
            }
        }
        let Shape::BitField { fields, .. } = &definition.shape else { continue };
        let conditions: Vec<&Condition> = fields.iter().filter_map(|field| field.when.as_ref()).collect();
        for condition in &conditions {
            possible(owner, device, condition, definition.origin.span, diagnostics);
        }
        let name = brief(&definition.name);
        complete(owner, device, &conditions, (name, definition.origin.span), diagnostics);
    }
}

fn possible(owner: Owner<'_>, device: &Device, condition: &Condition, span: Span, diagnostics: &mut Diagnostics) {
    let Some(item) = device.referred(&condition.item) else { return };
    // Some bits of an item have neither its limits nor its names.
    if condition.mask.is_some() {
        return;
    }
    let (low, high) = (item.limits.low.as_ref(), item.limits.high.as_ref());
    for value in condition.values.iter().filter_map(Value::as_int) {
        let below = low.and_then(Value::as_int).is_some_and(|low| value < low);
        let above = high.and_then(Value::as_int).is_some_and(|high| value > high);
        let why = match owner.enumeration(item.ty) {
            _ if below || above => "is outside of its limits",
            Some((labels, _)) => match reserved(labels, value) {
                None => "has no name there",
                Some(true) => "is reserved there",
                Some(false) => continue,
            },
            None => continue,
        };
        let message = format!("the condition `{}` = {value} never holds: {value} {why}", brief(&condition.item));
        let found = Diagnostic::new(&codes::UNNAMED_VALUE, span, message);
        let found = found.note_at(item.origin.span, "the other item");
        diagnostics.push(found.help("correct the value, or name it there, if the manual does"));
    }
}

/// Whether bits that depend on an enumeration have a meaning for each of its values.
fn complete(
    owner: Owner<'_>,
    device: &Device,
    conditions: &[&Condition],
    (name, span): (&str, Span),
    diagnostics: &mut Diagnostics,
) {
    if !diagnostics.wants(&codes::MODE_WITHOUT_BITS) {
        return;
    }
    let named: BTreeMap<&str, &ItemRef> = conditions.iter().map(|own| (own.item.as_str(), &own.item)).collect();
    for (name_of_other, other) in named {
        let Some((labels, _)) = device.referred(other).and_then(|item| owner.enumeration(item.ty)) else { continue };
        let own = conditions.iter().filter(|condition| condition.item == *other && condition.mask.is_none());
        let values: HashSet<i128> = own.flat_map(|own| &own.values).filter_map(Value::as_int).collect();
        let missing = labels.iter().filter(|label| label.zone.is_none() && label.last.is_none());
        let missing: Vec<String> = missing
            .filter(|label| label.value != 0 && !values.contains(&label.value))
            .map(|label| format!("{} (`{}`)", label.value, brief(&label.name)))
            .collect();
        if !missing.is_empty() {
            let message = format!("`{name}` has no bits for `{}` = {}", brief(name_of_other), missing.join(", "));
            diagnostics.push(Diagnostic::new(&codes::MODE_WITHOUT_BITS, span, message));
        }
    }
}
