//! Bit fields: fields outside of the type, overlapping fields and unnamed bits.

use crate::diagnostics::{codes, Diagnostic, Diagnostics};
use crate::ir::firmware::apart;
use crate::ir::owner::{reserved, Owner, TypeUses};
use crate::ir::{stated, BitFieldEntry, BitMeaning, Condition, Shape, Type, TypeDef, Value};
use crate::source::Span;
use crate::text::{brief, count_of, more, numbered};

/// Maximum width in bits of an enumerated field in which every value must have a name.
const MAX_LISTED_BITS: u8 = 4;

pub(super) fn check(owner: Owner<'_>, diagnostics: &mut Diagnostics) {
    let uses = TypeUses::new(owner);
    for (id, definition) in stated::types(owner.types) {
        let Shape::BitField { base, fields } = &definition.shape else { continue };
        let Some(width) = base.bits().filter(|&bits| bits <= 64) else { continue };
        if let Some(found) = outside(definition, *base, fields, || uses.first(id)) {
            diagnostics.push(found);
        }
        overlaps(definition, fields, diagnostics);
        unnamed(owner, definition, width, fields, diagnostics);
    }
}

/// Returns the name and the bits of a field as text for diagnostics.
pub(super) fn called(field: &BitFieldEntry) -> String {
    let bits = field.bit_range();
    match field.name.is_empty() {
        _ if field.is_reserved() => format!("{bits} (reserved)"),
        true => bits,
        false => format!("{bits} (`{}`)", brief(&field.name)),
    }
}

/// Returns the bits that are 1 in `mask` as text for diagnostics, such as `bit 3` or `bits 15-8, 3`.
pub(super) fn set_bits(mask: u64) -> String {
    let mut ranges = Vec::new();
    let mut rest = mask;
    while rest != 0 {
        let last = rest.ilog2();
        let length = (rest << rest.leading_zeros()).leading_ones();
        let first = last + 1 - length;
        ranges.push(if length == 1 { last.to_string() } else { format!("{last}-{first}") });
        rest &= (1u64 << first) - 1;
    }
    format!("bit{} {}", if mask.is_power_of_two() { "" } else { "s" }, ranges.join(", "))
}

/// Returns a diagnostic if bit-field entries are outside of the underlying integer. `used` returns the first use of the
/// type.
fn outside(
    definition: &TypeDef,
    base: Type,
    fields: &[BitFieldEntry],
    used: impl FnOnce() -> Span,
) -> Option<Diagnostic> {
    let width = base.bits()?;
    let mut beyond = fields.iter().filter(|field| field.end() > width);
    let first = beyond.next()?;
    let others = more(beyond.count(), |others| format!(" and {}", count_of(others, "other field")));
    let (name, bits) = (brief(&definition.name), called(first));
    let message = format!("{base} has {width} bits, but the bit field `{name}` contains {bits}{others}");
    let found = codes::BIT_OUTSIDE_TYPE.at(used(), message);
    let found = found.note_at(first.at.0.or(definition.origin.span), "definition of the bits");
    Some(found.help("use a longer type, or count the bits from 0"))
}

/// Reports each field that shares bits with an earlier field. Only the first overlap of a field is reported, because there can be
/// many overlaps.
fn overlaps(definition: &TypeDef, fields: &[BitFieldEntry], diagnostics: &mut Diagnostics) {
    for (at, other) in fields.iter().enumerate() {
        let clashes = |one: &&BitFieldEntry| one.mask() & other.mask() != 0 && !are_distinct(one, other);
        let Some(one) = fields.iter().take(at).find(clashes) else { continue };
        let message = format!("{} and {} of `{}` overlap", called(one), called(other), brief(&definition.name));
        let found = codes::BITS_OVERLAP.at(other.at.0.or(definition.origin.span), message);
        let help = "add `when`, `since`, `until` or `models` to each field if the bits have several meanings";
        diagnostics.push(found.help(help));
    }
}

/// Returns whether two meanings of bits never apply together, or one meaning is a special case of the other. Meanings
/// that depend on different items count as distinct.
pub(super) fn are_distinct(one: &BitFieldEntry, other: &BitFieldEntry) -> bool {
    let by_condition = match (&one.when, &other.when) {
        (None, None) => false,
        (Some(one), Some(other)) => one.item != other.item || !both_hold(one, other),
        _ => true,
    };
    by_condition || apart(one.availability.as_deref(), other.availability.as_deref())
}

/// Returns whether the same value can meet both conditions. Both conditions must refer to the same item.
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
        let message = format!("`{}` does not describe {}", brief(&definition.name), numbered("bit", &missing));
        diagnostics.push(codes::UNNAMED_BITS.at(definition.origin.span, message));
    }
    fields.iter().for_each(|field| unnamed_values(owner, definition, field, diagnostics));
}

/// Reports values without a name in an enumerated field. Wide fields are not checked, because not all of their values need a
/// name.
fn unnamed_values(owner: Owner<'_>, definition: &TypeDef, field: &BitFieldEntry, diagnostics: &mut Diagnostics) {
    let BitMeaning::Enumeration(id) = field.meaning else { return };
    let Some((values, _)) = owner.enumeration(Type::Named(id)).filter(|_| field.bits <= MAX_LISTED_BITS) else {
        return;
    };
    let missing = (0..1i128 << field.bits).filter(|&value| reserved(values, value).is_none());
    let missing: Vec<String> = missing.map(|value| value.to_string()).collect();
    if !missing.is_empty() {
        let (name, missing) = (brief(&definition.name), numbered("value", &missing));
        let message = format!("`{name}` does not name {missing} of {}", called(field));
        diagnostics.push(codes::UNNAMED_BITS.at(definition.origin.span, message));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diagnostics::{Level, Levels};

    fn field(name: &str, offset: u8, bits: u8) -> BitFieldEntry {
        BitFieldEntry::new(name.into(), offset, bits, BitMeaning::Number)
    }

    fn found(fields: Vec<BitFieldEntry>) -> Vec<String> {
        let mut levels = Levels::lenient();
        levels.set("unnamed-bits", Level::Warn).unwrap();
        let mut diagnostics = Diagnostics::new(levels);
        let definition = TypeDef::new("Status", Shape::BitField { base: Type::Unsigned(8), fields }, Some(8));
        check(Owner { types: &[definition], groups: &[] }, &mut diagnostics);
        diagnostics.list().iter().map(|found| found.message.clone()).collect()
    }

    #[test]
    fn fields_outside_of_the_type_and_overlaps_are_reported() {
        assert_eq!(found(vec![field("low", 0, 4), field("high", 4, 4)]), [""; 0]);
        assert_eq!(
            found(vec![field("low", 0, 5), field("high", 4, 5)]),
            [
                "UNSIGNED8 has 8 bits, but the bit field `Status` contains bits 8-4 (`high`)",
                "bits 4-0 (`low`) and bits 8-4 (`high`) of `Status` overlap"
            ]
        );
        assert_eq!(found(vec![field("all but two", 2, 6)]), ["`Status` does not describe bits 0, 1"]);
        assert_eq!(field("", 0, 64).mask(), u64::MAX);
        assert_eq!(field("", 63, 1).mask(), 1 << 63);
    }

    #[test]
    fn a_field_is_reported_once_even_if_many_share_its_bits() {
        let fields = (0..900).map(|number| field(&number.to_string(), 0, 8)).collect();
        let found = found(fields);
        assert_eq!(found.len(), 899);
        assert_eq!(found[898], "bits 7-0 (`0`) and bits 7-0 (`899`) of `Status` overlap");
    }

    #[test]
    fn conditions_distinguish_meanings_of_the_same_bits() {
        let when = |mode| {
            let item = "mode".into();
            Some(Box::new(Condition { item, values: vec![Value::Int(mode)], names: Vec::new(), mask: None }))
        };
        let one = BitFieldEntry { when: when(1), ..field("all", 0, 8) };
        assert_eq!(found(vec![one.clone(), BitFieldEntry { when: when(2), ..field("part", 0, 1) }]), [""; 0]);
        assert_eq!(found(vec![one.clone(), field("part", 0, 1)]), [""; 0]);
        assert_eq!(found(vec![one, BitFieldEntry { when: when(1), ..field("part", 0, 1) }]).len(), 1);
    }
}
