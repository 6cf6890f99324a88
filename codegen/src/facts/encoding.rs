//! Values as the bytes of an SDO transfer (CiA 301 7.1.4): the least significant byte comes first.

use crate::ir::{Type, Value};

/// Returns the bytes of a value of a basic type. Returns `None` for a formula, and for a text that could not be converted to the
/// type. Also returns `None` for a number or Boolean if the length of the type is unknown, or if the type has other values.
pub fn bytes(value: &Value, ty: Type) -> Option<Vec<u8>> {
    match (value, ty) {
        (Value::Bytes(bytes), _) => Some(bytes.clone()),
        (Value::Text(text), Type::UnicodeString(_)) => Some(text.encode_utf16().flat_map(u16::to_le_bytes).collect()),
        (Value::Text(text), _) => Some(text.as_bytes().to_vec()),
        (Value::Int(_) | Value::Real(_), Type::Real32) => Some((value.as_real()? as f32).to_le_bytes().to_vec()),
        (Value::Int(_) | Value::Real(_), Type::Real64) => Some(value.as_real()?.to_le_bytes().to_vec()),
        (Value::Int(_) | Value::Bool(_), Type::Boolean | Type::Integer(_) | Type::Unsigned(_)) => {
            number(value.as_int()?, ty)
        }
        (Value::Time { milliseconds, days }, _) => {
            Some([milliseconds.to_le_bytes().as_slice(), days.to_le_bytes().as_slice()].concat())
        }
        _ => None,
    }
}

/// Returns the bytes of a number, cut to the length of a basic type. Returns `None` if this length is unknown.
pub fn number(number: i128, ty: Type) -> Option<Vec<u8>> {
    let length = ty.bits()?.div_ceil(8) as usize;
    number.to_le_bytes().get(..length.min(16)).map(<[u8]>::to_vec)
}

/// Decodes the bytes of a value of a basic type: the inverse of [`bytes()`]. Returns `None` if the number of bytes is
/// not that of the type, or if a text is not valid. A text ends before its first zero.
pub fn value(bytes: &[u8], ty: Type) -> Option<Value> {
    if ty.bits().is_some_and(|bits| bytes.len() != bits.div_ceil(8) as usize) {
        return None;
    }
    match ty {
        Type::Boolean => Some(Value::Bool(*bytes.first()? != 0)),
        Type::Integer(bits) => Some(Value::Int(signed(bytes, bits))),
        Type::Unsigned(_) => Some(Value::Int(unsigned(bytes))),
        Type::Real32 => Some(Value::Real(f32::from_le_bytes(bytes.try_into().ok()?).into())),
        Type::Real64 => Some(Value::Real(f64::from_le_bytes(bytes.try_into().ok()?))),
        Type::VisibleString(_) => {
            let end = bytes.iter().position(|byte| *byte == 0).unwrap_or(bytes.len());
            Some(Value::Text(String::from_utf8(bytes.get(..end)?.to_vec()).ok()?.into()))
        }
        Type::UnicodeString(_) if bytes.len().is_multiple_of(2) => {
            let units = bytes.chunks_exact(2).map(|unit| u16::from_le_bytes([unit[0], unit[1]]));
            let units: Vec<u16> = units.take_while(|unit| *unit != 0).collect();
            Some(Value::Text(String::from_utf16(&units).ok()?.into()))
        }
        Type::UnicodeString(_) => None,
        Type::TimeOfDay | Type::TimeDifference => {
            let (milliseconds, days) = bytes.split_at_checked(4)?;
            let milliseconds = u32::from_le_bytes(milliseconds.try_into().ok()?);
            Some(Value::Time { milliseconds, days: u16::from_le_bytes(days.try_into().ok()?) })
        }
        Type::OctetString(_) | Type::Domain | Type::Time(_) | Type::Opaque(_) | Type::Named(_) => {
            Some(Value::Bytes(bytes.to_vec()))
        }
    }
}

fn unsigned(bytes: &[u8]) -> i128 {
    bytes.iter().rev().fold(0, |number, byte| number << 8 | i128::from(*byte))
}

fn signed(bytes: &[u8], bits: u8) -> i128 {
    let shift = 128 - u32::from(bits.clamp(1, 64));
    unsigned(bytes) << shift >> shift
}

/// Returns whether a value fits a basic type. A formula fits only if its result fits for each node-ID.
pub fn fits(value: &Value, ty: Type) -> bool {
    /// Range of node-IDs.
    const NODES: [i128; 2] = [1, 127];
    let is_in_range = |number: &i128| ty.integer_range().is_some_and(|(low, high)| (low..=high).contains(number));
    match (value, ty) {
        (Value::Bool(_), Type::Boolean) => true,
        (Value::Int(_) | Value::Real(_), Type::Real64) => true,
        (Value::Int(_) | Value::Real(_), Type::Real32) => value.as_real().is_some_and(|real| (real as f32).is_finite()),
        (Value::Int(number), _) => is_in_range(number),
        (Value::NodeId(offset), _) => {
            NODES.iter().all(|node| offset.checked_add(*node).is_some_and(|sum| is_in_range(&sum)))
        }
        (Value::Text(_), Type::VisibleString(_) | Type::UnicodeString(_)) => true,
        (Value::Bytes(_), Type::OctetString(_) | Type::Domain | Type::Opaque(_)) => true,
        (Value::Time { .. }, Type::TimeOfDay | Type::TimeDifference) => true,
        _ => false,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn least_significant_byte_first() {
        assert_eq!(bytes(&Value::Int(-2), Type::Integer(24)), Some(vec![0xFE, 0xFF, 0xFF]));
        assert_eq!(bytes(&Value::Int(1), Type::Real32), Some(vec![0, 0, 0x80, 0x3F]));
        assert_eq!(bytes(&Value::Text("aµ".into()), Type::UnicodeString(None)), Some(vec![0x61, 0, 0xB5, 0]));
        assert_eq!(bytes(&Value::Text("aµ".into()), Type::VisibleString(None)), Some("aµ".as_bytes().to_vec()));
        let time = Value::Time { milliseconds: 1, days: 2 };
        assert_eq!(bytes(&time, Type::TimeOfDay), Some(vec![1, 0, 0, 0, 2, 0]));
        assert_eq!(bytes(&Value::NodeId(1), Type::Unsigned(8)), None);
        assert_eq!(bytes(&Value::Int(1), Type::Domain), None);
    }

    #[test]
    fn bytes_become_the_value_that_they_encode() {
        for (value, ty) in [
            (Value::Int(-2), Type::Integer(24)),
            (Value::Int(i64::MIN.into()), Type::Integer(64)),
            (Value::Int(u64::MAX.into()), Type::Unsigned(64)),
            (Value::Bool(true), Type::Boolean),
            (Value::Real(1.5), Type::Real32),
            (Value::Real(-0.1), Type::Real64),
            (Value::Text("aµ".into()), Type::VisibleString(None)),
            (Value::Text("aµ".into()), Type::UnicodeString(None)),
            (Value::Bytes(vec![1, 2, 3]), Type::Domain),
            (Value::Time { milliseconds: 1, days: 2 }, Type::TimeOfDay),
        ] {
            let encoded = bytes(&value, ty).expect("a value of the type");
            assert_eq!(super::value(&encoded, ty), Some(value), "{ty}");
        }
        assert_eq!(value(&[1, 0], Type::Unsigned(8)), None, "too long");
        assert_eq!(value(&[], Type::Unsigned(8)), None, "too short");
        assert_eq!(value(&[0xFF], Type::VisibleString(None)), None, "no UTF-8");
        assert_eq!(value(b"ab\0\0", Type::VisibleString(Some(4))), Some(Value::Text("ab".into())));
    }

    #[test]
    fn values_of_the_type() {
        assert!(fits(&Value::Int(255), Type::Unsigned(8)));
        assert!(!fits(&Value::Int(256), Type::Unsigned(8)));
        assert!(fits(&Value::NodeId(128), Type::Unsigned(8)));
        assert!(!fits(&Value::NodeId(129), Type::Unsigned(8)), "node-ID 127");
        assert!(fits(&Value::NodeId(-1), Type::Unsigned(8)));
        assert!(!fits(&Value::NodeId(-2), Type::Unsigned(8)), "node-ID 1");
        assert!(!fits(&Value::Real(1e300), Type::Real32));
        assert!(fits(&Value::Real(1e300), Type::Real64));
        assert!(!fits(&Value::Raw("x".into()), Type::VisibleString(None)));
        assert!(!fits(&Value::Text("x".into()), Type::Unsigned(8)));
    }
}
