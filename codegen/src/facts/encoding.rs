//! Values as the bytes of an SDO transfer (CiA 301 7.1.4): the least significant byte comes first.

use crate::ir::{Type, Value};

/// Returns the bytes of a value of a basic type. Returns `None` for a formula, for a text that could not be converted to the
/// type, and for a number if the length of the type is unknown.
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

/// Returns whether a value fits a basic type. A formula fits only if its result fits for each node-ID.
pub fn fits(value: &Value, ty: Type) -> bool {
    /// Range of node-IDs.
    const NODES: (i128, i128) = (1, 127);
    let is_in_range = |number: &i128| ty.integer_range().is_some_and(|(low, high)| (low..=high).contains(number));
    match (value, ty) {
        (Value::Bool(_), Type::Boolean) => true,
        (Value::Int(_) | Value::Real(_), Type::Real64) => true,
        (Value::Int(_) | Value::Real(_), Type::Real32) => value.as_real().is_some_and(|real| (real as f32).is_finite()),
        (Value::Int(number), _) => is_in_range(number),
        (Value::NodeId(offset), _) => {
            [NODES.0, NODES.1].iter().all(|node| offset.checked_add(*node).is_some_and(|sum| is_in_range(&sum)))
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
