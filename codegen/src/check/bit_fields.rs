//! Fields of bit fields against the integer below and against each other.

use crate::diagnostics::{codes, Diagnostic, Diagnostics};
use crate::ir::firmware::apart;
use crate::ir::owner::{reserved, Owner, Places};
use crate::ir::{BitFieldEntry, BitMeaning, Condition, Shape, Type, TypeDef, TypeId, Value};
use crate::text::brief;

/// The widest field of which every value is looked for.
const MAX_LISTED_BITS: u8 = 4;

pub(super) fn check(owner: Owner<'_>, diagnostics: &mut Diagnostics) {
    let places = Places::new(owner);
    for (definition, id) in owner.types.iter().zip(0..) {
        let Shape::BitField { base, fields } = &definition.shape else { continue };
        let Some(width) = base.bits().filter(|&bits| bits <= 64) else { continue };
        outside((&places, TypeId(id)), definition, (*base, width), fields, diagnostics);
        overlaps(definition, fields, diagnostics);
        unnamed(owner, definition, width, fields, diagnostics);
    }
}

/// What a message calls a field.
pub(super) fn called(field: &BitFieldEntry) -> String {
    let bits = match field.bits {
        1 => format!("bit {}", field.offset),
        bits => format!("bits {}-{}", u32::from(field.offset) + u32::from(bits) - 1, field.offset),
    };
    match (&field.meaning, field.name.is_empty()) {
        (BitMeaning::Reserved { .. }, _) => format!("{bits} (reserved)"),
        (_, true) => bits,
        _ => format!("{bits} (`{}`)", brief(&field.name)),
    }
}

fn outside(
    (places, id): (&Places<'_>, TypeId),
    definition: &TypeDef,
    (base, width): (Type, u32),
    fields: &[BitFieldEntry],
    diagnostics: &mut Diagnostics,
) {
    let mut beyond = fields.iter().filter(|field| u32::from(field.offset) + u32::from(field.bits) > width);
    let Some(first) = beyond.next() else { return };
    let others = match beyond.count() {
        0 => String::new(),
        others => format!(", and {others} more fields reach further too"),
    };
    let message = format!("{base} has {width} bits, and `{}` names {}{others}", brief(&definition.name), called(first));
    let found = Diagnostic::new(&codes::BIT_OUTSIDE_TYPE, places.of(id), message);
    let found = found.note_at(first.at.0.or(definition.origin.span), "the bits are named here");
    diagnostics.push(found.help("the type is too short, or the bits are counted from 1"));
}

/// Of each field, the first one above it with which it shares bits: all pairs would be too many, and each field is named so.
fn overlaps(definition: &TypeDef, fields: &[BitFieldEntry], diagnostics: &mut Diagnostics) {
    for (at, other) in fields.iter().enumerate() {
        let clashes = |one: &&BitFieldEntry| one.mask() & other.mask() != 0 && !told_apart(one, other);
        let Some(one) = fields.iter().take(at).find(clashes) else { continue };
        let message = format!("{} and {} of `{}` share bits", called(one), called(other), brief(&definition.name));
        let found = Diagnostic::new(&codes::BITS_OVERLAP, other.at.0.or(definition.origin.span), message);
        diagnostics.push(found.help("bits of several meanings have a `when`, `since`, `until` or `models` in each"));
    }
}

/// Whether never both meanings hold, or one is the rule and the other its case.
pub(super) fn told_apart(one: &BitFieldEntry, other: &BitFieldEntry) -> bool {
    let by_condition = match (&one.when, &other.when) {
        (None, None) => false,
        (Some(one), Some(other)) => one.item != other.item || !both_hold(one, other),
        _ => true,
    };
    by_condition || apart(one.availability.as_deref(), other.availability.as_deref())
}

/// Whether one value of the item fulfils both conditions.
fn both_hold(one: &Condition, other: &Condition) -> bool {
    let shared = one.mask.unwrap_or(u64::MAX) & other.mask.unwrap_or(u64::MAX);
    let agree = |left: &Value, right: &Value| match (left.as_int(), right.as_int()) {
        (Some(left), Some(right)) => (left ^ right) & i128::from(shared) == 0,
        _ => left == right,
    };
    one.values.iter().any(|left| other.values.iter().any(|right| agree(left, right)))
}

fn unnamed(
    owner: Owner<'_>,
    definition: &TypeDef,
    width: u32,
    fields: &[BitFieldEntry],
    diagnostics: &mut Diagnostics,
) {
    if fields.is_empty() || !diagnostics.wants(&codes::UNNAMED_BITS) {
        return;
    }
    let named = fields.iter().fold(0, |bits, field| bits | field.mask());
    let missing: Vec<String> = (0..width).filter(|bit| named >> bit & 1 == 0).map(|bit| bit.to_string()).collect();
    if !missing.is_empty() {
        let message = format!("`{}` says nothing of the bits {}", brief(&definition.name), missing.join(", "));
        diagnostics.push(Diagnostic::new(&codes::UNNAMED_BITS, definition.origin.span, message));
    }
    fields.iter().for_each(|field| unnamed_values(owner, definition, field, diagnostics));
}

/// The values of a field whose others have names. A wide field has too many to want each of them.
fn unnamed_values(owner: Owner<'_>, definition: &TypeDef, field: &BitFieldEntry, diagnostics: &mut Diagnostics) {
    let BitMeaning::Enumeration(id) = field.meaning else { return };
    let Some((values, _)) = owner.enumeration(Type::Named(id)).filter(|_| field.bits <= MAX_LISTED_BITS) else {
        return;
    };
    let missing = (0..1i128 << field.bits).filter(|&value| reserved(values, value).is_none());
    let missing: Vec<String> = missing.map(|value| value.to_string()).collect();
    if !missing.is_empty() {
        let (name, missing) = (brief(&definition.name), missing.join(", "));
        let message = format!("{} of `{name}` says nothing of the values {missing}", called(field));
        diagnostics.push(Diagnostic::new(&codes::UNNAMED_BITS, definition.origin.span, message));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diagnostics::{Level, Levels};

    fn field(name: &str, offset: u8, bits: u8) -> BitFieldEntry {
        BitFieldEntry {
            name: name.into(),
            names: Default::default(),
            offset,
            bits,
            meaning: BitMeaning::Number,
            when: None,
            trigger: None,
            access: None,
            availability: None,
            documentation: None,
            at: Default::default(),
        }
    }

    fn found(fields: Vec<BitFieldEntry>) -> Vec<String> {
        let mut levels = Levels::lenient();
        levels.set("unnamed-bits", Level::Warn).unwrap();
        let mut diagnostics = Diagnostics::new(levels);
        let definition = TypeDef {
            name: "Status".into(),
            code: None,
            shape: Shape::BitField { base: Type::Unsigned(8), fields },
            bits: Some(8),
            documentation: None,
            origin: Default::default(),
        };
        check(Owner { types: &[definition], groups: &[] }, &mut diagnostics);
        diagnostics.list().iter().map(|found| found.message.clone()).collect()
    }

    #[test]
    fn fields_lie_within_the_integer_and_apart() {
        assert_eq!(found(vec![field("low", 0, 4), field("high", 4, 4)]), [""; 0]);
        assert_eq!(
            found(vec![field("low", 0, 5), field("high", 4, 5)]),
            [
                "UNSIGNED8 has 8 bits, and `Status` names bits 8-4 (`high`)",
                "bits 4-0 (`low`) and bits 8-4 (`high`) of `Status` share bits"
            ]
        );
        assert_eq!(found(vec![field("all but two", 2, 6)]), ["`Status` says nothing of the bits 0, 1"]);
        assert_eq!(field("", 0, 64).mask(), u64::MAX);
        assert_eq!(field("", 63, 1).mask(), 1 << 63);
    }

    #[test]
    fn a_field_is_told_once_however_many_share_its_bits() {
        let fields = (0..900).map(|number| field(&number.to_string(), 0, 8)).collect();
        let found = found(fields);
        assert_eq!(found.len(), 899);
        assert_eq!(found[898], "bits 7-0 (`0`) and bits 7-0 (`899`) of `Status` share bits");
    }

    #[test]
    fn a_condition_tells_two_meanings_apart() {
        let when = |mode| Some(Condition { item: "mode".into(), values: vec![Value::Int(mode)], mask: None });
        let one = BitFieldEntry { when: when(1), ..field("all", 0, 8) };
        assert_eq!(found(vec![one.clone(), BitFieldEntry { when: when(2), ..field("part", 0, 1) }]), [""; 0]);
        assert_eq!(found(vec![one.clone(), field("part", 0, 1)]), [""; 0]);
        assert_eq!(found(vec![one, BitFieldEntry { when: when(1), ..field("part", 0, 1) }]).len(), 1);
    }
}
