//! Random type definitions of a device, and types of values.

use lexibus_codegen::ir::{
    Access, BitFieldEntry, BitMeaning, EnumValue, Field, Scale, Shape, TimeFormat, Trigger, Type, TypeDef, TypeId, Zone,
};
use lexibus_codegen::source::Origin;

use super::bytes::Bytes;
use super::facts::{availability, condition};
use super::names;
use super::values;

/// Widths in bits. Most widths have a type in Rust or in the runtime, and some have none.
const WIDTHS: [u8; 18] = [8, 16, 32, 64, 8, 16, 32, 24, 40, 48, 56, 1, 2, 5, 12, 15, 17, 63];

const TIMES: [TimeFormat; 8] = [
    TimeFormat::Date,
    TimeFormat::TimeOfDay,
    TimeFormat::TimeDifference,
    TimeFormat::NetworkTime,
    TimeFormat::NetworkTimeDifference,
    TimeFormat::TimeStamp,
    TimeFormat::TimeStampDifference,
    TimeFormat::TimeStampDifferenceShort,
];

/// Returns an integer type.
pub fn integer(b: &mut Bytes<'_>) -> Type {
    let bits = b.pick(&WIDTHS);
    if b.one_in(3) {
        Type::Integer(bits)
    } else {
        Type::Unsigned(bits)
    }
}

/// Returns a type that needs no definition.
pub fn basic(b: &mut Bytes<'_>) -> Type {
    let length = |b: &mut Bytes<'_>| b.maybe(2, |b| b.within(0..=40));
    match b.within(0..=19) {
        0..=9 => integer(b),
        10 => Type::Boolean,
        11 => Type::Real32,
        12 => Type::Real64,
        13 => Type::VisibleString(length(b)),
        14 => Type::OctetString(length(b)),
        15 => Type::UnicodeString(length(b)),
        16 => b.pick(&[Type::TimeOfDay, Type::TimeDifference]),
        17 => Type::Domain,
        18 => Type::Time(b.pick(&TIMES)),
        _ => Type::Opaque(b.maybe(2, |b| b.within(0..=0x1000))),
    }
}

/// Returns a basic type or one of the defined types.
pub fn any(b: &mut Bytes<'_>, defined: usize) -> Type {
    if defined > 0 && b.one_in(2) {
        Type::Named(TypeId(b.within(0..=defined as u32 - 1)))
    } else {
        basic(b)
    }
}

/// Returns the basic type on which a type is based.
pub fn base(types: &[TypeDef], mut ty: Type) -> Type {
    for _ in 0..8 {
        let Type::Named(id) = ty else { return ty };
        ty = match types.get(id.0 as usize).map(|definition| &definition.shape) {
            Some(Shape::Alias(definition)) => *definition,
            Some(Shape::BitField { base, .. } | Shape::Enumeration { base, .. } | Shape::Scaled { base, .. }) => *base,
            _ => return Type::Opaque(None),
        };
    }
    Type::Opaque(None)
}

/// Returns the type definitions of a device. Each definition may use the definitions before it.
pub fn definitions(b: &mut Bytes<'_>, most: usize) -> Vec<TypeDef> {
    let mut types: Vec<TypeDef> = Vec::new();
    for _ in 0..b.within(0..=most) {
        let shape = shape(b, &types);
        let (documentation, doubts) = (names::documentation(b), names::doubts(b));
        let (code, bits) = (b.maybe(4, |b| b.within(0x40..=0x60)), b.maybe(4, |b| b.within(1..=64)));
        let (name, stated_by) = (names::name(b), names::stated_by(b));
        types.push(TypeDef { name, code, shape, bits, documentation, doubts, stated_by, origin: Origin::default() });
    }
    types
}

fn shape(b: &mut Bytes<'_>, types: &[TypeDef]) -> Shape {
    let defined = types.len();
    match b.within(0..=11) {
        0..=3 => {
            Shape::Enumeration { base: below(b, types), values: b.list(7, values_of_enumeration), closed: b.any() }
        }
        4..=7 => {
            let base = below(b, types);
            Shape::BitField { base, fields: bit_fields(b, types, self::base(types, base).bits().unwrap_or(32)) }
        }
        8 => Shape::Alias(any(b, defined)),
        9 => Shape::Array { element: any(b, defined), dimensions: b.list(2, |b| (b.within(0..=1), b.within(0..=5))) },
        10 => Shape::Record(b.list(4, |b| record_field(b, defined))),
        _ => Shape::Scaled { base: integer(b), scale: scale(b) },
    }
}

/// Returns an integer type or, in rare cases, BOOLEAN or an alias.
fn below(b: &mut Bytes<'_>, types: &[TypeDef]) -> Type {
    let aliases = || types.iter().zip(0..).filter(|(definition, _)| matches!(definition.shape, Shape::Alias(_)));
    match b.within(0..=11) {
        10 => Type::Boolean,
        11 => aliases().next().map_or(Type::Unsigned(8), |(_, at)| Type::Named(TypeId(at))),
        _ => integer(b),
    }
}

fn record_field(b: &mut Bytes<'_>, defined: usize) -> Field {
    Field {
        name: names::name(b),
        sub_index: b.maybe(2, |b| b.within(0..=5)),
        ty: any(b, defined),
        bits: b.within(0..=64),
        bit_offset: b.within(0..=64),
    }
}

/// Returns an enumeration value, sometimes with optional facts such as a condition or a range.
pub fn values_of_enumeration(b: &mut Bytes<'_>) -> EnumValue {
    let value = values::number(b);
    EnumValue {
        last: b.maybe(8, |b| value + b.within(0..=20)),
        zone: b.maybe(8, |b| b.pick(&[Zone::Reserved, Zone::Vendor])),
        names: names::texts(b),
        when: b.maybe(8, condition).map(Box::new),
        availability: b.maybe(8, availability).map(Box::new),
        documentation: names::documentation(b),
        ..EnumValue::new(names::name(b), value)
    }
}

fn bit_fields(b: &mut Bytes<'_>, types: &[TypeDef], width: u32) -> Vec<BitFieldEntry> {
    let mut next = 0_u8;
    b.list(9, |b| {
        let bits = b.pick(&[1, 1, 1, 1, 2, 3, 4, 8, 16, 32]);
        // Most bit fields are contiguous, but some overlap or exceed the integer.
        let offset = if b.one_in(6) { b.within(0..=63) } else { next };
        next = offset.saturating_add(bits).min(u8::try_from(width).unwrap_or(64));
        bit_field(b, types, offset, bits)
    })
}

fn bit_field(b: &mut Bytes<'_>, types: &[TypeDef], offset: u8, bits: u8) -> BitFieldEntry {
    let is_enumeration = |definition: &TypeDef| matches!(definition.shape, Shape::Enumeration { .. });
    let enumerations: Vec<u32> =
        types.iter().zip(0..).filter(|(definition, _)| is_enumeration(definition)).map(|(_, at)| at).collect();
    let of_width = |at: &u32| base(types, Type::Named(TypeId(*at))).bits() == Some(bits.into());
    let fitting: Vec<u32> = enumerations.iter().copied().filter(of_width).collect();
    let choice = if fitting.is_empty() { &enumerations } else { &fitting };
    let meaning = match b.within(0..=7) {
        0..=3 if bits == 1 || b.one_in(4) => BitMeaning::Flag { inverted: b.one_in(4) },
        4 => BitMeaning::Reserved { write: b.any() },
        5 | 6 if !choice.is_empty() => BitMeaning::Enumeration(TypeId(b.pick(choice))),
        _ => BitMeaning::Number,
    };
    let triggers = [Trigger::Rising, Trigger::Falling, Trigger::Toggle, Trigger::SelfClearing];
    BitFieldEntry {
        name: if b.one_in(8) { format!("Bit {offset}").into() } else { names::name(b) },
        names: names::texts(b),
        offset,
        bits,
        meaning,
        when: b.maybe(4, condition).map(Box::new),
        trigger: b.maybe(5, |b| b.pick(&triggers)),
        access: b.maybe(8, |b| b.pick(&[Access::ReadOnly, Access::ReadWrite, Access::WriteOnly])),
        availability: b.maybe(8, availability).map(Box::new),
        documentation: names::documentation(b),
        at: Default::default(),
    }
}

/// Returns any scale.
pub fn scale(b: &mut Bytes<'_>) -> Scale {
    match b.within(0..=7) {
        0..=2 => Scale::Linear { factor: values::real(b), offset: if b.one_in(3) { values::real(b) } else { 0.0 } },
        3 => Scale::Reciprocal { numerator: values::real(b) },
        4 => Scale::Fraction { bits: b.pick(&[0, 8, 15, 31, 63, 64, 255]), base: names::name(b) },
        5 => {
            let (base, fraction) = (b.pick(&[10, 2, 0, 255]), b.pick(&[0, 15, 63, 200]));
            Scale::Exponent { exponent: names::name(b).into(), base, fraction }
        }
        6 => Scale::ByItem { item: names::name(b).into(), factor: values::real(b) },
        _ => Scale::TimesItem { item: names::name(b).into(), factor: values::real(b) },
    }
}
