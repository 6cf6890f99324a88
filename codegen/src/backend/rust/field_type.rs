//! How the bits of a value are written in Rust, and turned into an integer and back.

use super::named::NamedType;
use super::scope::Scope;
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

    /// The value from its bits, which `§` stands for; `path` is that of the type.
    pub fn decode(&self, path: &str) -> String {
        match self {
            FieldType::Named(_, "u64") => format!("{path}::from_raw(§)"),
            FieldType::Named(_, native) => format!("{path}::from_raw(§ as {native})"),
            FieldType::Bool => "§ & 1 == 1".to_owned(),
            FieldType::Native("u64") => "§".to_owned(),
            FieldType::Native(native) => format!("§ as {native}"),
            FieldType::Odd(true, _) => "rt::Int::from_raw(§)".to_owned(),
            FieldType::Odd(false, _) => "rt::Uint::from_raw(§)".to_owned(),
            FieldType::Real(32) => "f32::from_bits(§ as u32)".to_owned(),
            FieldType::Real(_) => "f64::from_bits(§)".to_owned(),
            FieldType::Time(path) => format!("{path}::from_raw(§)"),
            FieldType::Bytes(_) => "rt::pdo::to_bytes(§)".to_owned(),
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

/// How `bits` bits of a type are written.
pub(super) fn field_type(scope: &Scope<'_>, ty: Type, bits: u32) -> FieldType {
    // The sign of a number has its place at the top of an integer of Rust's own.
    let is_whole = |named: &NamedType| !named.is_signed() || native_bits(named.native) == bits;
    if let Some(named) = scope.enumeration(ty).filter(|named| named.bits == bits && is_whole(named)) {
        return FieldType::Named(named.name.clone(), named.native);
    }
    let ty = scope.base(ty);
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
