//! Reads the default value, limits, allowed values and fixed value of a row, and reports contradictions between them.

use super::at::{At, Literal, OneOrMany};
use super::format::Row;
use super::rows::{Named, Rows};
use super::tree::Reader;
use super::{lints, value};
use crate::diagnostics::codes;
use crate::ir::{excluded, Access, Item, Limits, Shape, Type, TypeId, Value};
use crate::source::Span;

impl Rows {
    /// Adds the default value, limits, allowed values and fixed value of a row to its item.
    pub(super) fn values(&self, reader: &mut Reader<'_, '_>, item: &mut Item, named: Named<'_>, row: &Row) {
        let (base, count) = self.element(item.ty);
        let mut row_limits = Limits::default();
        if let Some(low) = &row.min {
            row_limits.low = Some(value::value(reader, low, base));
            (item.limits.low, item.at.others.low) = (row_limits.low.clone(), reader.span(low));
        }
        if let Some(high) = &row.max {
            row_limits.high = Some(value::value(reader, high, base));
            (item.limits.high, item.at.others.high) = (row_limits.high.clone(), reader.span(high));
        }
        allowed(reader, item, row, base, &mut row_limits);
        match (&row.default, count) {
            (Some(given), Some(count)) if given.value.0.len() > 1 => {
                elements(reader, item, given, base, count, &row_limits)
            }
            (Some(given), _) => default(reader, item, named, given, base),
            (None, _) => {}
        }
        writable(reader, row, base, &row_limits);
        if let Some(fixed) = &row.fixed {
            self::fixed(reader, item, fixed, row, base, &row_limits);
            if row.access.is_none() {
                item.access = Access::Constant;
            }
        }
    }

    /// Returns the basic type of a value or array element, and the number of elements if the type is an array.
    fn element(&self, ty: Type) -> (Type, Option<u32>) {
        let base = self.definitions.underlying(ty);
        let Type::Named(TypeId(id)) = base else { return (base, None) };
        match self.definitions.types.get(id as usize).map(|definition| &definition.shape) {
            Some(Shape::Array { element, dimensions }) => {
                (self.definitions.underlying(*element), dimensions.first().map(|(_, count)| *count))
            }
            _ => (base, None),
        }
    }
}

/// Reports a value that contradicts other facts of its row.
fn exclude(reader: &mut Reader<'_, '_>, span: Span, message: String) {
    reader.diagnostics.push(codes::DEFAULT_OUT_OF_LIMITS.at(span, message).help(
        "keep the value that the manual's text supports, and add a `doubt`, because one of the values is misprinted",
    ));
}

/// Reads the default value of a row, or the element for this item in a list of default values.
fn default(reader: &mut Reader<'_, '_>, item: &mut Item, named: Named<'_>, given: &At<OneOrMany<Literal>>, base: Type) {
    let list = &given.value.0;
    let at = if list.len() > 1 { named.number as usize } else { 0 };
    let Some(literal) = list.get(at) else {
        let message = format!("the list has {} defaults, but none for item {}", list.len(), named.number + 1);
        reader.report(&codes::TABLE_VALUE, reader.span(given), message);
        return;
    };
    let (start, end) = reader.element_range(list.len(), at, (given.start, given.end));
    let literal = At { value: literal.clone(), start, end };
    item.default = Some(value::value(reader, &literal, base));
    item.at.default = reader.span(&literal);
}

/// Reads the default values of an array, one for each element. The item stores only the first default value.
fn elements(
    reader: &mut Reader<'_, '_>,
    item: &mut Item,
    given: &At<OneOrMany<Literal>>,
    base: Type,
    count: u32,
    limits: &Limits,
) {
    let (list, span) = (&given.value.0, reader.span(given));
    if list.len() != count as usize {
        let message = format!("the list has {} defaults, but the array has {count} elements", list.len());
        reader.report(&codes::TABLE_VALUE, span, message);
        return;
    }
    let each = reader.each(list, (given.start, given.end));
    let values: Vec<Value> = each.iter().map(|literal| value::value(reader, literal, base)).collect();
    // The first value is checked later, as the default value of the item.
    for ((value, given), number) in values.iter().zip(&each).zip(1..).skip(1) {
        if let Some(reason) = excluded(limits, value) {
            exclude(reader, reader.span(given), format!("the default {value} of element {number} is {reason}"));
            break;
        }
    }
    item.default = values.into_iter().next();
    item.at.default = span;
}

/// Reads the allowed values. Reports values outside of the range of the type, and the first value that the minimum or
/// maximum of the row excludes.
fn allowed(reader: &mut Reader<'_, '_>, item: &mut Item, row: &Row, base: Type, limits: &mut Limits) {
    let Some(given) = &row.allowed else { return };
    let span = reader.span(given);
    let ranges = value::ranges(reader, &given.value, (given.start, given.end), base);
    for (first, last) in &ranges {
        lints::range(reader, first, base, span);
        if last != first {
            lints::range(reader, last, base, span);
        }
    }
    let wrong = |value: &Value| Some(format!("the allowed value {value} is {}", excluded(limits, value)?));
    if let Some(message) = ranges.iter().find_map(|(first, last)| wrong(first).or_else(|| wrong(last))) {
        exclude(reader, span, message);
    }
    limits.allowed = ranges;
    item.limits.allowed.clone_from(&limits.allowed);
}

/// Reports writable values that the type, the limits or the allowed values exclude.
fn writable(reader: &mut Reader<'_, '_>, row: &Row, base: Type, limits: &Limits) {
    let Some(given) = &row.writable else { return };
    for literal in reader.each(&given.value, (given.start, given.end)) {
        // Invalid values are reported later, when the item stores the list.
        let Some((first, last)) = value::range(reader, &literal, base) else { continue };
        let is_one = first == last;
        for value in [Some(first), Some(last).filter(|_| !is_one)].into_iter().flatten() {
            lints::range(reader, &value, base, reader.span(&literal));
            if let Some(reason) = excluded(limits, &value) {
                exclude(reader, reader.span(&literal), format!("the writable value {value} is {reason}"));
            }
        }
    }
}

/// Reads the fixed value, which sets the default value and both limits. Reports a fixed value that the limits of the
/// row exclude, and a default value that differs from the fixed value.
fn fixed(reader: &mut Reader<'_, '_>, item: &mut Item, given: &At<Literal>, row: &Row, base: Type, limits: &Limits) {
    let (value, span) = (value::value(reader, given, base), reader.span(given));
    if let Some(reason) = excluded(limits, &value) {
        exclude(reader, span, format!("the fixed value {value} is {reason}"));
    }
    let default = item.default.as_ref().filter(|_| row.default.is_some());
    if let Some(default) = default.filter(|default| **default != value) {
        let message = format!("the default {default} differs from the fixed value {value}");
        exclude(reader, item.at.default, message);
    }
    (item.limits.low, item.limits.high) = (Some(value.clone()), Some(value.clone()));
    (item.default, item.at.default) = (Some(value), span);
}
