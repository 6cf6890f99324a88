//! Rust types and literals for the IR's types and values.

use super::code::{call, slice, Doc};
use super::literal;
use crate::ir::{Limits, Type, Value};
use crate::number::hex;

/// The Rust type of an item's value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum ValueType {
    /// A primitive type, such as `u16`, `i64`, `bool` or `f32`.
    Native { name: &'static str, range: Option<(i128, i128)>, real: u32 },
    /// `Uint<N>` or `Int<N>`.
    Odd { bits: u8, range: (i128, i128) },
    /// A text type of the runtime. Its values are written as string literals.
    Text(&'static str),
    /// A byte sequence type of the runtime. Its values are written as byte string literals.
    Bytes(&'static str),
    /// A type of the runtime for a time of day or a duration.
    Time(&'static str),
}

impl ValueType {
    pub(super) fn of(ty: Type) -> Self {
        let integer = |name| ValueType::Native { name, range: ty.integer_range(), real: 0 };
        let odd = |bits| ValueType::Odd { bits, range: ty.integer_range().unwrap_or((0, 0)) };
        match ty {
            Type::Boolean => ValueType::Native { name: "bool", range: None, real: 0 },
            Type::Integer(bits @ (8 | 16 | 32 | 64)) => integer(native(true, bits.into())),
            Type::Unsigned(bits @ (8 | 16 | 32 | 64)) => integer(native(false, bits.into())),
            Type::Integer(bits @ (24 | 40 | 48 | 56)) => odd(bits),
            Type::Unsigned(bits @ (1..=7 | 9..=15 | 24 | 40 | 48 | 56)) => odd(bits),
            Type::Real32 => ValueType::Native { name: "f32", range: None, real: 32 },
            Type::Real64 => ValueType::Native { name: "f64", range: None, real: 64 },
            Type::VisibleString(_) => ValueType::Text("rt::VisibleString"),
            Type::UnicodeString(_) => ValueType::Text("rt::UnicodeString"),
            Type::OctetString(_) => ValueType::Bytes("rt::OctetString"),
            Type::Domain => ValueType::Bytes("rt::Domain"),
            Type::TimeOfDay => ValueType::Time("rt::TimeOfDay"),
            Type::TimeDifference => ValueType::Time("rt::TimeDifference"),
            _ => ValueType::Bytes("rt::Opaque"),
        }
    }

    /// Returns the path of the type.
    pub(super) fn path(self) -> String {
        match self {
            ValueType::Odd { bits, range: (low, _) } => odd(low < 0, bits.into()),
            ValueType::Native { name: path, .. }
            | ValueType::Text(path)
            | ValueType::Bytes(path)
            | ValueType::Time(path) => path.to_owned(),
        }
    }

    /// Returns the primitive integer that holds the values of an integer type. Returns `None` for other types.
    pub(super) fn native(self) -> Option<&'static str> {
        let (low, high) = self.integers()?;
        Some(native(low < 0, 128 - if low < 0 { high + 1 } else { high }.leading_zeros()))
    }

    /// Returns the name of the type for use in other names: `U16`, `Int24`, `VisibleString`.
    pub(super) fn word(self) -> String {
        let path = self.path();
        let mut letters = path.trim_start_matches("rt::").chars().filter(char::is_ascii_alphanumeric);
        let first = letters.next().map(|first| first.to_ascii_uppercase());
        first.into_iter().chain(letters).collect()
    }

    /// Returns whether the type is a floating-point type. Clippy reports literals of such types that are close to a
    /// mathematical constant.
    pub(super) fn is_real(self) -> bool {
        matches!(self, ValueType::Native { real: 32 | 64, .. })
    }

    fn integers(self) -> Option<(i128, i128)> {
        match self {
            ValueType::Native { range, .. } => range,
            ValueType::Odd { range, .. } => Some(range),
            _ => None,
        }
    }

    /// Returns a literal of the type. Returns `None` if the type cannot represent the value.
    pub(super) fn literal(self, value: &Value) -> Option<String> {
        match (self, value) {
            (ValueType::Native { name: "bool", .. }, Value::Bool(value)) => Some(value.to_string()),
            (ValueType::Native { real: real @ (32 | 64), .. }, _) => literal::real(value.as_real()?, real),
            (ValueType::Text(_), Value::Text(text)) => Some(literal::string(text)),
            (ValueType::Bytes(_), Value::Bytes(bytes)) => Some(literal::bytes(bytes)),
            (ValueType::Time(path), Value::Time { milliseconds, days }) => {
                Some(format!("{path}::new({milliseconds}, {days})"))
            }
            (_, Value::Int(value)) => {
                let (low, high) = self.integers()?;
                (low..=high).contains(value).then(|| number(*value, low == 0))
            }
            _ => None,
        }
    }

    /// Returns the offset that a formula with `$NODEID` adds to the node-ID. Returns `None` for values that are not
    /// formulas, and for offsets that do not fit in the type.
    pub(super) fn formula(self, value: &Value) -> Option<i128> {
        let (low, high) = self.integers()?;
        match value {
            Value::NodeId(offset) if (low..=high).contains(offset) => Some(*offset),
            _ => None,
        }
    }

    /// Returns the Rust expression of an initial value (`rt::Initial`). `wrap` converts a literal to the expression of a value.
    pub(super) fn initial_as(self, value: Option<&Value>, wrap: &dyn Fn(String) -> Doc) -> Doc {
        if let Some(offset) = value.and_then(|value| self.formula(value)) {
            // Rust formats a negative number in hexadecimal as its two's complement, so a negative offset is written in
            // decimal.
            let offset = if offset < 0 { offset.to_string() } else { format!("{offset:#x}") };
            return call!("rt::Initial::NodeId", wrap(offset));
        }
        match value.and_then(|value| self.literal(value)) {
            Some(literal) if matches!(self, ValueType::Bytes(_)) => call!("rt::Initial::bytes", literal),
            Some(literal) => call!("rt::Initial::Value", wrap(literal)),
            None => Doc::from("rt::Initial::Unknown"),
        }
    }

    /// Returns the Rust expression of a range (`rt::Range`). Integer limits are clamped to the range of the type. Contradictory
    /// limits, and limits of a type that is not a number, become `Range::Full`.
    pub(super) fn range_as(self, limits: &Limits, wrap: &dyn Fn(String) -> Doc) -> Doc {
        if let Some(list) = self.only(limits, wrap) {
            return list;
        }
        let limits = match self.integers() {
            Some(range) => self.integer_limits(limits, range),
            None if self.is_real() => self.real_limits(limits),
            None => None,
        };
        let (low, high) = limits.unwrap_or_default();
        match (low.map(wrap), high.map(wrap)) {
            (None, None) => Doc::from("rt::Range::Full"),
            (Some(low), None) => call!("rt::Range::From", low),
            (None, Some(high)) => call!("rt::Range::To", high),
            (Some(low), Some(high)) => call!("rt::Range::Between", low, high),
        }
    }

    /// Returns the Rust expression of a range (`rt::Range`) for an integer with fewer bits than its Rust type. The range
    /// excludes values beyond the integer's width. Returns `None` if the type is not an integer type.
    #[cfg(feature = "messages")]
    pub(super) fn range_within(self, limits: &Limits) -> Option<Doc> {
        if let Some(list) = self.only(limits, &Doc::from) {
            return Some(list);
        }
        let range = self.integers()?;
        let (low, high) = self.integer_limits(limits, range).unwrap_or_default();
        let (low, high) = (low.unwrap_or(range.0.to_string()), high.unwrap_or(range.1.to_string()));
        Some(match low == "0" && range.0 == 0 {
            true => call!("rt::Range::To", high),
            false => call!("rt::Range::Between", low, high),
        })
    }

    /// Returns the expression of a `Range` that lists the allowed values and ranges. Returns `None` if the limits
    /// contain no such list, or if the type cannot represent one of the listed values.
    fn only(self, limits: &Limits, wrap: &dyn Fn(String) -> Doc) -> Option<Doc> {
        let (low, high) = self.integers().filter(|_| !limits.allowed.is_empty())?;
        let one = |value: &Value| {
            value.as_int().filter(|number| (low..=high).contains(number)).map(|number| number.to_string())
        };
        let range = |(first, last): &(Value, Value)| Some(call!("", wrap(one(first)?), wrap(one(last)?)));
        let list: Option<Vec<Doc>> = limits.allowed.iter().map(range).collect();
        Some(call!("rt::Range::OneOf", slice(list?)))
    }

    fn integer_limits(self, limits: &Limits, range: (i128, i128)) -> Option<(Option<String>, Option<String>)> {
        let bound = |value: &Option<Value>| match value {
            Some(Value::Real(value)) => Some(*value as i128),
            Some(value) => value.as_int(),
            None => None,
        };
        let (low, high) = (bound(&limits.low), bound(&limits.high));
        let (low, high) = (low.unwrap_or(range.0).max(range.0), high.unwrap_or(range.1).min(range.1));
        if low > high {
            return None;
        }
        let write = |value: i128, limit: i128| (value != limit).then(|| value.to_string());
        Some((write(low, range.0), write(high, range.1)))
    }

    fn real_limits(self, limits: &Limits) -> Option<(Option<String>, Option<String>)> {
        let bound = |value: &Option<Value>| value.as_ref().and_then(Value::as_real);
        let (low, high) = (bound(&limits.low), bound(&limits.high));
        if low.zip(high).is_some_and(|(low, high)| low > high) {
            return None;
        }
        let write = |value: Option<f64>| value.and_then(|value| self.literal(&Value::Real(value)));
        Some((write(low), write(high)))
    }
}

/// Returns the smallest primitive integer with at least this many bits.
pub(super) fn native(signed: bool, bits: u32) -> &'static str {
    match (signed, bits) {
        (false, ..=8) => "u8",
        (false, ..=16) => "u16",
        (false, ..=32) => "u32",
        (false, _) => "u64",
        (true, ..=8) => "i8",
        (true, ..=16) => "i16",
        (true, ..=32) => "i32",
        (true, _) => "i64",
    }
}

/// Returns the path of the runtime's type for integers with a width that no primitive integer has.
pub(super) fn odd(signed: bool, bits: u32) -> String {
    format!("rt::{}<{bits}>", if signed { "Int" } else { "Uint" })
}

/// Returns the number of bits of a primitive integer.
pub(super) fn native_bits(native: &str) -> u32 {
    native[1..].parse().unwrap_or(64)
}

/// Formats a number as a Rust literal. Unsigned numbers above 0xFFFF are hexadecimal, because most of them are bit
/// patterns, addresses and signatures.
pub(super) fn number(value: i128, unsigned: bool) -> String {
    if unsigned && value > 0xFFFF {
        hex(value)
    } else {
        value.to_string()
    }
}

/// Returns whether a type is an integer of 8, 16 or 32 bits.
pub(super) fn is_word(ty: Type) -> bool {
    matches!(ty, Type::Unsigned(8 | 16 | 32) | Type::Integer(8 | 16 | 32))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn limits(low: i128, high: i128) -> Limits {
        Limits { low: Some(Value::Int(low)), high: Some(Value::Int(high)), ..Limits::default() }
    }

    #[test]
    fn limits_are_clamped_and_impossible_ones_are_not_checked() {
        let u16 = ValueType::of(Type::Unsigned(16));
        assert_eq!(u16.range_as(&limits(0, 65536), &Doc::from), Doc::from("rt::Range::Full"));
        assert_eq!(u16.range_as(&limits(5, 65536), &Doc::from), call!("rt::Range::From", "5"));
        assert_eq!(u16.range_as(&limits(5, 4), &Doc::from), Doc::from("rt::Range::Full"));
        assert_eq!(
            ValueType::of(Type::Integer(24)).range_as(&limits(-8_388_608, 5), &Doc::from),
            call!("rt::Range::To", "5")
        );
        assert_eq!(
            ValueType::of(Type::Real32).range_as(&limits(0, 5), &Doc::from),
            call!("rt::Range::Between", "0.0", "5.0")
        );
    }

    #[test]
    fn initial_values() {
        let u32 = ValueType::of(Type::Unsigned(32));
        assert_eq!(u32.initial_as(Some(&Value::NodeId(0x180)), &Doc::from), call!("rt::Initial::NodeId", "0x180"));
        assert_eq!(u32.initial_as(Some(&Value::Int(-1)), &Doc::from), Doc::from("rt::Initial::Unknown"));
        assert_eq!(u32.initial_as(Some(&Value::Int(7)), &Doc::from), call!("rt::Initial::Value", "7"));
        assert_eq!(
            ValueType::of(Type::Boolean).initial_as(Some(&Value::Int(2)), &Doc::from),
            Doc::from("rt::Initial::Unknown")
        );
    }
}
