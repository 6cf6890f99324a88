//! Converts literals in the file to values of a data type.

use thin_vec::ThinVec;

use super::at::{At, Literal};
use super::notation;
use super::tree::{text_of, Reader};
use crate::diagnostics::codes;
use crate::ir::{Type, Value};
use crate::limits::MAX_LISTED_VALUES;
use crate::source::Span;
use crate::text::brief;

/// Converts a literal to a value of a type that is not an alias. Reports an unsuitable literal and keeps it as text.
pub(super) fn value(reader: &mut Reader<'_, '_>, given: &At<Literal>, ty: Type) -> Value {
    let is_pattern = reader.is_pattern(given);
    match convert(&given.value, ty, is_pattern) {
        Some(value) => {
            super::lints::number(reader, given, &value, ty);
            value
        }
        None => {
            let text = text_of(&given.value);
            let span = reader.span(given);
            let diagnostic = codes::TABLE_VALUE.at(span, format!("`{}` is not a value of the type {ty}", brief(&text)));
            let is_real = matches!(given.value, Literal::Real(_));
            let help = "write raw values: limits and defaults apply before `scale`";
            reader.diagnostics.push(if is_real { diagnostic.help(help) } else { diagnostic });
            Value::Raw(text.into())
        }
    }
}

/// Converts a list of values and ranges (`"3..7"`) to pairs of first and last value. Reports invalid elements, and leaves them
/// out.
pub(super) fn ranges(
    reader: &mut Reader<'_, '_>,
    list: &[Literal],
    whole: (u32, u32),
    ty: Type,
) -> ThinVec<(Value, Value)> {
    let mut found = ThinVec::with_capacity(list.len());
    for literal in reader.each(list, whole) {
        match range(reader, &literal, ty) {
            Some(range) => found.push(range),
            None => {
                let what = if matches!(ty, Type::Opaque(_)) { "number".to_owned() } else { format!("value of {ty}") };
                let message = format!("`{}` is neither a {what} nor a range of them", brief(&text_of(&literal.value)));
                let diagnostic = codes::TABLE_VALUE.at(reader.span(&literal), message);
                reader.diagnostics.push(diagnostic.help("write `3`, or `\"3..7\"` for a range"));
            }
        }
    }
    found
}

/// Returns the first and last value of a list element, or `None` if the element is invalid.
pub(super) fn range(reader: &Reader<'_, '_>, literal: &At<Literal>, ty: Type) -> Option<(Value, Value)> {
    match &literal.value {
        Literal::Text(text) if has_numbers(ty) => {
            let (first, last) = notation::range(text)?;
            let is_pattern = text.contains("0x") || text.contains("0b");
            let one = |number| convert(&Literal::Int(number), ty, is_pattern).unwrap_or(Value::Int(number));
            // Bit patterns in ascending order may be signed values in descending order.
            let in_order = first <= last && one(first).as_int() <= one(last).as_int();
            in_order.then(|| (one(first), one(last)))
        }
        other => convert(other, ty, reader.is_pattern(literal)).map(|value| (value.clone(), value)),
    }
}

/// Returns whether the values of a type are integers or BOOLEAN. Values of an unknown type count as integers.
fn has_numbers(ty: Type) -> bool {
    matches!(ty, Type::Integer(_) | Type::Unsigned(_) | Type::Opaque(_) | Type::Boolean)
}

/// Converts a list of values and ranges to a list of single values. Reports a range that would extend the list to more than
/// [`MAX_LISTED_VALUES`] values, and leaves it out.
pub(super) fn listed(reader: &mut Reader<'_, '_>, list: &[Literal], whole: (u32, u32), ty: Type) -> Vec<Value> {
    let mut values: Vec<Value> = Vec::new();
    let fits = |values: &[Value], low: i128, high: i128| {
        high.checked_sub(low).is_some_and(|more| more.saturating_add(values.len() as i128) < MAX_LISTED_VALUES)
    };
    for (first, last) in ranges(reader, list, whole, ty) {
        match (first.as_int(), last.as_int()) {
            (Some(low), Some(high)) if low < high && fits(&values, low, high) => {
                values.extend((low..=high).map(Value::Int));
            }
            (Some(low), Some(high)) if low < high => {
                let message = format!("with {low} to {high}, the list has more than {MAX_LISTED_VALUES} values");
                reader.report(&codes::TABLE_VALUE, Span::new(reader.file, whole.0, whole.1), message);
            }
            _ => values.push(first),
        }
    }
    values
}

/// Converts a literal to a value. `is_pattern` means that the digits are a bit pattern, whose highest bit is the sign
/// of a signed type. Returns `None` if the literal does not suit the type. The range of the type is not checked.
pub(super) fn convert(literal: &Literal, ty: Type, is_pattern: bool) -> Option<Value> {
    if let Literal::Text(text) = literal {
        return of_text(text, ty);
    }
    Some(match (ty, literal) {
        (Type::Boolean, Literal::Int(value @ (0 | 1))) => Value::Bool(*value == 1),
        (Type::Real32 | Type::Real64, Literal::Int(value)) => Value::Real(*value as f64),
        (Type::Integer(bits), Literal::Int(value)) => Value::Int(signed(*value, bits, is_pattern)),
        (Type::VisibleString(_) | Type::UnicodeString(_) | Type::OctetString(_), _) => return None,
        (Type::Integer(_) | Type::Unsigned(_), Literal::Real(_)) => return None,
        (_, Literal::Bool(value)) => Value::Bool(*value),
        (_, Literal::Int(value)) => Value::Int(*value),
        (_, Literal::Real(value)) => Value::Real(*value),
        (_, Literal::Text(_)) => return None,
    })
}

/// Returns the value of a number or bit pattern in the type `ty`.
pub(super) fn integer(value: i128, ty: Type, is_pattern: bool) -> i128 {
    match ty {
        Type::Integer(bits) => signed(value, bits, is_pattern),
        _ => value,
    }
}

/// Returns the signed value of a number. A bit pattern is negative if its sign bit is set.
fn signed(value: i128, bits: u8, is_pattern: bool) -> i128 {
    let modulus = 1i128 << bits.min(64);
    if is_pattern && value >= modulus / 2 && value < modulus {
        value - modulus
    } else {
        value
    }
}

fn of_text(text: &str, ty: Type) -> Option<Value> {
    match ty {
        Type::VisibleString(_) | Type::UnicodeString(_) | Type::Domain | Type::Opaque(_) => {
            Some(Value::Text(text.into()))
        }
        Type::OctetString(_) => octets(text).map(Value::Bytes),
        Type::Real32 | Type::Real64 => text.parse().ok().map(Value::Real),
        Type::Boolean => None,
        _ => node_id(text).map(Value::NodeId).or_else(|| {
            let digits = text.trim_start_matches(['+', '-']);
            let value = notation::integer(text)?;
            convert(&Literal::Int(value), ty, digits.starts_with("0x") || digits.starts_with("0b"))
        }),
    }
}

/// Reads a node-ID formula: `$NODEID`, `$NODEID+0x80`, `0x80+$NODEID`.
fn node_id(text: &str) -> Option<i128> {
    let text: String = text.chars().filter(|c| !c.is_whitespace()).collect();
    let rest = match (text.strip_prefix("$NODEID"), text.strip_suffix("+$NODEID")) {
        (Some(rest), _) => rest,
        (None, Some(rest)) => rest,
        (None, None) => return None,
    };
    if rest.is_empty() {
        return Some(0);
    }
    notation::integer(rest)
}

/// Reads bytes: `01 02`, `0x01,0x02`, `0102`.
fn octets(text: &str) -> Option<Vec<u8>> {
    let digits = text.replace("0x", "").replace([' ', ',', ':'], "");
    if !digits.is_ascii() || !digits.len().is_multiple_of(2) {
        return None;
    }
    (0..digits.len()).step_by(2).map(|at| u8::from_str_radix(digits.get(at..at + 2)?, 16).ok()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn literals_become_values_of_their_type() {
        let int = |value| Literal::Int(value);
        let text = |text: &str| Literal::Text(text.into());
        assert_eq!(convert(&int(0x8000), Type::Integer(16), true), Some(Value::Int(-32768)));
        assert_eq!(convert(&int(0x8000), Type::Integer(16), false), Some(Value::Int(0x8000)));
        assert_eq!(convert(&int(1), Type::Boolean, false), Some(Value::Bool(true)));
        assert_eq!(convert(&int(2), Type::Real32, false), Some(Value::Real(2.0)));
        assert_eq!(convert(&int(2), Type::VisibleString(None), false), None);
        assert_eq!(convert(&text("$NODEID+0x80"), Type::Unsigned(32), false), Some(Value::NodeId(0x80)));
        assert_eq!(convert(&text("0x80 + $NODEID"), Type::Unsigned(32), false), Some(Value::NodeId(0x80)));
        assert_eq!(convert(&text("0xFF"), Type::Integer(8), false), Some(Value::Int(-1)));
        assert_eq!(convert(&text("x"), Type::Unsigned(8), false), None);
        assert_eq!(convert(&text("01 02"), Type::OctetString(None), false), Some(Value::Bytes(vec![1, 2])));
        assert_eq!(convert(&text("é"), Type::OctetString(None), false), None);
    }
}
