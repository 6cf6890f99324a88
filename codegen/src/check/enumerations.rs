//! Enumerations and code tables: values outside of the type, and overlapping values.

use super::context::Context;
use crate::diagnostics::{codes, Diagnostic, Diagnostics};
use crate::ir::firmware::apart;
use crate::ir::owner::{Owner, TypeUses};
use crate::ir::{stated, CodeRow, EnumValue, Shape, Type, TypeDef};
use crate::source::Span;
use crate::text::{brief, count_of};

pub(super) fn check(owner: Owner<'_>, diagnostics: &mut Diagnostics) {
    let uses = TypeUses::new(owner);
    for (id, definition) in stated::types(owner.types) {
        let Shape::Enumeration { base, values, .. } = &definition.shape else { continue };
        if let Some(found) = outside(definition, *base, values, || uses.first(id)) {
            diagnostics.push(found);
        }
        let mut sorted: Vec<&EnumValue> = values.iter().collect();
        sorted.sort_by_key(|value| value.value);
        let are_distinct =
            |one: &EnumValue, other: &EnumValue| apart(one.availability.as_deref(), other.availability.as_deref());
        if let Some((one, other)) = overlap(&sorted, EnumValue::range, are_distinct) {
            let names = [one, other].map(|value| (value.numbers(), value.name.as_str()));
            report(&definition.name, other.at.0.or(definition.origin.span), names, diagnostics);
        }
    }
}

/// Reports the first two overlapping codes of each code table.
pub(super) fn code_tables(context: &Context<'_>, diagnostics: &mut Diagnostics) {
    for table in stated::code_tables(context.device) {
        let mut sorted: Vec<_> = table.rows.iter().collect();
        sorted.sort_by_key(|row| row.code);
        let range = |row: &CodeRow| (row.code, row.last.unwrap_or(row.code));
        // A narrow range within a wide range is a special case, and not an overlap.
        let is_within = |inner: (i128, i128), outer: (i128, i128)| outer.0 <= inner.0 && inner.1 <= outer.1;
        let narrower = |one: &CodeRow, other: &CodeRow| {
            let (one, other) = (range(one), range(other));
            one != other && (is_within(one, other) || is_within(other, one))
        };
        if let Some((one, other)) = overlap(&sorted, range, narrower) {
            let names = [one, other].map(|row| (row.printed_code(), row.name.as_str()));
            report(&table.name, table.origin.span, names, diagnostics);
        }
    }
}

/// Returns the first two elements of a sorted list whose ranges overlap and for which `are_distinct` is false.
fn overlap<'v, V>(
    sorted: &[&'v V],
    range: impl Fn(&V) -> (i128, i128),
    are_distinct: impl Fn(&V, &V) -> bool,
) -> Option<(&'v V, &'v V)> {
    sorted.iter().enumerate().find_map(|(at, one)| {
        let last = range(one).1;
        let mut later = sorted.iter().skip(at + 1).take_while(|other| range(other).0 <= last);
        later.find(|other| !are_distinct(one, other)).map(|other| (*one, *other))
    })
}

/// Reports two elements whose ranges overlap. `names` contains the number and the name of each element.
fn report(owner: &str, span: Span, names: [(String, &str); 2], diagnostics: &mut Diagnostics) {
    let problem = if names[0].0 == names[1].0 { "have the same value" } else { "overlap" };
    let [one, other] = names.map(|(number, name)| format!("`{}` ({number})", brief(name)));
    let message = format!("{one} and {other} of `{}` {problem}", brief(owner));
    diagnostics.push(codes::VALUE_NAMED_TWICE.at(span, message));
}

/// Returns a diagnostic if enumeration values are outside of the underlying integer. `used` returns the first use of
/// the type.
fn outside(definition: &TypeDef, base: Type, values: &[EnumValue], used: impl FnOnce() -> Span) -> Option<Diagnostic> {
    let (low, high) = base.integer_range()?;
    let mut beyond = values.iter().filter(|value| value.value < low || value.range().1 > high);
    let first = beyond.next()?;
    let others = match beyond.count() {
        0 => " is".to_owned(),
        others => format!(" and {} are", count_of(others, "other value")),
    };
    let value = if first.value < low { first.value } else { first.range().1 };
    let message = format!("the value {value} (`{}`){others} outside of the range of {base}", brief(&first.name));
    let found = codes::NAME_OUTSIDE_TYPE.at(used(), message);
    let found = found.note_at(first.at.0.or(definition.origin.span), "definition of the value");
    Some(match (base, value) {
        (Type::Unsigned(_), ..0) => found.help("use a signed type, or correct the value"),
        _ => found.help("use a longer type, or correct the value"),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn value(name: &str, first: i128, last: Option<i128>) -> EnumValue {
        EnumValue { last, ..EnumValue::new(name.into(), first) }
    }

    fn found(base: Type, values: Vec<EnumValue>) -> Vec<String> {
        let mut diagnostics = Diagnostics::default();
        let definition = TypeDef::new("Mode", Shape::Enumeration { base, values, closed: false }, base.bits());
        check(Owner { types: &[definition], groups: &[] }, &mut diagnostics);
        diagnostics.list().iter().map(|found| found.message.clone()).collect()
    }

    #[test]
    fn values_outside_of_the_type_and_overlaps_are_reported() {
        let good = vec![value("off", 0, None), value("on", 1, None), value("reserved", 2, Some(255))];
        assert_eq!(found(Type::Unsigned(8), good), [""; 0]);
        let twice = vec![value("reserved", 8, Some(127)), value("off", 0, None), value("csv", 9, None)];
        assert_eq!(found(Type::Unsigned(8), twice), ["`reserved` (8 to 127) and `csv` (9) of `Mode` overlap"]);
        let beyond = vec![value("back", -1, None), value("far", 256, None)];
        assert_eq!(
            found(Type::Unsigned(8), beyond),
            ["the value -1 (`back`) and 1 other value are outside of the range of UNSIGNED8"]
        );
    }
}
