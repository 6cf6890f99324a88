//! Values of a simulated device: lengths, limits and initial values.

use std::vec;
use std::vec::Vec;

use crate::abort::AbortCode;
use crate::data_type::DataType;
use crate::node_id::NodeId;
use crate::pdo::{from_bytes, mask, sign_extend};
use crate::table::{Bound, Entry, RawInitial};

/// Returns the length of a type in bytes, or `None` if the length depends on the value.
pub(super) fn byte_length(data_type: DataType) -> Option<usize> {
    data_type.bits().map(|bits| bits.div_ceil(8) as usize)
}

/// Extends a value to the length of its type. A value of a signed type is sign-extended.
pub(super) fn widened(data_type: DataType, mut bytes: Vec<u8>) -> Vec<u8> {
    if let Some(length) = byte_length(data_type) {
        let is_negative = data_type.is_signed() && bytes.last().is_some_and(|last| last >> 7 == 1);
        bytes.resize(length, if is_negative { 0xFF } else { 0 });
    }
    bytes
}

/// Converts an integer from type `from` to type `to`. Returns an error if the integer does not fit.
pub(super) fn resized(from: DataType, bytes: &[u8], to: DataType) -> Result<Vec<u8>, AbortCode> {
    let (Some(length), Some(other)) = (byte_length(from), byte_length(to)) else { return Err(AbortCode::LENGTH) };
    let (narrow, sign) = if length < other { (length, from.is_signed()) } else { (other, to.is_signed()) };
    let is_negative = sign && narrow.checked_sub(1).and_then(|last| bytes.get(last)).is_some_and(|last| last >> 7 == 1);
    let fill = if is_negative { 0xFF } else { 0 };
    if bytes.get(narrow..).unwrap_or_default().iter().any(|byte| *byte != fill) {
        return Err(AbortCode::TOO_HIGH);
    }
    let mut bytes = bytes.to_vec();
    bytes.resize(other, fill);
    Ok(bytes)
}

/// Checks that `data` has a length that the type of the item allows.
pub(super) fn check_length(entry: &Entry, data: &[u8]) -> Result<(), AbortCode> {
    match byte_length(entry.data_type) {
        Some(length) if data.len() > length => Err(AbortCode::TOO_LONG),
        Some(length) if data.len() < length => Err(AbortCode::TOO_SHORT),
        None if entry.data_type == DataType::UnicodeString && data.len() % 2 == 1 => Err(AbortCode::LENGTH),
        _ => Ok(()),
    }
}

/// Checks that a value is within its limits. The value must have the length of its type.
pub(super) fn check_range(entry: &Entry, data: &[u8]) -> Result<(), AbortCode> {
    let Some(bits) = entry.data_type.bits() else { return Ok(()) };
    match entry.data_type {
        DataType::Real32 => check_real(entry, data.try_into().map_or(0.0, f32::from_le_bytes).into()),
        DataType::Real64 => check_real(entry, data.try_into().map_or(0.0, f64::from_le_bytes)),
        DataType::TimeOfDay | DataType::TimeDifference => Ok(()),
        data_type => {
            let raw = from_bytes(data);
            if data_type.is_signed() {
                return check_limits(integer(entry.low), integer(entry.high), sign_extend(raw, bits).into());
            }
            // For example, a 3-bit number is sent in a whole byte.
            if raw > mask(bits) {
                return Err(AbortCode::TOO_HIGH);
            }
            check_limits(integer(entry.low), integer(entry.high), raw.into())
        }
    }
}

fn check_limits<T: PartialOrd>(low: Option<T>, high: Option<T>, value: T) -> Result<(), AbortCode> {
    if low.is_some_and(|low| value < low) {
        return Err(AbortCode::TOO_LOW);
    }
    if high.is_some_and(|high| value > high) {
        return Err(AbortCode::TOO_HIGH);
    }
    Ok(())
}

fn integer(bound: Bound) -> Option<i128> {
    match bound {
        Bound::Signed(value) => Some(value.into()),
        Bound::Unsigned(value) => Some(value.into()),
        Bound::Real(_) | Bound::Unlimited => None,
    }
}

fn check_real(entry: &Entry, value: f64) -> Result<(), AbortCode> {
    let (low, high) = (real(entry.low), real(entry.high));
    if value.is_nan() && (low.is_some() || high.is_some()) {
        return Err(AbortCode::INVALID_VALUE);
    }
    check_limits(low, high, value)
}

fn real(bound: Bound) -> Option<f64> {
    match bound {
        Bound::Real(value) => Some(value),
        Bound::Signed(value) => Some(value as f64),
        Bound::Unsigned(value) => Some(value as f64),
        Bound::Unlimited => None,
    }
}

/// Returns the initial value after power-on. If the device description declares no value, a text or byte string is
/// empty, and a number is the number within the limits that is nearest to 0.
pub(super) fn initial(entry: &Entry, node: NodeId) -> Vec<u8> {
    let bytes = match entry.initial {
        RawInitial::Bytes(bytes) => bytes.to_vec(),
        RawInitial::NodeId(offset) => offset.wrapping_add(node.get().into()).to_le_bytes().to_vec(),
        RawInitial::Unknown => nearest_to_zero(entry),
    };
    widened(entry.data_type, bytes)
}

fn nearest_to_zero(entry: &Entry) -> Vec<u8> {
    match entry.data_type {
        DataType::Real32 => (nearest_real(entry) as f32).to_le_bytes().to_vec(),
        DataType::Real64 => nearest_real(entry).to_le_bytes().to_vec(),
        data_type => {
            let low = integer(entry.low).unwrap_or(0).max(0);
            let nearest = integer(entry.high).map_or(low, |high| low.min(high));
            match byte_length(data_type) {
                // The integer has at most 64 bits, so the conversion is lossless.
                Some(_) => (nearest as u64).to_le_bytes().to_vec(),
                None => vec![],
            }
        }
    }
}

fn nearest_real(entry: &Entry) -> f64 {
    let low = real(entry.low).unwrap_or(0.0).max(0.0);
    real(entry.high).map_or(low, |high| low.min(high))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::flags::Flags;
    use crate::table::AccessRights;

    const ENTRY: Entry = Entry {
        object: None,
        register: None,
        name: "",
        data_type: DataType::Integer24,
        access: AccessRights::ReadWrite,
        flags: Flags::NONE,
        initial: RawInitial::Unknown,
        configured: None,
        low: Bound::Signed(-2),
        high: Bound::Signed(300),
        unit: "",
    };

    fn check(entry: &Entry, data: &[u8]) -> Result<(), AbortCode> {
        check_length(entry, data)?;
        check_range(entry, data)
    }

    fn node() -> NodeId {
        NodeId::new(5).unwrap()
    }

    #[test]
    fn integers() {
        assert_eq!(check(&ENTRY, &[0xFE, 0xFF, 0xFF]), Ok(()));
        assert_eq!(check(&ENTRY, &[0xFD, 0xFF, 0xFF]), Err(AbortCode::TOO_LOW));
        assert_eq!(check(&ENTRY, &[0x2D, 0x01, 0x00]), Err(AbortCode::TOO_HIGH));
        assert_eq!(check(&ENTRY, &[0; 2]), Err(AbortCode::TOO_SHORT));
        assert_eq!(check(&ENTRY, &[0; 4]), Err(AbortCode::TOO_LONG));
        let (low, high) = (Bound::Unsigned(1), Bound::Unsigned(u64::MAX - 1));
        let long = Entry { data_type: DataType::Unsigned64, low, high, ..ENTRY };
        assert_eq!(check(&long, &[0xFF; 8]), Err(AbortCode::TOO_HIGH));
        assert_eq!(check(&long, &[0; 8]), Err(AbortCode::TOO_LOW));
        assert_eq!(initial(&long, node()), [1, 0, 0, 0, 0, 0, 0, 0]);
    }

    #[test]
    fn few_bits() {
        let limits = (Bound::Unlimited, Bound::Unlimited);
        let flag = Entry { data_type: DataType::Boolean, low: limits.0, high: limits.1, ..ENTRY };
        assert_eq!((check(&flag, &[1]), check(&flag, &[2])), (Ok(()), Err(AbortCode::TOO_HIGH)));
        let three = Entry { data_type: DataType::Bits(3), ..flag };
        assert_eq!((check(&three, &[7]), check(&three, &[8])), (Ok(()), Err(AbortCode::TOO_HIGH)));
    }

    #[test]
    fn reals() {
        let real = Entry { data_type: DataType::Real32, low: Bound::Real(0.5), high: Bound::Unlimited, ..ENTRY };
        assert_eq!(check(&real, &f32::NAN.to_le_bytes()), Err(AbortCode::INVALID_VALUE));
        assert_eq!(check(&real, &0.4_f32.to_le_bytes()), Err(AbortCode::TOO_LOW));
        assert_eq!(check(&real, &0.5_f32.to_le_bytes()), Ok(()));
        assert_eq!(initial(&real, node()), 0.5_f32.to_le_bytes());
        let free = Entry { data_type: DataType::Real64, low: Bound::Unlimited, ..real };
        assert_eq!(check(&free, &f64::NAN.to_le_bytes()), Ok(()));
    }

    #[test]
    fn texts_and_times() {
        let text = Entry { data_type: DataType::UnicodeString, ..ENTRY };
        assert_eq!(check(&text, &[1]), Err(AbortCode::LENGTH));
        assert_eq!(check(&text, &[]), Ok(()));
        assert_eq!(initial(&text, node()), []);
        let time = Entry { data_type: DataType::TimeOfDay, ..ENTRY };
        assert_eq!(check(&time, &[0xFF; 6]), Ok(()));
        assert_eq!(check(&time, &[0; 8]), Err(AbortCode::TOO_LONG));
    }

    #[test]
    fn defaults() {
        let cob_id = Entry { data_type: DataType::Unsigned32, initial: RawInitial::NodeId(0x8000_0200), ..ENTRY };
        assert_eq!(initial(&cob_id, node()), 0x8000_0205_u32.to_le_bytes());
        assert_eq!(initial(&Entry { high: Bound::Signed(-1), ..ENTRY }, node()), [0xFF; 3]);
        assert_eq!(widened(DataType::Integer32, vec![0xFE, 0xFF]), [0xFE, 0xFF, 0xFF, 0xFF]);
        assert_eq!(widened(DataType::Unsigned32, vec![0xFE, 0xFF]), [0xFE, 0xFF, 0, 0]);
    }
}
