//! Reads the default values and allowed values of parameters.

use super::number::{hex, range};
use super::reader::Reader;
use crate::diagnostics::codes;
use crate::frontend::xml::Given;
use crate::ir::{Limits, Type, Value};
use crate::text::brief;

impl<'a> Reader<'a, '_> {
    /// Reads the default value of a parameter of the type `ty`. Reports an invalid value and keeps it as text.
    pub fn default_value(&mut self, given: &Given<'_>, ty: Type, bits: u32) -> Option<Value> {
        let text = given.text.as_ref();
        let value = match ty {
            Type::VisibleString(_) => {
                self.check_length(given, bits);
                return Some(Value::Text(text.into()));
            }
            Type::Boolean => boolean(text),
            Type::Integer(_) | Type::Unsigned(_) => self.integer(given, ty),
            Type::Real32 | Type::Real64 => real(text).map(Value::Real),
            Type::OctetString(_) => octets(text).map(Value::Bytes),
            _ => None,
        };
        if value.is_none() {
            let what = match ty {
                Type::Boolean => "0 or 1",
                Type::Integer(_) | Type::Unsigned(_) => "an integer",
                Type::Real32 | Type::Real64 => "a number",
                Type::OctetString(_) => "a list of octets, such as `0x00,0x1F`",
                _ => "a value of its data type",
            };
            let message = format!("the default value `{}` is not {what}", brief(text));
            self.diagnostics.push(codes::GSDML_DEFAULT.at(given.span, message).label("kept as text"));
        }
        Some(value.unwrap_or_else(|| Value::Raw(text.into())))
    }

    fn integer(&mut self, given: &Given<'_>, ty: Type) -> Option<Value> {
        let (value, is_plain) = whole(&given.text)?;
        if !is_plain {
            let message = format!("`{}` does not consist of decimal digits", given.text);
            let found = codes::GSDML_DEFAULT.at(given.span, message).label(format!("read as {value}"));
            self.diagnostics.push(found.fix(value.to_string()));
        }
        self.check_range(given, value, ty);
        Some(Value::Int(value))
    }

    /// Reports a number outside the range of its type.
    fn check_range(&mut self, given: &Given<'_>, value: i128, ty: Type) {
        let Some((low, high)) = ty.integer_range() else { return };
        if value < low || value > high {
            let message = format!("{value} is out of range for {ty} ({low} to {high})");
            self.diagnostics.push(codes::OUT_OF_TYPE.at(given.span, message).label("kept unchanged"));
        }
    }

    fn check_length(&mut self, given: &Given<'_>, bits: u32) {
        let length = given.text.chars().count();
        if length > bits as usize / 8 {
            let message =
                format!("the default value has {length} characters, but the parameter holds only {}", bits / 8);
            self.diagnostics.push(codes::OUT_OF_TYPE.at(given.span, message).label("kept unchanged"));
        }
    }

    /// Reads the allowed values of a parameter of the type `ty`.
    pub fn allowed_values(&mut self, given: &Given<'_>, ty: Type) -> Limits {
        let mut limits = Limits::default();
        if given.is_missing() {
            return limits;
        }
        let parse = match ty {
            Type::Boolean | Type::Integer(_) | Type::Unsigned(_) => integer_range,
            Type::Real32 | Type::Real64 => real_range,
            // The IR cannot express allowed values of other types, such as strings.
            _ => {
                limits.text = given.compact();
                return limits;
            }
        };
        for part in given.text.split_ascii_whitespace() {
            match parse(part) {
                Some((first, last)) if less(&last, &first) => {
                    self.bad_part(given, part, "the last value is less than the first", "read with the limits swapped");
                    add(&mut limits, last, first);
                }
                Some((first, last)) => add(&mut limits, first, last),
                None => self.bad_part(given, part, "neither a number nor a range `first..last`", "left out"),
            }
        }
        for value in [&limits.low, &limits.high].into_iter().flatten() {
            if let Value::Int(value) = *value {
                self.check_range(given, value, ty);
            }
        }
        limits
    }

    fn bad_part(&mut self, given: &Given<'_>, part: &str, why: &str, label: &str) {
        let message = format!("invalid allowed value `{}`: {why}", brief(part));
        self.diagnostics.push(codes::ALLOWED_VALUES.at(given.span_of(part), message).label(label));
    }
}

fn less(a: &Value, b: &Value) -> bool {
    match (a, b) {
        (Value::Int(a), Value::Int(b)) => a < b,
        _ => a.as_real() < b.as_real(),
    }
}

/// Adds a range to the allowed values. A single range is stored only as the minimum and the maximum.
fn add(limits: &mut Limits, first: Value, last: Value) {
    let (Some(low), Some(high)) = (&mut limits.low, &mut limits.high) else {
        (limits.low, limits.high) = (Some(first), Some(last));
        return;
    };
    if limits.allowed.is_empty() {
        limits.allowed.push((low.clone(), high.clone()));
    }
    if less(&first, low) {
        *low = first.clone();
    }
    if less(high, &last) {
        *high = last.clone();
    }
    limits.allowed.push((first, last));
}

fn boolean(text: &str) -> Option<Value> {
    match text {
        "0" | "false" => Some(Value::Bool(false)),
        "1" | "true" => Some(Value::Bool(true)),
        _ => None,
    }
}

/// Reads an integer in an allowed or default value. The Boolean is true for a decimal number, and false for a hexadecimal
/// number.
pub(super) fn whole(text: &str) -> Option<(i128, bool)> {
    let decimal = text.parse::<i64>().map(i128::from).or_else(|_| text.parse::<u64>().map(i128::from));
    match decimal {
        Ok(value) => Some((value, true)),
        Err(_) => hex(text).map(|value| (value.into(), false)),
    }
}

fn real(text: &str) -> Option<f64> {
    let is_number = text.bytes().all(|byte| matches!(byte, b'0'..=b'9' | b'+' | b'-' | b'.' | b'e' | b'E'));
    if is_number {
        text.parse().ok().filter(|value: &f64| value.is_finite())
    } else {
        None
    }
}

/// Reads octets such as `0x01,0x02`.
pub(super) fn octets(text: &str) -> Option<Vec<u8>> {
    text.split(',').map(|octet| u8::try_from(hex(octet.trim())?).ok()).collect()
}

fn integer_range(part: &str) -> Option<(Value, Value)> {
    range(part, |text| whole(text).map(|(value, _)| Value::Int(value)))
}

fn real_range(part: &str) -> Option<(Value, Value)> {
    range(part, |text| real(text).map(Value::Real))
}
