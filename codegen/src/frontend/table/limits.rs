//! Default, limits and only values of a row, and what of them excludes the others.

use super::at::{At, Literal, OneOrMany};
use super::format::Row;
use super::rows::{Named, Rows};
use super::tree::Reader;
use super::{lints, value};
use crate::diagnostics::{codes, Diagnostic};
use crate::ir::{excluded, Access, Item, Limits, Shape, Type, TypeId, Value};
use crate::source::Span;

impl Rows {
    /// Puts what a row says of its values into the item.
    pub(super) fn values(&self, reader: &mut Reader<'_, '_>, item: &mut Item, named: Named<'_>, row: &Row) {
        let (base, count) = self.element(item.ty);
        let mut own = Limits::default();
        if let Some(low) = &row.min {
            own.low = Some(value::value(reader, low, base));
            (item.limits.low, item.at.low) = (own.low.clone(), reader.span(low));
        }
        if let Some(high) = &row.max {
            own.high = Some(value::value(reader, high, base));
            (item.limits.high, item.at.high) = (own.high.clone(), reader.span(high));
        }
        allowed(reader, item, row, base, &mut own);
        match (&row.default, count) {
            (Some(given), Some(count)) if given.value.0.len() > 1 => elements(reader, item, given, (base, count), &own),
            (Some(given), _) => default(reader, item, named, given, base),
            (None, _) => {}
        }
        writable(reader, row, base, &own);
        if let Some(fixed) = &row.fixed {
            self::fixed(reader, item, (fixed, row), base, &own);
            if row.access.is_none() {
                item.access = Access::Constant;
            }
        }
    }

    /// The basic type of a value, and how many of it there are in an array.
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

/// Reports a value that the rest of its row excludes.
fn exclude(reader: &mut Reader<'_, '_>, span: Span, message: String) {
    let found = Diagnostic::new(&codes::DEFAULT_OUT_OF_LIMITS, span, message);
    reader
        .diagnostics
        .push(found.help("one of the two is misprinted: keep what the manual's text supports, with a `doubt`"));
}

/// The default of a row, or its share of a list.
fn default(reader: &mut Reader<'_, '_>, item: &mut Item, named: Named<'_>, given: &At<OneOrMany<Literal>>, base: Type) {
    let list = &given.value.0;
    let at = if list.len() > 1 { named.number as usize } else { 0 };
    let Some(own) = list.get(at) else {
        let message = format!("the list has {} defaults, and this is number {}", list.len(), named.number + 1);
        reader.report(&codes::TABLE_VALUE, reader.span(given), message);
        return;
    };
    let (start, end) = reader.place(list.len(), at, (given.start, given.end));
    let own = At { value: own.clone(), start, end };
    item.default = Some(value::value(reader, &own, base));
    item.at.default = reader.span(&own);
}

/// The defaults of an array, one for each element. The item keeps the first.
fn elements(
    reader: &mut Reader<'_, '_>,
    item: &mut Item,
    given: &At<OneOrMany<Literal>>,
    (base, count): (Type, u32),
    limits: &Limits,
) {
    let (list, span) = (&given.value.0, reader.span(given));
    if list.len() != count as usize {
        let message = format!("the list has {} defaults, and the array {count} elements", list.len());
        reader.report(&codes::TABLE_VALUE, span, message);
        return;
    }
    let each = reader.each(list, (given.start, given.end));
    let values: Vec<Value> = each.iter().map(|own| value::value(reader, own, base)).collect();
    // The first is the item's, and checked with it.
    for ((own, given), number) in values.iter().zip(&each).zip(1..).skip(1) {
        if let Some(reason) = excluded(limits, own) {
            exclude(reader, reader.span(given), format!("the default {own} of element {number} is {reason}"));
            break;
        }
    }
    item.default = values.into_iter().next();
    item.at.default = span;
}

/// The only values. Limits beside them don't exclude any.
fn allowed(reader: &mut Reader<'_, '_>, item: &mut Item, row: &Row, base: Type, limits: &mut Limits) {
    let Some(given) = &row.allowed else { return };
    let span = reader.span(given);
    let ranges = value::ranges(reader, (&given.value, (given.start, given.end)), base);
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

/// The values that may be written are among those that there are.
fn writable(reader: &mut Reader<'_, '_>, row: &Row, base: Type, limits: &Limits) {
    let Some(given) = &row.writable else { return };
    for own in reader.each(&given.value, (given.start, given.end)) {
        // What is no value is reported where the item gets them.
        let Some((first, last)) = value::range(reader, &own, base) else { continue };
        let is_one = first == last;
        for value in [Some(first), Some(last).filter(|_| !is_one)].into_iter().flatten() {
            lints::range(reader, &value, base, reader.span(&own));
            if let Some(reason) = excluded(limits, &value) {
                exclude(reader, reader.span(&own), format!("the value {value}, which may be written, is {reason}"));
            }
        }
    }
}

/// The only value is both limits and the default, and contradicts none that the row gives besides.
fn fixed(
    reader: &mut Reader<'_, '_>,
    item: &mut Item,
    (given, row): (&At<Literal>, &Row),
    base: Type,
    limits: &Limits,
) {
    let (value, span) = (value::value(reader, given, base), reader.span(given));
    if let Some(reason) = excluded(limits, &value) {
        exclude(reader, span, format!("the fixed value {value} is {reason}"));
    }
    let default = item.default.as_ref().filter(|_| row.default.is_some());
    if let Some(default) = default.filter(|default| **default != value) {
        let message = format!("the default {default} isn't the fixed value {value}");
        exclude(reader, item.at.default, message);
    }
    (item.limits.low, item.limits.high) = (Some(value.clone()), Some(value.clone()));
    (item.default, item.at.default) = (Some(value), span);
}
