//! Converts default values and limits to the type of their item. A file contains each value as bytes, a number or a
//! text.

use std::cmp::Ordering;

use super::info_value::{Form, RawValue};
use super::number;
use super::reader::Reader;
use crate::diagnostics::codes;
use crate::ir::{CompactString, Type, Value};
use crate::text::{brief, count_of};

/// Role of a value: default value or limit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Role {
    Default,
    Limit,
}

/// Converts a value to the type `ty`, which must not be an alias or enumeration.
pub(super) fn convert(reader: &mut Reader<'_, '_>, raw: &RawValue<'_>, ty: Type, role: Role) -> Option<Value> {
    match raw.form {
        Form::Data => data(reader, raw, ty),
        Form::Number => Some(number(reader, raw, ty, role)),
        Form::Text => Some(text(reader, raw, ty, role)),
    }
}

/// Converts bytes in hexadecimal notation to a value. The least significant byte of a number comes first. Returns `None` if the
/// text contains characters other than hexadecimal digits and white space.
fn data(reader: &mut Reader<'_, '_>, raw: &RawValue<'_>, ty: Type) -> Option<Value> {
    let bytes = reader.octets(&raw.given())?;
    match ty {
        Type::Boolean | Type::Integer(_) | Type::Unsigned(_) | Type::Real32 | Type::Real64 => {
            Some(scalar(reader, raw, ty, bytes))
        }
        Type::VisibleString(_) => {
            let end = bytes.iter().rposition(|&byte| byte != 0).map_or(0, |last| last + 1);
            Some(Value::Text(latin(bytes.get(..end).unwrap_or(&[]))))
        }
        Type::UnicodeString(_) => {
            let units = bytes.chunks_exact(2).filter_map(|pair| Some(u16::from_le_bytes(pair.try_into().ok()?)));
            let text: CompactString =
                char::decode_utf16(units).map(|c| c.unwrap_or(char::REPLACEMENT_CHARACTER)).collect();
            Some(Value::Text(text.trim_end_matches('\0').into()))
        }
        _ => Some(Value::Bytes(bytes)),
    }
}

/// Decodes bytes as UTF-8, or as ISO 8859-1 if they are not valid UTF-8.
fn latin(bytes: &[u8]) -> CompactString {
    match std::str::from_utf8(bytes) {
        Ok(text) => text.into(),
        Err(_) => bytes.iter().map(|&byte| char::from(byte)).collect(),
    }
}

fn scalar(reader: &mut Reader<'_, '_>, raw: &RawValue<'_>, ty: Type, bytes: Vec<u8>) -> Value {
    let bits = ty.bits().unwrap_or(0);
    let length = bits.div_ceil(8) as usize;
    let rest = bytes.get(length..).unwrap_or(&[]);
    if bytes.len() != length && reader.diagnostics.wants(&codes::HEX_LENGTH) {
        let label = match bytes.len().cmp(&length) {
            Ordering::Less => "missing bytes are read as zeros",
            _ if rest.iter().any(|&byte| byte != 0) => "kept as raw bytes",
            _ => "the zeros after the value are ignored",
        };
        let message = format!("{ty} has {}, but the value has {}", count_of(length, "byte"), bytes.len());
        reader.report(&codes::HEX_LENGTH, raw.span, message, label);
    }
    if rest.iter().any(|&byte| byte != 0) {
        return Value::Bytes(bytes);
    }
    let pattern = bytes.iter().take(length.min(8)).rev().fold(0u64, |value, &byte| value << 8 | u64::from(byte));
    match ty {
        Type::Boolean => Value::Bool(pattern != 0),
        Type::Real32 => Value::Real(f64::from(f32::from_bits(pattern as u32))),
        Type::Real64 => Value::Real(f64::from_bits(pattern)),
        // Missing bytes are zeros, so a short number is never negative.
        Type::Integer(bits) if bytes.len() == length => Value::Int(signed(pattern, bits)),
        _ => Value::Int(i128::from(pattern)),
    }
}

fn signed(pattern: u64, bits: u8) -> i128 {
    let (pattern, modulus) = (i128::from(pattern), 1i128 << bits.min(64));
    if pattern >= modulus / 2 {
        pattern - modulus
    } else {
        pattern
    }
}

fn number(reader: &mut Reader<'_, '_>, raw: &RawValue<'_>, ty: Type, role: Role) -> Value {
    let given = &raw.given();
    match ty {
        Type::Real32 | Type::Real64 => real(reader, raw, ty),
        Type::Boolean => match given.text.as_ref() {
            "0" | "false" => Value::Bool(false),
            "1" | "true" => Value::Bool(true),
            _ => integer(reader, raw, ty, role),
        },
        Type::VisibleString(_) | Type::UnicodeString(_) => {
            let message = "the data type is a string, but the value is given as a number";
            reader.report(&codes::VALUE_FORM, given.span, message, "read as text");
            Value::Text(given.compact())
        }
        _ => integer(reader, raw, ty, role),
    }
}

fn integer(reader: &mut Reader<'_, '_>, raw: &RawValue<'_>, ty: Type, role: Role) -> Value {
    let given = &raw.given();
    let Some(number) = reader.parse(given) else { return fraction(reader, raw, ty) };
    let value = number.value;
    let Some((low, high)) = ty.integer_range() else { return Value::Int(value) };
    if (low..=high).contains(&value) {
        return if ty == Type::Boolean { Value::Bool(value != 0) } else { Value::Int(value) };
    }
    // A hexadecimal number without a sign can be the bit pattern of a negative number.
    if number.hex && ty.is_signed() && value <= high - low {
        return Value::Int(value - (high - low + 1));
    }
    if value == -1 && !ty.is_signed() && ty != Type::Boolean {
        let message = format!("the value is -1, but {ty} is unsigned");
        reader.report(&codes::MINUS_ONE, given.span, message, format!("read as all ones: {high}"));
        return Value::Int(high);
    }
    if reader.diagnostics.wants(&codes::ESI_OUT_OF_TYPE) {
        let what = if role == Role::Limit { "limit" } else { "default value" };
        let message = format!("the {what} {} is out of range for {ty} ({low} to {high})", brief(&given.text));
        reader.report(&codes::ESI_OUT_OF_TYPE, given.span, message, "kept unchanged");
    }
    Value::Int(value)
}

/// Reads and reports a text that is not an integer, although its type is an integer type. A number with a zero
/// fraction, such as `5.0`, becomes an integer. Any other text is kept unchanged.
fn fraction(reader: &mut Reader<'_, '_>, raw: &RawValue<'_>, ty: Type) -> Value {
    let given = &raw.given();
    let whole = given.text.split_once('.').filter(|(_, rest)| rest.bytes().all(|digit| digit == b'0'));
    if let Some(number) = whole.and_then(|(whole, _)| number::parse(whole)) {
        let message = format!("the value is a decimal fraction, but the type is {ty}");
        let found = codes::VALUE_FORM.at(given.span, message).label(format!("read as {}", number.value));
        reader.diagnostics.push(found.fix(number.value.to_string()));
        return Value::Int(number.value);
    }
    let message = format!("`{}` is not a value of the type {ty}", brief(&given.text));
    reader.report(&codes::VALUE_FORM, given.span, message, "kept as text");
    Value::Raw(given.compact())
}

/// Converts a number to a real type. A hexadecimal number is a bit pattern if it has exactly as many digits as the type
/// needs.
fn real(reader: &mut Reader<'_, '_>, raw: &RawValue<'_>, ty: Type) -> Value {
    let given = &raw.given();
    let decimal = |byte: u8| byte.is_ascii_digit() || matches!(byte, b'.' | b'-' | b'+' | b'e' | b'E');
    let value = given.text.parse::<f64>().ok().filter(|value| value.is_finite());
    if let Some(value) = value.filter(|_| given.text.bytes().all(decimal)) {
        return Value::Real(value);
    }
    let Some(number) = reader.parse(given) else {
        let message = format!("`{}` is not a value of the type {ty}", brief(&given.text));
        reader.report(&codes::VALUE_FORM, given.span, message, "kept as text");
        return Value::Raw(given.compact());
    };
    let digits = given.text.len().saturating_sub(2) as u32;
    let bits = ty.bits().unwrap_or(32);
    if number.hex && number.fault.is_none() && digits * 4 == bits {
        let pattern = number.value as u64;
        let value = if bits == 32 { f64::from(f32::from_bits(pattern as u32)) } else { f64::from_bits(pattern) };
        return Value::Real(value);
    }
    let value = number.value as f64;
    let message = format!("{} does not have the {} digits of a {ty} bit pattern", brief(&given.text), bits / 4);
    reader.report(&codes::VALUE_FORM, given.span, message, format!("read as the number {value}"));
    Value::Real(value)
}

fn text(reader: &mut Reader<'_, '_>, raw: &RawValue<'_>, ty: Type, role: Role) -> Value {
    match ty {
        Type::VisibleString(_) | Type::UnicodeString(_) => Value::Text(raw.given().compact()),
        Type::OctetString(_) => Value::Bytes(raw.text.as_bytes().to_vec()),
        Type::Opaque(_) | Type::Named(_) | Type::Domain => Value::Text(raw.given().compact()),
        _ => {
            let message = format!("the value is in DefaultString, but the type is {ty}");
            reader.report(&codes::VALUE_FORM, raw.span, message, "read as a number");
            number(reader, raw, ty, role)
        }
    }
}
