//! Enumerations and bit fields: limits, default values, configured values and writable values that contradict the named
//! values and bits.

use super::bit_fields::{called, set_bits};
use crate::diagnostics::{codes, Code, Diagnostics};
use crate::ir::owner::{fixed, reserved, Owner};
use crate::ir::{stated, BitFieldEntry, BitMeaning, EnumValue, Item, Shape, Type, TypeDef, Value};
use crate::number::hex;
use crate::source::Span;
use crate::text::{brief, count_of, more};

/// Maximum number of values that the message of a diagnostic lists.
const MAX_LISTED: usize = 6;

pub(super) fn check(owner: Owner<'_>, diagnostics: &mut Diagnostics) {
    for item in owner.items() {
        let Some(definition) = stated::definition(owner, item) else { continue };
        let mut check = Check { owner, item, definition, diagnostics };
        match &definition.shape {
            Shape::Enumeration { base, values, closed } => check.enumeration(*base, values, *closed),
            Shape::BitField { base, fields } => check.bits(*base, fields),
            _ => {}
        }
    }
}

struct Check<'a, 'd> {
    owner: Owner<'a>,
    item: &'a Item,
    definition: &'a TypeDef,
    diagnostics: &'d mut Diagnostics,
}

/// A default value, limit or other integer of an item, with its noun for diagnostics.
#[derive(Clone, Copy)]
struct Number {
    what: &'static str,
    value: i128,
    span: Span,
}

impl Number {
    fn of(what: &'static str, value: Option<&Value>, span: Span) -> Option<Self> {
        Some(Number { what, value: value?.as_int()?, span })
    }
}

impl Check<'_, '_> {
    fn report(&mut self, code: &'static Code, span: Span, message: String) {
        let found = code.at(span.or(self.item.origin.span), message);
        let found = found.note_at(self.definition.origin.span, "definition of the names");
        self.diagnostics.push(found.help(match code.id {
            "TAB016" => "correct the limit, or define separate bits or values for the item",
            "TAB018" => "correct the number, or name the value if the manual does",
            _ => "correct the number, or name the bits if the manual does",
        }));
    }

    /// Returns the default value and the configured value of an item, if they are integers.
    fn values(&self) -> Vec<Number> {
        let (default, at) = (self.item.default.as_ref(), &self.item.at);
        let default = match fixed(self.item) {
            Some(_) => Number::of("fixed value", default, at.default.or(at.others.low)),
            None => Number::of("default", default, at.default),
        };
        let configured = Number::of("configured value", self.item.configured_value(), at.others.configured);
        default.into_iter().chain(configured).collect()
    }

    /// Returns the integer limits of an item. The list is empty if the minimum and the maximum are equal.
    fn limits(&self) -> Vec<Number> {
        if fixed(self.item).is_some() {
            return Vec::new();
        }
        let (limits, at) = (&self.item.limits, &self.item.at);
        let low = Number::of("minimum", limits.low.as_ref(), at.others.low);
        low.into_iter().chain(Number::of("maximum", limits.high.as_ref(), at.others.high)).collect()
    }

    fn enumeration(&mut self, base: Type, values: &[EnumValue], closed: bool) {
        for number in self.values() {
            self.named(values, closed, number);
        }
        let behavior = stated::behavior(self.item);
        for value in behavior.iter().flat_map(|behavior| &behavior.writable_values).filter_map(Value::as_int) {
            self.named(values, true, Number { what: "writable value", value, span: Span::default() });
        }
        for limit in self.limits() {
            let (value, is_upper) = (limit.value, limit.what == "maximum");
            self.within(values, is_upper, limit);
            if base.integer_range().is_some_and(|(low, high)| value == low || value == high) {
                continue;
            }
            // A limit just outside the named values is probably wrong. A limit far outside them probably means that values
            // without names are allowed.
            let named = || values.iter().filter(|label| label.is_named());
            let is_slip = match is_upper {
                true => named().any(|label| label.range().1 + 1 == value) && !named().any(|label| label.value > value),
                false => named().any(|label| label.value - 1 == value) && !named().any(|label| label.value < value),
            };
            self.named(values, closed || is_slip, limit);
        }
    }

    /// Reports a number that is reserved. `strict` means that numbers without a name are also reported.
    fn named(&mut self, values: &[EnumValue], strict: bool, number: Number) {
        let Number { what, value, span } = number;
        let name = brief(&self.definition.name);
        let message = match reserved(values, value) {
            Some(true) => format!("the {what} {value} is reserved in the enumeration `{name}`"),
            None if strict => format!("the {what} {value} has no name in the enumeration `{name}`"),
            _ => return,
        };
        self.report(&codes::UNNAMED_VALUE, span, message);
    }

    /// Reports a limit that excludes named values of the enumeration.
    fn within(&mut self, values: &[EnumValue], is_upper: bool, limit: Number) {
        let Number { what, value: limit, span } = limit;
        let extreme = |label: &EnumValue| if is_upper { label.range().1 } else { label.value };
        let is_beyond = |value: i128| if is_upper { value > limit } else { value < limit };
        let mut beyond = values.iter().filter(|label| label.is_named() && is_beyond(extreme(label)));
        let Some(first) = beyond.next() else { return };
        let others = more(beyond.count(), |others| format!(" and {}", count_of(others, "other value")));
        let message =
            format!("the {what} {limit} excludes the value {} (`{}`){others}", extreme(first), brief(&first.name));
        self.report(&codes::NAME_OUTSIDE_LIMITS, span, message);
    }

    fn bits(&mut self, base: Type, fields: &[BitFieldEntry]) {
        let Some(width) = base.bits().filter(|&bits| bits <= 64) else { return };
        let pattern = |value: i128| value as u64 & u64::MAX >> (64 - width.clamp(1, 64));
        for number in self.values() {
            let bits = pattern(number.value);
            self.meaningless(fields, number, bits);
            if bits != pattern(-1) {
                self.known(fields, number, bits);
            }
        }
        for limit in self.limits() {
            let bits = pattern(limit.value);
            if !is_count(bits, width, fields) && !base.is_signed() {
                self.meaningless(fields, limit, bits);
            }
            if limit.what == "maximum" && !base.is_signed() {
                self.reaches(fields, bits, limit.span);
            }
        }
    }

    /// Reports a value that sets reserved bits, or that clears reserved bits that must be 1. A limit may clear these
    /// bits.
    fn meaningless(&mut self, fields: &[BitFieldEntry], number: Number, bits: u64) {
        let Number { what, span, .. } = number;
        let is_limit = matches!(what, "minimum" | "maximum");
        for field in always(fields) {
            let BitMeaning::Reserved { write } = field.meaning else { continue };
            let (problem, wrong) = match write {
                Some(true) if !is_limit => ("clears", !bits & field.mask()),
                Some(false) | None => ("sets", bits & field.mask()),
                _ => continue,
            };
            if wrong == 0 {
                continue;
            }
            let (wrong, name) = (set_bits(wrong), brief(&self.definition.name));
            let message = format!("the {what} {} {problem} {wrong} (reserved) of `{name}`", hex(bits));
            self.report(&codes::RESERVED_BITS, span, message);
        }
    }

    /// Reports a value that sets unnamed bits, or that sets fields to unnamed or reserved values.
    fn known(&mut self, fields: &[BitFieldEntry], number: Number, bits: u64) {
        let Number { what, span, .. } = number;
        let named = fields.iter().fold(0, |all, field| all | field.mask());
        if bits & !named != 0 && named != 0 {
            let (unnamed, name) = (set_bits(bits & !named), brief(&self.definition.name));
            let message = format!("the {what} {} sets {unnamed} (unnamed) of `{name}`", hex(bits));
            self.report(&codes::RESERVED_BITS, span, message);
        }
        for field in always(fields) {
            let BitMeaning::Enumeration(id) = field.meaning else { continue };
            let Some((values, _)) = self.owner.enumeration(Type::Named(id)) else { continue };
            let value = i128::from((bits & field.mask()).checked_shr(field.offset.into()).unwrap_or(0));
            let problem = match reserved(values, value) {
                _ if values.is_empty() => continue,
                Some(false) => continue,
                Some(true) => "which is reserved".to_owned(),
                None => format!("but only {} named", listed(values)),
            };
            let message = format!("the {what} {} sets {} to {value}, {problem}", hex(bits), called(field));
            self.report(&codes::UNNAMED_VALUE, span, message);
        }
    }

    /// Reports a maximum that excludes named bits.
    fn reaches(&mut self, fields: &[BitFieldEntry], limit: u64, span: Span) {
        let is_beyond = |field: &&BitFieldEntry| 1u64.checked_shl(field.offset.into()) > Some(limit);
        let mut beyond = fields.iter().filter(|field| !field.is_reserved()).filter(is_beyond);
        let Some(first) = beyond.next() else { return };
        let others = more(beyond.count(), |others| format!(" and {}", count_of(others, "other field")));
        let message = format!("the maximum {limit} excludes {}{others}", called(first));
        self.report(&codes::NAME_OUTSIDE_LIMITS, span, message);
    }
}

/// Returns the fields whose meaning depends on no condition, and that exist on all models and firmware versions.
fn always(fields: &[BitFieldEntry]) -> impl Iterator<Item = &BitFieldEntry> {
    fields.iter().filter(|field| field.when.is_none() && field.availability.is_none())
}

/// Returns the named values with a verb: `the value 1 is`, `the values 0, 1 and 3 are`. More than [`MAX_LISTED`] values are only
/// counted: `9 other values are`.
fn listed(values: &[EnumValue]) -> String {
    let named: Vec<String> = values.iter().filter(|value| value.is_named()).map(EnumValue::numbers).collect();
    match named.as_slice() {
        [] => "reserved values are".to_owned(),
        [one] => format!("the value {one} is"),
        [.., _] if named.len() > MAX_LISTED => format!("{} other values are", named.len()),
        [first @ .., last] => format!("the values {} and {last} are", first.join(", ")),
    }
}

/// Returns whether a limit is the bound of a range, and not a mask of the allowed bits. In such a limit, at most one bit is 1, or
/// all bits up to the last bit of the type or the last named bit are 1.
fn is_count(bits: u64, width: u32, fields: &[BitFieldEntry]) -> bool {
    if bits & bits.wrapping_add(1) != 0 {
        return bits.is_power_of_two();
    }
    let last = fields.iter().filter(|field| !field.is_reserved()).map(BitFieldEntry::end).max();
    bits.count_ones() <= 1 || bits.count_ones() == width || Some(bits.count_ones()) == last
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ir::{Binding, Group, ObjectCode, TypeId, Zone};
    use crate::source::{FileId, Origin};

    fn found(shape: Shape, item: impl FnOnce(&mut Item)) -> Vec<(&'static str, String)> {
        let mut group = Group::object(0x2000, ObjectCode::Var);
        let mut mode = Item::new(Binding::canopen(0x2000, 0));
        mode.ty = Type::Named(TypeId(0));
        item(&mut mode);
        group.items.push(mode);
        let definition = TypeDef {
            origin: Origin { span: Span::new(FileId(0), 0, 4), line: 1 },
            ..TypeDef::new("Mode", shape, None)
        };
        let mut diagnostics = Diagnostics::default();
        check(Owner { types: &[definition], groups: &[&[group]] }, &mut diagnostics);
        diagnostics.list().iter().map(|found| (found.code.id, found.message.clone())).collect()
    }

    fn modes(closed: bool) -> Shape {
        let mut reserved = EnumValue::new("reserved".into(), 8);
        (reserved.last, reserved.zone) = (Some(127), Some(Zone::Reserved));
        let values = vec![EnumValue::new("off".into(), 0), EnumValue::new("on".into(), 1), reserved];
        Shape::Enumeration { base: Type::Unsigned(8), values, closed }
    }

    fn limits(low: i128, high: i128) -> impl FnOnce(&mut Item) {
        move |item| (item.limits.low, item.limits.high) = (Some(Value::Int(low)), Some(Value::Int(high)))
    }

    #[test]
    fn limits_of_enumerations() {
        assert_eq!(found(modes(false), limits(0, 1)), []);
        assert_eq!(found(modes(false), limits(0, 255)), []);
        assert_eq!(found(modes(false), limits(0, 5)), []);
        let is = |found: Vec<(&'static str, String)>, code, message: &str| {
            assert_eq!(found, [(code, message.to_owned())]);
        };
        is(found(modes(false), limits(0, 2)), "TAB018", "the maximum 2 has no name in the enumeration `Mode`");
        is(found(modes(true), limits(0, 5)), "TAB018", "the maximum 5 has no name in the enumeration `Mode`");
        is(found(modes(false), limits(0, 8)), "TAB018", "the maximum 8 is reserved in the enumeration `Mode`");
        is(found(modes(false), limits(0, 0x7F)), "TAB018", "the maximum 127 is reserved in the enumeration `Mode`");
        let one = found(modes(false), limits(1, 200));
        is(one, "TAB016", "the minimum 1 excludes the value 0 (`off`)");
        let default = |value| move |item: &mut Item| item.default = Some(Value::Int(value));
        assert_eq!(found(modes(false), default(3)), []);
        is(found(modes(true), default(3)), "TAB018", "the default 3 has no name in the enumeration `Mode`");
        is(found(modes(false), default(9)), "TAB018", "the default 9 is reserved in the enumeration `Mode`");
    }

    #[test]
    fn limits_and_constants_of_bits() {
        let field = |name: &str, offset, bits, meaning| BitFieldEntry::new(name.into(), offset, bits, meaning);
        let flags = || Shape::BitField {
            base: Type::Unsigned(16),
            fields: vec![
                field("ready", 0, 1, BitMeaning::Flag { inverted: false }),
                field("", 3, 5, BitMeaning::Reserved { write: None }),
                field("", 8, 1, BitMeaning::Reserved { write: Some(true) }),
                field("error", 15, 1, BitMeaning::Flag { inverted: false }),
            ],
        };
        assert_eq!(found(flags(), limits(0, 0xFFFF)), []);
        let max = found(flags(), limits(0, 0x4000));
        assert_eq!(max, [("TAB016", "the maximum 16384 excludes bit 15 (`error`)".to_owned())]);
        let holes = found(flags(), limits(0, 0xF0F7));
        assert_eq!(holes, [("TAB019", "the maximum 0xF0F7 sets bits 7-4 (reserved) of `Mode`".to_owned())]);
        let constant = found(flags(), |item| {
            limits(0x0005, 0x0005)(item);
            item.default = Some(Value::Int(5));
        });
        let expected = [
            ("TAB019", "the fixed value 0x5 clears bit 8 (reserved) of `Mode`".to_owned()),
            ("TAB019", "the fixed value 0x5 sets bit 2 (unnamed) of `Mode`".to_owned()),
        ];
        assert_eq!(constant, expected);
    }
}
