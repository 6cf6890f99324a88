//! Value types of items, and the encoding of types with a fixed size.

use crate::data_type::DataType;
use crate::range::Range;
use crate::raw_value::RawValue;
use crate::value_error::{LengthError, OutOfRange};

/// The type of an item's value.
pub trait Value {
    /// Rust type of the value.
    type Native: Copy + 'static;

    /// Data type in the object dictionary.
    const DATA_TYPE: DataType;
}

/// A type of at most 64 bits with a fixed length. The encoding starts with the least significant byte (CiA 301 7.1.4).
///
/// Generated newtypes and enumerations implement this trait with the encoding of their integer type.
pub trait Fixed: Value {
    /// Size in bits, 1 to 64. The length of the encoding is `BITS` rounded up to whole bytes.
    const BITS: u32;

    /// Encodes `native` at the start of `buffer` and returns the length in bytes.
    ///
    /// # Errors
    ///
    /// Returns [`OutOfRange`] if `native` doesn't fit in [`BITS`](Fixed::BITS) bits.
    fn encode(native: Self::Native, buffer: &mut [u8; 8]) -> Result<usize, OutOfRange>;

    /// Decodes a value. `bytes` must have exactly the length of the encoding.
    ///
    /// # Errors
    ///
    /// Returns [`LengthError`] if `bytes` doesn't have the length of the encoding.
    fn decode(bytes: &[u8]) -> Result<Self::Native, LengthError>;

    /// Returns whether `range` contains `value`.
    fn in_range(value: Self::Native, range: &Range<Self::Native>) -> bool;

    /// Returns the raw value for error messages, or `None` if the value isn't a number.
    #[inline]
    fn raw_value(native: Self::Native) -> Option<RawValue> {
        let _ = native;
        None
    }
}

/// Writes `raw` to `buffer`. Returns the number of bytes that `bits` bits occupy.
#[inline]
pub(crate) fn encode_raw(raw: u64, bits: u32, buffer: &mut [u8; 8]) -> usize {
    *buffer = raw.to_le_bytes();
    byte_len(bits)
}

/// Decodes a number of `bits` bits from a slice. The slice must have exactly the number of bytes that the bits of the
/// number occupy.
#[inline]
pub(crate) fn decode_raw(bytes: &[u8], bits: u32) -> Result<u64, LengthError> {
    let expected = byte_len(bits);
    if bytes.len() != expected {
        return Err(LengthError { expected, actual: bytes.len() });
    }
    Ok(crate::pdo::from_bytes(bytes))
}

/// Returns the number of bytes for `bits` bits, at most 8.
#[inline]
pub(crate) const fn byte_len(bits: u32) -> usize {
    match bits {
        0..=64 => bits.div_ceil(8) as usize,
        _ => 8,
    }
}

impl Value for bool {
    type Native = Self;
    const DATA_TYPE: DataType = DataType::Boolean;
}

/// One byte with the value 0 or 1. Every value except 0 is read as `true`.
impl Fixed for bool {
    const BITS: u32 = 1;

    #[inline]
    fn encode(native: Self, buffer: &mut [u8; 8]) -> Result<usize, OutOfRange> {
        Ok(encode_raw(u64::from(native), Self::BITS, buffer))
    }

    #[inline]
    fn decode(bytes: &[u8]) -> Result<Self, LengthError> {
        decode_raw(bytes, Self::BITS).map(|raw| raw != 0)
    }

    #[inline]
    fn in_range(value: Self, range: &Range<Self>) -> bool {
        range.contains(value)
    }

    #[inline]
    fn raw_value(native: Self) -> Option<RawValue> {
        Some(native.into())
    }
}

macro_rules! fixed {
    ($($native:ty, $bits:literal, $data_type:ident, $value:ident => $raw:expr;)*) => {$(
        impl Value for $native {
            type Native = Self;
            const DATA_TYPE: DataType = DataType::$data_type;
        }

        impl Fixed for $native {
            const BITS: u32 = $bits;

            #[inline]
            fn encode($value: Self, buffer: &mut [u8; 8]) -> Result<usize, OutOfRange> {
                Ok(encode_raw($raw, $bits, buffer))
            }

            #[inline]
            fn decode(bytes: &[u8]) -> Result<Self, LengthError> {
                match bytes.try_into() {
                    Ok(bytes) => Ok(Self::from_le_bytes(bytes)),
                    Err(_) => Err(LengthError { expected: $bits / 8, actual: bytes.len() }),
                }
            }

            #[inline]
            fn in_range(value: Self, range: &Range<Self>) -> bool {
                range.contains(value)
            }

            #[inline]
            fn raw_value(native: Self) -> Option<RawValue> {
                Some(native.into())
            }
        }
    )*};
}

fixed! {
    u8, 8, Unsigned8, value => value.into();
    u16, 16, Unsigned16, value => value.into();
    u32, 32, Unsigned32, value => value.into();
    u64, 64, Unsigned64, value => value;
    i8, 8, Integer8, value => (value as u8).into();
    i16, 16, Integer16, value => (value as u16).into();
    i32, 32, Integer32, value => (value as u32).into();
    i64, 64, Integer64, value => value as u64;
    f32, 32, Real32, value => value.to_bits().into();
    f64, 64, Real64, value => value.to_bits();
}

#[cfg(test)]
mod tests {
    use super::*;

    fn round_trip<V: Fixed>(native: V::Native, bytes: &[u8])
    where
        V::Native: PartialEq + core::fmt::Debug,
    {
        let mut buffer = [0xAA; 8];
        let length = V::encode(native, &mut buffer).unwrap();
        assert_eq!(&buffer[..length], bytes);
        assert_eq!(V::decode(bytes), Ok(native));
        assert_eq!(V::DATA_TYPE.bits(), Some(V::BITS));
        let actual = length - 1;
        assert_eq!(V::decode(&bytes[..actual]), Err(LengthError { expected: length, actual }));
        assert_eq!(V::decode(&[0; 9]), Err(LengthError { expected: length, actual: 9 }));
    }

    #[test]
    fn little_endian() {
        round_trip::<bool>(true, &[1]);
        round_trip::<u8>(0xFE, &[0xFE]);
        round_trip::<u16>(0x1234, &[0x34, 0x12]);
        round_trip::<u32>(0x1234_5678, &[0x78, 0x56, 0x34, 0x12]);
        round_trip::<u64>(1 << 56, &[0, 0, 0, 0, 0, 0, 0, 1]);
        round_trip::<i8>(-2, &[0xFE]);
        round_trip::<i16>(-2, &[0xFE, 0xFF]);
        round_trip::<i32>(-2, &[0xFE, 0xFF, 0xFF, 0xFF]);
        round_trip::<i64>(-2, &[0xFE, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF]);
        round_trip::<f32>(1.0, &[0, 0, 0x80, 0x3F]);
        round_trip::<f64>(1.0, &[0, 0, 0, 0, 0, 0, 0xF0, 0x3F]);
    }

    #[test]
    fn any_set_bit_is_true() {
        assert_eq!(bool::decode(&[0xFF]), Ok(true));
        assert_eq!(bool::decode(&[0]), Ok(false));
    }

    #[test]
    fn ranges() {
        assert!(i32::in_range(-5, &Range::Between(-5, 5)));
        assert!(!i32::in_range(6, &Range::Between(-5, 5)));
        assert!(bool::in_range(true, &Range::Full));
        assert!(!f32::in_range(f32::NAN, &Range::From(0.0)));
    }

    #[test]
    fn byte_lengths() {
        assert_eq!(byte_len(1), 1);
        assert_eq!(byte_len(24), 3);
        assert_eq!(byte_len(63), 8);
        assert_eq!(byte_len(u32::MAX), 8);
    }
}
