//! Reads the scale that converts raw values to physical values.

use super::at::At;
use super::format::{ScaleRule, Scaling};
use super::references::ITEM;
use super::tree::Reader;
use crate::diagnostics::codes;
use crate::ir::{ItemRef, Scale};
use crate::source::Span;

/// Maximum number of fractional bits.
const MAX_FRACTION: u8 = 63;

/// Reads a scale and the separate offset. Returns `None` if raw and physical values are equal. Reports and ignores an invalid
/// scale. A diagnostic about an offset without a scale marks the span `row`.
pub(super) fn read(
    reader: &mut Reader<'_, '_>,
    given: Option<&At<Scaling>>,
    offset: Option<f64>,
    row: Span,
) -> Option<Scale> {
    match (given, offset) {
        (Some(given), _) => explicit(reader, given, offset).flatten(),
        (None, Some(offset)) if !offset.is_finite() => {
            reader.report(&codes::TABLE_VALUE, row, NO_OFFSET);
            None
        }
        (None, offset) => linear(1.0, offset.unwrap_or(0.0)),
    }
}

const NO_OFFSET: &str = "the offset is not a finite number";

/// Reads the scale of a variant. A factor of 1 counts as a scale, because it replaces the scale of the row.
pub(super) fn of_variant(reader: &mut Reader<'_, '_>, given: Option<&At<Scaling>>) -> Option<Scale> {
    let found = explicit(reader, given?, None)?;
    Some(found.unwrap_or(Scale::Linear { factor: 1.0, offset: 0.0 }))
}

/// Reads a scale that the table declares. Returns `Some(None)` for a factor of 1 without an offset. Reports an invalid
/// scale, and returns `None`.
fn explicit(reader: &mut Reader<'_, '_>, given: &At<Scaling>, offset: Option<f64>) -> Option<Option<Scale>> {
    let found = match &given.value {
        _ if offset.is_some_and(|offset| !offset.is_finite()) => Err(NO_OFFSET.to_owned()),
        Scaling::Factor(factor) => number("the scale", *factor).map(|factor| linear(factor, offset.unwrap_or(0.0))),
        Scaling::Rule(rule) => self::rule(reader, rule, offset),
    };
    match found {
        Ok(scale) => Some(scale),
        Err(message) => {
            let found = codes::TABLE_VALUE.at(reader.span(given), message);
            reader.diagnostics.push(found.help("see dictionaries/README.md for all forms of a scale"));
            None
        }
    }
}

fn linear(factor: f64, offset: f64) -> Option<Scale> {
    (factor != 1.0 || offset != 0.0).then_some(Scale::Linear { factor, offset })
}

/// Checks that a factor is finite and not 0. With any other factor, values cannot be converted.
fn number(what: &str, factor: f64) -> Result<f64, String> {
    if factor.is_finite() && factor != 0.0 {
        return Ok(factor);
    }
    Err(format!("{what} is {factor}, so no raw value has a physical value"))
}

/// Key that defines each form of a rule, and the further keys of this form.
const FORMS: [(&str, &[&str]); 8] = [
    ("exponent", &["base", "fraction"]),
    ("reciprocal", &[]),
    ("by", &["factor"]),
    ("times", &["factor"]),
    ("fraction", &["of"]),
    ("of", &[]),
    ("base", &[]),
    ("factor", &["offset"]),
];

fn rule(reader: &mut Reader<'_, '_>, rule: &ScaleRule, separate: Option<f64>) -> Result<Option<Scale>, String> {
    if separate.is_some() && rule.offset.is_some() {
        return Err("`offset` is given both in the scale rule and next to it".to_owned());
    }
    let offset = rule.offset.or(separate);
    let given = [
        ("exponent", rule.exponent.is_some()),
        ("reciprocal", rule.reciprocal.is_some()),
        ("by", rule.by.is_some()),
        ("times", rule.times.is_some()),
        ("fraction", rule.fraction.is_some()),
        ("of", rule.of.is_some()),
        ("base", rule.base.is_some()),
        ("factor", rule.factor.is_some()),
        ("offset", offset.is_some()),
    ];
    let given: Vec<&str> = given.into_iter().filter(|(_, is_given)| *is_given).map(|(key, _)| key).collect();
    let form = FORMS.into_iter().find(|(key, _)| given.contains(key));
    let Some((key, further)) = form.or((given == ["offset"]).then_some(("offset", &[]))) else {
        return Err("the scale rule has no keys".to_owned());
    };
    if let Some(other) = given.iter().find(|other| **other != key && !further.contains(other)) {
        return Err(format!("`{other}` and `{key}` cannot be in one rule"));
    }
    let factor = rule.factor.map_or(Ok(1.0), |factor| number("`factor`", factor))?;
    let item = |given: &Option<At<String>>| given.as_ref().map(|name| name.value.as_str().into()).unwrap_or_default();
    let constant = rule.of.as_ref().map(|name| name.value.as_str().into()).unwrap_or_default();
    for (given, kind) in [(&rule.by, ITEM), (&rule.times, ITEM), (&rule.exponent, ITEM), (&rule.of, "constant")] {
        reader.mention(given, kind);
    }
    Ok(match key {
        "exponent" => Some(exponent(rule, item(&rule.exponent))?),
        "reciprocal" => {
            let numerator = number("`reciprocal`", rule.reciprocal.unwrap_or(0.0))?;
            Some(Scale::Reciprocal { numerator })
        }
        "by" => Some(Scale::ByItem { item: item(&rule.by), factor }),
        "times" => Some(Scale::TimesItem { item: item(&rule.times), factor }),
        "fraction" if rule.of.is_none() => return Err("`fraction` needs `of`, the name of its base value".to_owned()),
        "fraction" => Some(Scale::Fraction { bits: fraction(rule)?, base: constant }),
        "of" => return Err("the rule has `of`, but no `fraction`".to_owned()),
        "base" => return Err("the rule has `base`, but no `exponent`".to_owned()),
        _ => linear(factor, offset.filter(|offset| offset.is_finite()).unwrap_or(0.0)),
    })
}

fn exponent(rule: &ScaleRule, exponent: ItemRef) -> Result<Scale, String> {
    let base = rule.base.unwrap_or(10);
    if !matches!(base, 2 | 10) {
        return Err(format!("`base` must be 10 or 2, but is {base}"));
    }
    let fraction = if rule.fraction.is_some() { fraction(rule)? } else { 0 };
    Ok(Scale::Exponent { exponent, base, fraction })
}

fn fraction(rule: &ScaleRule) -> Result<u8, String> {
    match rule.fraction {
        Some(bits @ 1..=MAX_FRACTION) => Ok(bits),
        other => Err(format!("`fraction` must be from 1 to {MAX_FRACTION} bits, but is {}", other.unwrap_or(0))),
    }
}
