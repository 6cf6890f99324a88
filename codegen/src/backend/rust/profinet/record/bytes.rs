//! The default bytes of a record, and the default values of its fields.

use super::Parameter;
use crate::backend::rust::code::{call, seq, Doc};
use crate::backend::rust::literal;
use crate::backend::rust::profinet::field::Field;
use crate::backend::rust::profinet::values::Enumeration;
use crate::ir::{Record, Value};

/// Returns the default bytes of the record. These bytes consist of the record's constants, overwritten with the
/// defaults of its parameters.
pub(super) fn default_bytes(record: &Record, parameters: &[Parameter<'_>]) -> Vec<u8> {
    let mut bytes = vec![0; record.length as usize];
    for (offset, constant) in &record.constants {
        put(&mut bytes, *offset, constant);
    }
    for Parameter { item, field, .. } in parameters {
        if let Some(default) = &item.default {
            put_default(&mut bytes, field, default);
        }
    }
    bytes
}

/// Returns whether the default value of an item matches the type of its field. A byte-string field accepts bytes, or text
/// that ISO 8859-1 can encode, if the value fits into the field. Any other field accepts a number or a Boolean. Also returns
/// true if the item has no default value.
pub(super) fn has_bytes(Parameter { item, field, .. }: &Parameter<'_>) -> bool {
    item.default.as_ref().is_none_or(|default| match (field.byte_string(), default) {
        (Some(length), Value::Text(text)) => {
            text.chars().count() <= length as usize && text.chars().all(|letter| u8::try_from(letter).is_ok())
        }
        (Some(length), Value::Bytes(bytes)) => bytes.len() <= length as usize,
        (Some(_), _) => false,
        (None, default) => default.as_real().is_some() || default.as_int().is_some(),
    })
}

/// Copies `data` to `bytes` at `offset`. Data beyond the end of `bytes` is ignored.
fn put(bytes: &mut [u8], offset: u32, data: &[u8]) {
    for (to, from) in bytes.iter_mut().skip(offset as usize).zip(data) {
        *to = *from;
    }
}

fn put_default(bytes: &mut [u8], field: &Field<'_>, default: &Value) {
    let position = field.position;
    if let Some(length) = field.byte_string() {
        let octets = match default {
            // ISO 8859-1 encodes a character as one byte.
            Value::Text(text) => text.chars().map(|letter| u8::try_from(letter).unwrap_or(b'?')).collect(),
            Value::Bytes(data) => data.clone(),
            _ => return,
        };
        return put(bytes, position.byte, &octets[..octets.len().min(length as usize)]);
    }
    let bits = match (field.is_real(), default.as_real(), default.as_int()) {
        (true, Some(value), _) if position.bits == 32 => u64::from((value as f32).to_bits()),
        (true, Some(value), _) => value.to_bits(),
        (false, _, Some(value)) => value as u64,
        (false, Some(value), None) => value as i64 as u64,
        _ => return,
    };
    for bit in 0..position.bits {
        let at = position.bit + bit;
        let (byte, mask) = bit_of(position.byte, position.bit + position.bits, at);
        if let Some(byte) = bytes.get_mut(byte) {
            *byte = if bits >> bit & 1 == 1 { *byte | mask } else { *byte & !mask };
        }
    }
}

/// Returns the byte position and the mask of bit `at` in a big-endian number. `first` is the position of the first byte
/// of the number, and `end` is the number of bits in the number.
fn bit_of(first: u32, end: u32, at: u32) -> (usize, u8) {
    let last = first + (end - 1) / 8;
    ((last - at / 8) as usize, 1 << (at % 8))
}

fn number_of(field: &Field<'_>, bytes: &[u8]) -> u64 {
    let position = field.position;
    (0..position.bits).fold(0, |number, bit| {
        let (byte, mask) = bit_of(position.byte, position.bit + position.bits, position.bit + bit);
        let is_set = bytes.get(byte).is_some_and(|byte| byte & mask != 0);
        number | u64::from(is_set) << bit
    })
}

/// Returns an expression for the value of the field in these bytes.
pub(super) fn value_of(field: &Field<'_>, bytes: &[u8]) -> Doc {
    let position = field.position;
    if let Some(length) = field.byte_string() {
        let octets = bytes.get(position.byte as usize..).and_then(|rest| rest.get(..length as usize)).unwrap_or(&[]);
        let is_zero = octets.iter().all(|byte| *byte == 0);
        return if is_zero { seq!["[0; ", length, "]"] } else { seq!["*", literal::bytes(octets)] };
    }
    let bits = number_of(field, bytes);
    if field.is_bool() {
        return Doc::from((bits != 0).to_string());
    }
    if field.is_real() {
        return Doc::from(match position.bits {
            32 => real(f32::from_bits(bits as u32).into(), 32),
            _ => real(f64::from_bits(bits), 64),
        });
    }
    let Some(range) = field.enumeration.map_or_else(|| field.range(), Enumeration::range) else {
        let (milliseconds, days) = (bits >> 16 & 0x0FFF_FFFF, bits & 0xFFFF);
        return call!(seq![field.rust_type(), "::new"], milliseconds, days);
    };
    let value = wrapped(bits, range);
    match field.enumeration {
        Some(enumeration) => enumeration_value(enumeration, value),
        None => Doc::from(value.to_string()),
    }
}

/// Returns the value that an integer with this minimum and maximum has if its bits are `bits`. Excess bits are ignored.
fn wrapped(bits: u64, range: (i128, i128)) -> i128 {
    let (low, high) = range;
    (i128::from(bits) - low).rem_euclid(high - low + 1) + low
}

fn enumeration_value(enumeration: &Enumeration, value: i128) -> Doc {
    match enumeration.variants.iter().find(|variant| variant.value == value) {
        Some(variant) => seq![enumeration.path, "::", variant.name],
        None => call!(seq![enumeration.path, "::Unknown"], value),
    }
}

fn real(value: f64, bits: u32) -> String {
    match literal::real(value, bits) {
        Some(literal) => literal,
        None if value.is_nan() => format!("f{bits}::NAN"),
        None if value > 0.0 => format!("f{bits}::INFINITY"),
        None => format!("f{bits}::NEG_INFINITY"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ir::Type;

    #[test]
    fn bits_as_integers() {
        let wrapped = |bits, ty: Type| wrapped(bits, ty.integer_range().unwrap());
        assert_eq!(wrapped(255, Type::Unsigned(8)), 255);
        assert_eq!(wrapped(255, Type::Integer(8)), -1);
        assert_eq!(wrapped(0x17F, Type::Integer(8)), 127, "the type of an enumeration can be narrower than its field");
        assert_eq!(wrapped(u64::MAX, Type::Integer(64)), -1);
        assert_eq!(wrapped(u64::MAX, Type::Unsigned(64)), i128::from(u64::MAX));
    }
}
