//! Rust types of fields that consist of a number of bits, and conversions between these types and integers.

use super::code::{call, seq, Break, Doc};
use super::context::Context;
use super::naming::types::NamedType;
use super::value_type::{native, native_bits, odd};
use crate::ir::Type;
use crate::number::hex;

/// Number of bits in a word, that is, in the `u64` that contains encoded values.
const WORD: u32 = 64;

/// The Rust type of a field that consists of a number of bits.
pub(super) enum FieldType {
    Bool,
    /// A primitive integer.
    Native(&'static str),
    /// An integer with a width that no primitive integer has: whether the integer is signed, and its number of bits.
    Odd(bool, u32),
    Real(u32),
    Time(&'static str),
    Bytes(u32),
    /// An enumeration or bit field: its name, and the primitive integer that holds its raw value.
    Named(String, &'static str),
}

impl FieldType {
    /// Returns the path of the Rust type. `outer` is the path to the device's module.
    pub fn path(&self, outer: &str) -> String {
        match self {
            FieldType::Bool => "bool".to_owned(),
            FieldType::Native(native) => (*native).to_owned(),
            FieldType::Odd(signed, bits) => odd(*signed, *bits),
            FieldType::Real(bits) => format!("f{bits}"),
            FieldType::Time(path) => (*path).to_owned(),
            FieldType::Bytes(length) => format!("[u8; {length}]"),
            FieldType::Named(name, _) => format!("{outer}types::{name}"),
        }
    }

    /// Returns an expression that converts `value` to bits in a `u64`. For an enumeration or bit field, bits of the
    /// result beyond the width of the field may be set.
    pub fn encode(&self, value: &str, bits: u32) -> String {
        match self {
            FieldType::Named(_, native) => match native.strip_prefix('i') {
                Some("64") => format!("{value}.raw() as u64"),
                Some(bits) => format!("{value}.raw() as u{bits} as u64"),
                None if *native == "u64" => format!("{value}.raw()"),
                None => format!("{value}.raw() as u64"),
            },
            FieldType::Native("u64") => value.to_owned(),
            // A signed number must first be cast to the unsigned integer of its width. Otherwise, the sign would extend
            // over the whole word.
            FieldType::Native(signed) if signed.starts_with('i') && bits < WORD => {
                format!("{value} as u{bits} as u64")
            }
            FieldType::Bool | FieldType::Native(_) => format!("{value} as u64"),
            FieldType::Odd(..) | FieldType::Time(_) => format!("{value}.raw()"),
            FieldType::Real(32) => format!("{value}.to_bits() as u64"),
            FieldType::Real(_) => format!("{value}.to_bits()"),
            FieldType::Bytes(_) => format!("rt::pdo::from_bytes(&{value})"),
        }
    }

    /// Returns an expression that converts bits to a value. For a Boolean, the expression reads only the lowest bit.
    /// `path` is the path of the Rust type.
    pub fn decode(&self, path: &str, bits: &Doc) -> Doc {
        match self {
            FieldType::Named(_, "u64") | FieldType::Time(_) => call!(seq![path, "::from_raw"], bits),
            FieldType::Named(_, native) => call!(seq![path, "::from_raw"], cast(bits, native)),
            FieldType::Bool => seq![bits, " & 1 == 1"],
            FieldType::Native("u64") => bits.clone(),
            FieldType::Native(native) => cast(bits, native),
            FieldType::Odd(true, _) => call!("rt::Int::from_raw", bits),
            FieldType::Odd(false, _) => call!("rt::Uint::from_raw", bits),
            FieldType::Real(32) => call!("f32::from_bits", cast(bits, "u32")),
            FieldType::Real(_) => call!("f64::from_bits", bits),
            FieldType::Bytes(_) => call!("rt::pdo::to_bytes", bits),
        }
    }

    /// Returns whether the expression of [`decode`](Self::decode) applies an operator to the bits. If so, an expression
    /// `bits` that contains an operator must be in parentheses.
    pub fn is_cast(&self) -> bool {
        match self {
            FieldType::Native(native) | FieldType::Named(_, native) => *native != "u64",
            FieldType::Bool | FieldType::Real(32) => true,
            _ => false,
        }
    }

    /// Returns a mask of the field's bits. Returns `None` if no mask is necessary, because the Rust type has no bits
    /// beyond the field's width, or its conversions clear these bits.
    pub fn cut(&self, bits: u32) -> Option<String> {
        match self {
            FieldType::Named(_, native) if native_bits(native) > bits => Some(hex(u64::MAX >> (WORD - bits))),
            _ => None,
        }
    }
}

/// Returns `value as ty`. The line can be broken before `as`.
fn cast(value: &Doc, ty: &str) -> Doc {
    seq![value, Break, " as ", ty]
}

/// Returns the Rust type of a field that has `bits` bits and the IR type `ty`.
pub(super) fn field_type(context: &Context<'_>, ty: Type, bits: u32) -> FieldType {
    // A field with a signed enumeration must have the width of a primitive integer. Only then is the sign bit the most
    // significant bit of this integer.
    let is_whole = |named: &NamedType| !named.is_signed() || native_bits(named.native) == bits;
    if let Some(named) = context.enumeration(ty).filter(|named| named.bits == bits && is_whole(named)) {
        return FieldType::Named(named.name.clone(), named.native);
    }
    let ty = context.base(ty);
    let is_whole = ty.bits() == Some(bits);
    match ty {
        Type::Boolean if bits == 1 => FieldType::Bool,
        Type::Real32 | Type::Real64 if is_whole => FieldType::Real(bits),
        Type::TimeOfDay if is_whole => FieldType::Time("rt::TimeOfDay"),
        Type::TimeDifference if is_whole => FieldType::Time("rt::TimeDifference"),
        Type::Integer(_) if bits <= WORD => integer(true, bits),
        Type::VisibleString(_) | Type::OctetString(_) | Type::UnicodeString(_) | Type::Domain
            if bits.is_multiple_of(8) =>
        {
            FieldType::Bytes(bits / 8)
        }
        _ if bits > WORD => FieldType::Bytes(bits.div_ceil(8)),
        _ => integer(false, bits),
    }
}

fn integer(signed: bool, bits: u32) -> FieldType {
    match bits {
        8 | 16 | 32 | 64 => FieldType::Native(native(signed, bits)),
        _ => FieldType::Odd(signed, bits),
    }
}
