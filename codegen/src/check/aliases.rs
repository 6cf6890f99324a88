//! Items that are declared to have the same value, and items that replace other items.

use std::collections::{BTreeMap, BTreeSet};

use super::context::Context;
use crate::diagnostics::{codes, Diagnostics};
use crate::ir::owner::Owner;
use crate::ir::{stated, Device, Item, ItemRef, Quantity, Scale, Shape};
use crate::number;
use crate::source::Span;
use crate::text::{brief, count_of, more, numbered};

pub(super) fn check(context: &Context<'_>, diagnostics: &mut Diagnostics) {
    for (_, id, item) in context.owner.identified() {
        replacement(context.device, item, diagnostics);
        let Some(alias) = item.related.as_ref().and_then(|related| related.same_as.as_ref()) else { continue };
        let Some(other) = context.device.referred(alias).filter(|_| alias.id != Some(id)) else { continue };
        let differences = differences(context.owner, item, other);
        if let Some((first, others)) = differences.split_first() {
            let names = format!("`{}` and `{}`", brief(&item.name), brief(alias));
            let message = format!("{names} are declared as the same value, but {first}");
            let found = codes::SAME_VALUE_DIFFERS.at(difference_span(item, alias), message);
            let found = others.iter().fold(found, |found, other| found.note(format!("{names} also differ: {other}")));
            diagnostics.push(found.note_at(other.origin.span, format!("`{}` is defined here", brief(alias))));
        }
    }
}

/// Returns the location of the first fact that comes from an overlay: the reference, the type, the minimum or the
/// maximum. Returns the location of the row if none of these facts comes from an overlay.
fn difference_span(item: &Item, alias: &ItemRef) -> Span {
    let row = item.origin.span;
    let facts = [alias.span, item.at.ty, item.at.others.low, item.at.others.high];
    facts.into_iter().find(|fact| !fact.is_empty() && fact.file != row.file).unwrap_or(row)
}

/// Reports a replacement whose access rights differ from those of the item that it replaces. Access rights that a row inherits
/// are not compared.
fn replacement(device: &Device, item: &Item, diagnostics: &mut Diagnostics) {
    let reference = item.availability.as_ref().and_then(|availability| availability.replaced_by.as_ref());
    let Some(other) = reference.and_then(|reference| device.item(reference.id?.item()?)) else { return };
    let is_stated = |item: &Item| {
        let (row, access) = (item.origin.span, item.at.access);
        !access.is_empty() && row.start <= access.start && access.end <= row.end
    };
    let rights = |item: &Item| (item.access.readable(), item.access.writable());
    if is_stated(item) && is_stated(other) && rights(item) != rights(other) {
        let (name, other_name) = (brief(&item.name), brief(&other.name));
        let (access, other_access) = (item.access.name(), other.access.name());
        let message = format!("`{name}` is {access}, but its replacement `{other_name}` is {other_access}");
        let found = codes::SAME_VALUE_DIFFERS.at(item.at.access, message);
        diagnostics.push(found.note_at(other.at.access, "the replacement"));
    }
}

/// Returns the differences between two descriptions of the same value.
fn differences(owner: Owner<'_>, one: &Item, other: &Item) -> Vec<String> {
    let mut found = Vec::new();
    let types = (owner.basic(one.ty), owner.basic(other.ty));
    // A shorter item contains only a part of the value, such as the low word. The limits and names of this part differ
    // from those of the whole value.
    if types.0.bits().zip(types.1.bits()).is_some_and(|(one, other)| one < other) {
        return found;
    }
    if types.0 != types.1 {
        found.push(format!("their types are {} and {}", types.0, types.1));
    }
    let limits = [("minimum", &one.limits.low, &other.limits.low), ("maximum", &one.limits.high, &other.limits.high)];
    for (limit, one, other) in limits {
        if let (Some(one), Some(other)) = (one, other) {
            if one.as_real().is_some() && one.as_real() != other.as_real() {
                found.push(format!("their {limit} values are {one} and {other}"));
            }
        }
    }
    if let (Some(one), Some(other)) = (stated::definition(owner, one), stated::definition(owner, other)) {
        found.extend(meanings(&one.shape, &other.shape));
        found.extend(names(&one.shape, &other.shape));
    }
    if let (Some(one), Some(other)) = (stated::quantity(one), stated::quantity(other)) {
        found.extend(quantities(one, other));
    }
    found
}

/// Returns the differences between the units and scales of two items.
fn quantities(one: &Quantity, other: &Quantity) -> Vec<String> {
    let mut found = Vec::new();
    if !one.unit.is_empty() && !other.unit.is_empty() && one.unit != other.unit {
        found.push(format!("their units are {} and {}", brief(&one.unit), brief(&other.unit)));
    }
    if one.scale != other.scale {
        let factor = |scale: &Option<Scale>| match scale {
            None => Some(1.0),
            Some(Scale::Linear { factor, .. }) => Some(*factor),
            Some(_) => None,
        };
        found.push(match (factor(&one.scale), factor(&other.scale)) {
            (Some(one), Some(other)) if one != other => format!("their scale factors are {one} and {other}"),
            _ => "their scales differ".to_owned(),
        });
    }
    found
}

/// Returns a text about the first values or bits whose names differ between the two types, with the number of further
/// differences.
fn names(one: &Shape, other: &Shape) -> Option<String> {
    let what = match one {
        Shape::BitField { .. } => "bit",
        _ => "value",
    };
    let (one, other) = (labels(one), labels(other));
    let differing = one.iter().filter_map(|(values, names)| {
        let others = other.get(values).filter(|others| !others.keys().eq(names.keys()))?;
        Some((*values, (*names.values().next()?, *others.values().next()?)))
    });
    let differing = joined(differing);
    let ((values, (one, other)), others) = differing.split_first()?;
    let more = more(others.len(), |more| format!(" ({})", count_of(more, "more difference")));
    let named = numbered(what, &[range(values)]);
    Some(format!("the names of {named} are `{}` and `{}`{more}", brief(one), brief(other)))
}

/// Joins adjacent ranges of values or bits that have equal data.
fn joined<T: PartialEq>(ranges: impl Iterator<Item = ((i128, i128), T)>) -> Vec<((i128, i128), T)> {
    let mut joined: Vec<((i128, i128), T)> = Vec::new();
    for ((first, last), data) in ranges {
        match joined.last_mut() {
            Some((before, same)) if before.1 + 1 == first && *same == data => before.1 = last,
            _ => joined.push(((first, last), data)),
        }
    }
    joined
}

type Labels<'n> = BTreeMap<(i128, i128), BTreeMap<String, &'n str>>;

/// Returns the names of values by range, or the names of single bits. The inner key is the name in lower case without
/// spaces and punctuation.
fn labels(shape: &Shape) -> Labels<'_> {
    let mut labels = Labels::new();
    fn add<'n>(labels: &mut Labels<'n>, values: (i128, i128), name: &'n str) {
        let plain = name.chars().filter(|c| c.is_alphanumeric()).flat_map(char::to_lowercase).collect();
        labels.entry(values).or_default().insert(plain, name);
    }
    match shape {
        Shape::Enumeration { values, .. } => {
            for value in values.iter().filter(|value| value.is_named()) {
                add(&mut labels, value.range(), &value.name);
            }
        }
        Shape::BitField { fields, .. } => {
            for field in fields.iter().filter(|field| !field.is_reserved()) {
                let first = i128::from(field.offset);
                for bit in first..first + i128::from(field.bits.max(1)) {
                    add(&mut labels, (bit, bit), &field.name);
                }
            }
        }
        _ => {}
    }
    labels
}

/// Returns a text about the values or bits that only one of two types names, or about types of different kinds.
fn meanings(one: &Shape, other: &Shape) -> Option<String> {
    let (what, one, other) = match (one, other) {
        (Shape::Enumeration { .. }, Shape::Enumeration { .. }) => ("value", named(one), named(other)),
        (Shape::BitField { .. }, Shape::BitField { .. }) => ("bit", named(one), named(other)),
        _ => return Some("one is an enumeration and the other is a bit field".to_owned()),
    };
    let only = joined(one.symmetric_difference(&other).map(|&values| (values, ())));
    let only: Vec<String> = only.iter().map(|(values, _)| range(values)).collect();
    (!only.is_empty()).then(|| format!("only one of them has names for {}", numbered(what, &only)))
}

fn range(values: &(i128, i128)) -> String {
    number::range(values.0, values.1, |number| number.to_string())
}

/// Returns the ranges of values, or the single bits, that have a name.
fn named(shape: &Shape) -> BTreeSet<(i128, i128)> {
    labels(shape).into_keys().collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ir::{Binding, BitFieldEntry, BitMeaning, Type, Value};

    #[test]
    fn type_and_limits_are_compared() {
        let item = |ty, low, high| {
            let mut item = Item::new(Binding::canopen(0x2000, 0));
            item.ty = ty;
            (item.limits.low, item.limits.high) = (Some(Value::Int(low)), Some(Value::Int(high)));
            item
        };
        let owner = Owner { types: &[], groups: &[] };
        let one = item(Type::Integer(32), 0, 200_000);
        assert_eq!(differences(owner, &one, &one), [""; 0]);
        assert_eq!(
            differences(owner, &one, &item(Type::Unsigned(32), 0, 500_000)),
            ["their types are INTEGER32 and UNSIGNED32", "their maximum values are 200000 and 500000"]
        );
        let half = item(Type::Unsigned(16), 0, 65_535);
        assert_eq!(differences(owner, &half, &one), [""; 0]);
        assert_eq!(differences(owner, &one, &half)[0], "their types are INTEGER32 and UNSIGNED16");
    }

    #[test]
    fn bits_are_compared_one_by_one() {
        let field = |name: &str, offset, bits| {
            BitFieldEntry::new(name.into(), offset, bits, BitMeaning::Flag { inverted: false })
        };
        let one = Shape::BitField { base: Type::Unsigned(16), fields: vec![field("edge", 2, 1)] };
        let fields = vec![field("edge", 2, 2), field("fault", 5, 1)];
        let other = Shape::BitField { base: Type::Unsigned(16), fields };
        assert_eq!(meanings(&one, &other).as_deref(), Some("only one of them has names for bits 3, 5"));
        assert_eq!(names(&one, &other), None);
    }
}
