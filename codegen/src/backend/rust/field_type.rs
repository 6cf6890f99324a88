//! How the bits of a value are written in Rust, and turned into an integer and back.

use super::code::{call, seq, Break, Doc};
use super::context::Context;
use super::naming::types::NamedType;
use crate::ir::Type;

/// Bits of a word.
const WORD: u32 = 64;

/// How bits are written in Rust.
pub(super) enum FieldType {
    Bool,
    /// An integer of Rust's own.
    Native(&'static str),
    /// An integer of another width.
    Odd(bool, u32),
    Real(u32),
    Time(&'static str),
    Bytes(u32),
    /// An enumeration: its name, and the type of its numbers.
    Named(String, &'static str),
}

impl FieldType {
    /// The type in Rust; `outer` leads to the device's place.
    pub fn path(&self, outer: &str) -> String {
        match self {
            FieldType::Bool => "bool".to_owned(),
            FieldType::Native(native) => (*native).to_owned(),
            FieldType::Odd(true, bits) => format!("rt::Int<{bits}>"),
            FieldType::Odd(false, bits) => format!("rt::Uint<{bits}>"),
            FieldType::Real(bits) => format!("f{bits}"),
            FieldType::Time(path) => (*path).to_owned(),
            FieldType::Bytes(length) => format!("[u8; {length}]"),
            FieldType::Named(name, _) => format!("{outer}types::{name}"),
        }
    }

    /// The bits of the value that `own` names as an `u64`. Of an enumeration, those beyond its width may be set.
    pub fn encode(&self, own: &str, bits: u32) -> String {
        match self {
            FieldType::Named(_, native) => match native.strip_prefix('i') {
                Some("64") => format!("{own}.raw() as u64"),
                Some(bits) => format!("{own}.raw() as u{bits} as u64"),
                None if *native == "u64" => format!("{own}.raw()"),
                None => format!("{own}.raw() as u64"),
            },
            FieldType::Native("u64") => own.to_owned(),
            // A signed number is cut to its width before it is widened, or its sign would spread over the word.
            FieldType::Native(signed) if signed.starts_with('i') && bits < WORD => {
                format!("{own} as u{bits} as u64")
            }
            FieldType::Bool | FieldType::Native(_) => format!("{own} as u64"),
            FieldType::Odd(..) | FieldType::Time(_) => format!("{own}.raw()"),
            FieldType::Real(32) => format!("{own}.to_bits() as u64"),
            FieldType::Real(_) => format!("{own}.to_bits()"),
            FieldType::Bytes(_) => format!("rt::pdo::from_bytes(&{own})"),
        }
    }

    /// The value from its bits, of which a truth value is the lowest; `path` is that of the type.
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

    /// Whether the bits are part of an expression, so that operators in them need brackets.
    pub fn is_cast(&self) -> bool {
        match self {
            FieldType::Native(native) | FieldType::Named(_, native) => *native != "u64",
            FieldType::Bool | FieldType::Real(32) => true,
            _ => false,
        }
    }

    /// The bits that the field has of its Rust type, where these are fewer and its own conversions don't say so.
    pub fn cut(&self, bits: u32) -> Option<String> {
        match self {
            FieldType::Named(_, native) if native_bits(native) > bits => {
                Some(format!("{:#X}", u64::MAX >> (WORD - bits)).replace("0X", "0x"))
            }
            _ => None,
        }
    }
}

/// `value as ty`, broken in front of `as`.
fn cast(value: &Doc, ty: &str) -> Doc {
    seq![value, Break, " as ", ty]
}

/// How `bits` bits of a type are written.
pub(super) fn field_type(context: &Context<'_>, ty: Type, bits: u32) -> FieldType {
    // The sign of a number has its place at the top of an integer of Rust's own.
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

/// Bits of an integer of Rust's own.
fn native_bits(native: &str) -> u32 {
    native[1..].parse().unwrap_or(0)
}

fn integer(signed: bool, bits: u32) -> FieldType {
    match (signed, bits) {
        (true, 8) => FieldType::Native("i8"),
        (true, 16) => FieldType::Native("i16"),
        (true, 32) => FieldType::Native("i32"),
        (true, 64) => FieldType::Native("i64"),
        (false, 8) => FieldType::Native("u8"),
        (false, 16) => FieldType::Native("u16"),
        (false, 32) => FieldType::Native("u32"),
        (false, 64) => FieldType::Native("u64"),
        _ => FieldType::Odd(signed, bits),
    }
}
