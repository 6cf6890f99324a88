//! Generates checks of a record's fields against their allowed values.

use super::Parameter;
use crate::backend::rust::code::{call, seq, slice, Doc};
use crate::backend::rust::literal;
use crate::backend::rust::profinet::field::Field;
use crate::backend::rust::profinet::values::Enumeration;
use crate::ir::{Limits, Value};

/// Returns the minimum and maximum of each allowed range.
pub(super) fn ranges(limits: &Limits) -> Vec<(Option<Value>, Option<Value>)> {
    if !limits.allowed.is_empty() {
        return limits.allowed.iter().map(|(first, last)| (Some(first.clone()), Some(last.clone()))).collect();
    }
    match limits.is_empty() {
        true => Vec::new(),
        false => vec![(limits.low.clone(), limits.high.clone())],
    }
}

/// Returns a statement that checks a field. Returns `None` if all values of the Rust type are allowed. The allowed
/// ranges are ignored if they contain no value of the field.
pub(super) fn check(parameter: &Parameter<'_>, name: &str) -> Option<Doc> {
    let Parameter { item, field, .. } = parameter;
    let allowed = ranges(&item.limits);
    let list = if field.is_bool() {
        bools(&allowed)
    } else if field.is_real() {
        reals(&allowed, field.position.bits)
    } else {
        integers(&allowed, field)
    }?;
    let raw = if field.enumeration.is_some() { ".raw()" } else { "" };
    let title = literal::string(if item.name.is_empty() { name } else { &item.name });
    Some(seq![call!("rt::profinet::check", title, seq!["self.", name, raw], slice(list)), "?;"])
}

fn bools(allowed: &[(Option<Value>, Option<Value>)]) -> Option<Vec<String>> {
    let number = |value: &Option<Value>| value.as_ref().and_then(Value::as_int);
    let has = |wanted| {
        allowed.iter().any(|(first, last)| number(first).unwrap_or(0) <= wanted && wanted <= number(last).unwrap_or(1))
    };
    match (has(0), has(1)) {
        (true, false) => Some(vec!["(false, false)".to_owned()]),
        (false, true) => Some(vec!["(true, true)".to_owned()]),
        _ => None,
    }
}

fn reals(allowed: &[(Option<Value>, Option<Value>)], bits: u32) -> Option<Vec<String>> {
    let name = if bits == 32 { "f32" } else { "f64" };
    let bound = |value: &Option<Value>, missing: &str| {
        let value = value.as_ref().and_then(Value::as_real).and_then(|value| literal::real(value, bits));
        value.unwrap_or_else(|| format!("{name}::{missing}"))
    };
    let list = allowed.iter().filter(|(first, last)| {
        let both = first.as_ref().and_then(Value::as_real).zip(last.as_ref().and_then(Value::as_real));
        both.is_none_or(|(first, last)| first <= last)
    });
    let list: Vec<String> =
        list.map(|(first, last)| format!("({}, {})", bound(first, "MIN"), bound(last, "MAX"))).collect();
    (!list.is_empty()).then_some(list)
}

fn integers(allowed: &[(Option<Value>, Option<Value>)], field: &Field<'_>) -> Option<Vec<String>> {
    let (low, high) = field.range()?;
    // An enumeration's type may have fewer bits than the field.
    let (low, high) = match field.enumeration.and_then(Enumeration::range) {
        Some((low_native, high_native)) => (low.max(low_native), high.min(high_native)),
        None => (low, high),
    };
    let bound = |value: &Option<Value>| match value {
        Some(Value::Real(value)) => Some(*value as i128),
        other => other.as_ref().and_then(Value::as_int),
    };
    let mut list: Vec<(i128, i128)> = allowed
        .iter()
        .map(|(first, last)| (bound(first).unwrap_or(low).max(low), bound(last).unwrap_or(high).min(high)))
        .filter(|(first, last)| first <= last)
        .collect();
    let is_full = list.is_empty() || list.contains(&(low, high));
    if is_full {
        if !field.is_narrow() {
            return None;
        }
        list = vec![(low, high)];
    }
    Some(list.iter().map(|(first, last)| format!("({first}, {last})")).collect())
}
