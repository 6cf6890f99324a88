//! How a raw number relates to a physical one.

use super::at::At;
use super::format::{ScaleRule, Scaling};
use super::references::{References, ITEM};
use super::tree::Reader;
use crate::diagnostics::{codes, Diagnostic};
use crate::ir::{ItemRef, Scale};
use crate::source::Span;

/// The greatest number of fractional bits.
const MAX_FRACTION: u8 = 63;

/// Reads a scale and the offset beside it; `None` where the raw number is the physical one. What makes no sense is
/// reported, in the row where it has no place of its own, and no scale.
pub(super) fn read(
    reader: &mut Reader<'_, '_>,
    (given, offset): (Option<&At<Scaling>>, Option<f64>),
    row: Span,
    references: &mut References,
) -> Option<Scale> {
    match (given, offset) {
        (Some(given), _) => said(reader, given, offset, references).flatten(),
        (None, Some(offset)) if !offset.is_finite() => {
            reader.report(&codes::TABLE_VALUE, row, NO_OFFSET);
            None
        }
        (None, offset) => linear(1.0, offset.unwrap_or(0.0)),
    }
}

const NO_OFFSET: &str = "an offset is a finite number";

/// What is said of a variant: a scale of 1, too, as the row's is another one.
pub(super) fn of_variant(
    reader: &mut Reader<'_, '_>,
    given: Option<&At<Scaling>>,
    references: &mut References,
) -> Option<Scale> {
    let found = said(reader, given?, None, references)?;
    Some(found.unwrap_or(Scale::Linear { factor: 1.0, offset: 0.0 }))
}

/// A scale that is given, which is none where it is 1; `None` where it makes no sense.
fn said(
    reader: &mut Reader<'_, '_>,
    given: &At<Scaling>,
    offset: Option<f64>,
    references: &mut References,
) -> Option<Option<Scale>> {
    let found = match &given.value {
        _ if offset.is_some_and(|offset| !offset.is_finite()) => Err(NO_OFFSET.to_owned()),
        Scaling::Factor(factor) => number("the scale", *factor).map(|factor| linear(factor, offset.unwrap_or(0.0))),
        Scaling::Rule(rule) => self::rule(rule, offset, references),
    };
    match found {
        Ok(scale) => Some(scale),
        Err(message) => {
            let found = Diagnostic::new(&codes::TABLE_VALUE, reader.span(given), message);
            reader.diagnostics.push(found.help("dictionaries/README.md has all forms of a scale"));
            None
        }
    }
}

fn linear(factor: f64, offset: f64) -> Option<Scale> {
    (factor != 1.0 || offset != 0.0).then_some(Scale::Linear { factor, offset })
}

/// A factor: with 0, or what is no number, every raw number would be the same.
fn number(what: &str, factor: f64) -> Result<f64, String> {
    if factor.is_finite() && factor != 0.0 {
        return Ok(factor);
    }
    Err(format!("{what} is {factor}: no raw number stands for a physical one then"))
}

/// The key that a rule is about, and those that may stand beside it.
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

fn rule(rule: &ScaleRule, beside: Option<f64>, references: &mut References) -> Result<Option<Scale>, String> {
    if beside.is_some() && rule.offset.is_some() {
        return Err("`offset` stands in the rule and beside it: write one of them".to_owned());
    }
    let offset = rule.offset.or(beside);
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
    let Some((key, beside)) = form.or((given == ["offset"]).then_some(("offset", &[]))) else {
        return Err("the rule is empty: it says nothing of the scale".to_owned());
    };
    if let Some(other) = given.iter().find(|other| **other != key && !beside.contains(other)) {
        return Err(format!("`{other}` doesn't go with `{key}`: no rule has both"));
    }
    let factor = rule.factor.map_or(Ok(1.0), |factor| number("`factor`", factor))?;
    let item = |given: &Option<At<String>>| given.as_ref().map(|own| own.value.as_str().into()).unwrap_or_default();
    let constant = rule.of.as_ref().map(|own| own.value.as_str().into()).unwrap_or_default();
    for (given, kind) in [(&rule.by, ITEM), (&rule.times, ITEM), (&rule.exponent, ITEM), (&rule.of, "constant")] {
        references.extend(given.iter().map(|given| (given.clone(), kind)));
    }
    Ok(match key {
        "exponent" => Some(exponent(rule, item(&rule.exponent))?),
        "reciprocal" => {
            let numerator = number("`reciprocal`", rule.reciprocal.unwrap_or(0.0))?;
            Some(Scale::Reciprocal { numerator })
        }
        "by" => Some(Scale::ByItem { item: item(&rule.by), factor }),
        "times" => Some(Scale::TimesItem { item: item(&rule.times), factor }),
        "fraction" if rule.of.is_none() => return Err("a `fraction` is one of something: say `of` what".to_owned()),
        "fraction" => Some(Scale::Fraction { bits: fraction(rule)?, base: constant }),
        "of" => return Err("`of` says what a `fraction` is one of, and there is no `fraction`".to_owned()),
        "base" => return Err("`base` is what an `exponent` raises, and there is no `exponent`".to_owned()),
        _ => linear(factor, offset.filter(|offset| offset.is_finite()).unwrap_or(0.0)),
    })
}

fn exponent(rule: &ScaleRule, exponent: ItemRef) -> Result<Scale, String> {
    let base = rule.base.unwrap_or(10);
    if !matches!(base, 2 | 10) {
        return Err(format!("`base` is 10 or 2, and not {base}"));
    }
    let fraction = if rule.fraction.is_some() { fraction(rule)? } else { 0 };
    Ok(Scale::Exponent { exponent, base, fraction })
}

fn fraction(rule: &ScaleRule) -> Result<u8, String> {
    match rule.fraction {
        Some(bits @ 1..=MAX_FRACTION) => Ok(bits),
        other => Err(format!("`fraction` goes from 1 to {MAX_FRACTION} bits, and not {}", other.unwrap_or(0))),
    }
}
