//! Limits and defaults of enumerations and bit fields against the values and bits that have a meaning.

use super::bit_fields::called;
use crate::diagnostics::{codes, Code, Diagnostic, Diagnostics};
use crate::ir::owner::{fixed, reserved, Owner};
use crate::ir::{BitFieldEntry, BitMeaning, EnumValue, Item, Shape, Type, TypeDef, Value};
use crate::source::Span;
use crate::text::brief;

/// So many values are listed in a message.
const MAX_LISTED: usize = 6;

pub(super) fn check(owner: Owner<'_>, diagnostics: &mut Diagnostics) {
    for item in owner.items() {
        // What a profile says fits more devices than this one.
        let own = |definition: &&TypeDef| !definition.origin.span.is_empty();
        let Some(definition) = owner.definition(item.ty).filter(own) else { continue };
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

/// A number of an item: what it is, its value, and where it stands.
type Number = (&'static str, i128, Span);

impl Check<'_, '_> {
    fn report(&mut self, code: &'static Code, span: Span, message: String) {
        let found = Diagnostic::new(code, span.or(self.item.origin.span), message);
        let found = found.note_at(self.definition.origin.span, "the names are given here");
        self.diagnostics.push(found.help(match code.id {
            "TAB016" => "widen the limit, or give the item an enumeration or bits of its own",
            "TAB018" => "name the value, if the manual does, or correct the number",
            _ => "correct the number, or name the bits, if the manual does",
        }));
    }

    /// The default, and what is set for one device.
    fn values(&self) -> Vec<Number> {
        let configured = self.item.configured.as_ref().and_then(|configured| configured.value.as_ref());
        let (what, at) = match fixed(self.item) {
            Some(_) => ("fixed value", self.item.at.default.or(self.item.at.low)),
            None => ("default", self.item.at.default),
        };
        let numbers = [(what, self.item.default.as_ref(), at), ("value", configured, self.item.at.configured)];
        numbers.into_iter().filter_map(|(what, value, span)| Some((what, value?.as_int()?, span))).collect()
    }

    /// The lower and the upper limit, where they differ.
    fn limits(&self) -> Vec<Number> {
        if fixed(self.item).is_some() {
            return Vec::new();
        }
        let limits = &self.item.limits;
        let numbers = [
            ("lower limit", limits.low.as_ref(), self.item.at.low),
            ("upper limit", limits.high.as_ref(), self.item.at.high),
        ];
        numbers
            .into_iter()
            .filter_map(|(what, value, span)| Some((what, value.and_then(Value::as_int)?, span)))
            .collect()
    }

    fn enumeration(&mut self, base: Type, values: &[EnumValue], closed: bool) {
        for (what, value, span) in self.values() {
            self.named(values, closed, (what, value, span));
        }
        let behaviour = self.item.behaviour.as_deref();
        for value in behaviour.iter().flat_map(|own| &own.writable_values).filter_map(Value::as_int) {
            self.named(values, true, ("writable value", value, Span::default()));
        }
        let extremes = base.integer_range();
        for (what, value, span) in self.limits() {
            let is_upper = what == "upper limit";
            self.within(values, is_upper, value, span);
            if extremes.is_some_and(|(low, high)| value == low || value == high) {
                continue;
            }
            // A limit that is one off the last name is a slip; one far from it leaves room.
            let is_next = |label: &EnumValue| {
                let named = label.zone.is_none();
                named
                    && if is_upper { label.last.unwrap_or(label.value) + 1 == value } else { label.value - 1 == value }
            };
            let beyond = |label: &EnumValue| {
                label.zone.is_none() && if is_upper { label.value > value } else { label.value < value }
            };
            let is_slip = values.iter().any(is_next) && !values.iter().any(beyond);
            self.named(values, closed || is_slip, (what, value, span));
        }
    }

    /// Whether a number has a name that may be used. `strict`: it has to have one.
    fn named(&mut self, values: &[EnumValue], strict: bool, (what, value, span): Number) {
        let name = brief(&self.definition.name).to_owned();
        let message = match reserved(values, value) {
            Some(true) => format!("the {what} {value} is reserved in `{name}`"),
            None if strict => format!("the {what} {value} has no name in `{name}`"),
            _ => return,
        };
        self.report(&codes::UNNAMED_VALUE, span, message);
    }

    /// Whether the limit leaves out values that have a name.
    fn within(&mut self, values: &[EnumValue], is_upper: bool, limit: i128, span: Span) {
        let is_beyond = |label: &&EnumValue| {
            let beyond = if is_upper { label.last.unwrap_or(label.value) > limit } else { label.value < limit };
            label.zone.is_none() && beyond
        };
        let mut beyond = values.iter().filter(is_beyond);
        let Some(first) = beyond.next() else { return };
        let others = match beyond.count() {
            0 => String::new(),
            others => format!(", and so are {others} more"),
        };
        let side = if is_upper { "above the upper" } else { "below the lower" };
        let value = if is_upper { first.last.unwrap_or(first.value) } else { first.value };
        let message = format!("`{}` is {value}, {side} limit {limit}{others}", brief(&first.name));
        self.report(&codes::NAME_OUTSIDE_LIMITS, span, message);
    }

    fn bits(&mut self, base: Type, fields: &[BitFieldEntry]) {
        let Some(width) = base.bits().filter(|&bits| bits <= 64) else { return };
        let pattern = |value: i128| value as u64 & u64::MAX >> (64 - width.clamp(1, 64));
        for (what, value, span) in self.values() {
            self.meaningless(fields, (what, value, span), pattern(value));
            if pattern(value) != pattern(-1) {
                self.known(fields, what, pattern(value), span);
            }
        }
        for (what, value, span) in self.limits() {
            let bits = pattern(value);
            if !is_count(bits, width, fields) && !base.is_signed() {
                self.meaningless(fields, (what, value, span), bits);
            }
            if what == "upper limit" && !base.is_signed() {
                self.reaches(fields, bits, span);
            }
        }
    }

    /// Whether a value sets bits that mean nothing, or lacks some that are always set.
    fn meaningless(&mut self, fields: &[BitFieldEntry], (what, _, span): Number, bits: u64) {
        let always = fields.iter().filter(|field| field.when.is_none() && field.availability.is_none());
        for field in always {
            let BitMeaning::Reserved { write } = field.meaning else { continue };
            let problem = match write {
                Some(true) if !what.ends_with("limit") && bits & field.mask() != field.mask() => "lacks",
                Some(false) | None if bits & field.mask() != 0 => "sets",
                _ => continue,
            };
            let named = called(field);
            let message = format!("the {what} {bits:#X} {problem} {named} of `{}`", brief(&self.definition.name));
            self.report(&codes::RESERVED_BITS, span, message);
        }
    }

    /// Whether every bit that a value sets has a meaning, and every field of it a value that has a name.
    fn known(&mut self, fields: &[BitFieldEntry], what: &str, bits: u64, span: Span) {
        let named = fields.iter().fold(0, |all, field| all | field.mask());
        let name = brief(&self.definition.name).to_owned();
        if bits & !named != 0 && named != 0 {
            let message = format!("the {what} {bits:#X} sets bits {:#X}, which `{name}` doesn't name", bits & !named);
            self.report(&codes::RESERVED_BITS, span, message);
        }
        for field in fields.iter().filter(|field| field.when.is_none() && field.availability.is_none()) {
            let BitMeaning::Enumeration(id) = field.meaning else { continue };
            let Some((values, _)) = self.owner.enumeration(Type::Named(id)) else { continue };
            let value = i128::from((bits & field.mask()).checked_shr(field.offset.into()).unwrap_or(0));
            if !values.is_empty() && reserved(values, value) != Some(false) {
                let what = format!("the {what} {bits:#X} has {value} in {}", called(field));
                let message = match reserved(values, value) {
                    Some(_) => format!("{what}, which is reserved"),
                    None => format!("{what}, where only {} named", listed(values)),
                };
                self.report(&codes::UNNAMED_VALUE, span, message);
            }
        }
    }

    /// Whether an upper limit lets every named bit be set.
    fn reaches(&mut self, fields: &[BitFieldEntry], limit: u64, span: Span) {
        let is_beyond = |field: &&BitFieldEntry| {
            !matches!(field.meaning, BitMeaning::Reserved { .. }) && 1u64.checked_shl(field.offset.into()) > Some(limit)
        };
        let mut beyond = fields.iter().filter(is_beyond);
        let Some(first) = beyond.next() else { return };
        let others = match beyond.count() {
            0 => String::new(),
            others => format!(", and neither can {others} more"),
        };
        let message = format!("{} can't be set below the upper limit {limit}{others}", called(first));
        self.report(&codes::NAME_OUTSIDE_LIMITS, span, message);
    }
}

/// The values that have names: `1 is`, `0, 1 and 3 are`.
fn listed(values: &[EnumValue]) -> String {
    let named: Vec<String> = values.iter().filter(|value| value.zone.is_none()).map(range).collect();
    match named.as_slice() {
        [] => "reserved values are".to_owned(),
        [one] => format!("{one} is"),
        [.., _] if named.len() > MAX_LISTED => format!("{} other values are", named.len()),
        [first @ .., last] => format!("{} and {last} are", first.join(", ")),
    }
}

fn range(value: &EnumValue) -> String {
    match value.last {
        Some(last) => format!("{} to {last}", value.value),
        None => value.value.to_string(),
    }
}

/// Whether a limit says how many bits there are, and not which: it is one bit, or all up to the end of the type or the last
/// bit that has a name.
fn is_count(bits: u64, width: u32, fields: &[BitFieldEntry]) -> bool {
    if bits & bits.wrapping_add(1) != 0 {
        return bits.is_power_of_two();
    }
    let named = fields.iter().filter(|field| !matches!(field.meaning, BitMeaning::Reserved { .. }));
    let last = named.map(|field| u32::from(field.offset) + u32::from(field.bits)).max();
    bits.count_ones() <= 1 || bits.count_ones() == width || Some(bits.count_ones()) == last
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ir::{Binding, Group, ObjectCode, TypeId, Zone};
    use crate::source::{FileId, Origin};

    fn found(shape: Shape, item: impl FnOnce(&mut Item)) -> Vec<(&'static str, String)> {
        let mut group = Group::object(0x2000, ObjectCode::Var);
        let mut own = Item::new(Binding::canopen(0x2000, 0));
        own.ty = Type::Named(TypeId(0));
        item(&mut own);
        group.items.push(own);
        let definition = TypeDef {
            name: "Mode".into(),
            code: None,
            shape,
            bits: None,
            documentation: None,
            origin: Origin { span: Span::new(FileId(0), 0, 4), line: 1 },
        };
        let mut diagnostics = Diagnostics::default();
        check(Owner { types: &[definition], groups: &[&[group]] }, &mut diagnostics);
        diagnostics.list().iter().map(|found| (found.code.id, found.message.clone())).collect()
    }

    fn modes(closed: bool) -> Shape {
        let value = |name: &str, value, last, zone| EnumValue {
            name: name.into(),
            value,
            last,
            zone,
            names: Default::default(),
            when: None,
            availability: None,
            documentation: None,
            at: Default::default(),
        };
        let values = vec![
            value("off", 0, None, None),
            value("on", 1, None, None),
            value("reserved", 8, Some(127), Some(Zone::Reserved)),
        ];
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
        is(found(modes(false), limits(0, 2)), "TAB018", "the upper limit 2 has no name in `Mode`");
        is(found(modes(true), limits(0, 5)), "TAB018", "the upper limit 5 has no name in `Mode`");
        is(found(modes(false), limits(0, 8)), "TAB018", "the upper limit 8 is reserved in `Mode`");
        is(found(modes(false), limits(0, 0x7F)), "TAB018", "the upper limit 127 is reserved in `Mode`");
        let one = found(modes(false), limits(1, 200));
        is(one, "TAB016", "`off` is 0, below the lower limit 1");
        let default = |value| move |item: &mut Item| item.default = Some(Value::Int(value));
        assert_eq!(found(modes(false), default(3)), []);
        is(found(modes(true), default(3)), "TAB018", "the default 3 has no name in `Mode`");
        is(found(modes(false), default(9)), "TAB018", "the default 9 is reserved in `Mode`");
    }

    #[test]
    fn limits_and_constants_of_bits() {
        let field = |name: &str, offset, bits, meaning| BitFieldEntry {
            name: name.into(),
            names: Default::default(),
            offset,
            bits,
            meaning,
            when: None,
            trigger: None,
            access: None,
            availability: None,
            documentation: None,
            at: Default::default(),
        };
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
        assert_eq!(max, [("TAB016", "bit 15 (`error`) can't be set below the upper limit 16384".to_owned())]);
        let holes = found(flags(), limits(0, 0xF0F7));
        assert_eq!(holes, [("TAB019", "the upper limit 0xF0F7 sets bits 7-3 (reserved) of `Mode`".to_owned())]);
        let constant = found(flags(), |item| {
            limits(0x0005, 0x0005)(item);
            item.default = Some(Value::Int(5));
        });
        let expected = [
            ("TAB019", "the fixed value 0x5 lacks bit 8 (reserved) of `Mode`".to_owned()),
            ("TAB019", "the fixed value 0x5 sets bits 0x4, which `Mode` doesn't name".to_owned()),
        ];
        assert_eq!(constant, expected);
    }
}
