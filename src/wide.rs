//! Integer types with widths that Rust doesn't provide.

use crate::data_type::DataType;
use crate::pdo::{mask, sign_extend};
use crate::range::Range;
use crate::raw_value::RawValue;
use crate::value::{decode_raw, encode_raw, Fixed, Value};
use crate::value_error::{LengthError, OutOfRange};

/// An unsigned integer of `BITS` bits, 1 to 63. Any other width causes a compile-time error:
///
/// ```compile_fail,E0080
/// const _: u64 = lexibus::Uint::<64>::MAX.get();
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Default)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(try_from = "u64", into = "u64"))]
pub struct Uint<const BITS: u32>(u64);

/// A signed integer of `BITS` bits, 1 to 63, in two's complement. Any other width causes a compile-time error.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Default)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(try_from = "i64", into = "i64"))]
pub struct Int<const BITS: u32>(i64);

const fn checked_width(bits: u32) -> u32 {
    assert!(bits >= 1 && bits <= 63, "the width of an integer is 1 to 63 bits");
    bits
}

impl<const BITS: u32> Uint<BITS> {
    const WIDTH: u32 = checked_width(BITS);

    /// Minimum value, 0.
    pub const MIN: Self = Self::from_raw(0);

    /// Maximum value.
    pub const MAX: Self = Self::from_raw(u64::MAX);

    /// Creates the integer. Returns `None` if `value` doesn't fit in `BITS` bits.
    #[must_use]
    #[inline]
    pub const fn new(value: u64) -> Option<Self> {
        let cut = Self::from_raw(value);
        if cut.0 == value {
            Some(cut)
        } else {
            None
        }
    }

    /// Returns the value.
    #[must_use]
    #[inline]
    pub const fn get(self) -> u64 {
        self.0
    }

    /// Creates the integer from the low `BITS` bits of `raw`. Ignores the higher bits of `raw`.
    #[must_use]
    #[inline]
    pub const fn from_raw(raw: u64) -> Self {
        Self(raw & mask(Self::WIDTH))
    }

    /// Returns the low `BITS` bits of the integer's representation. All higher bits of the result are 0.
    #[must_use]
    #[inline]
    pub const fn raw(self) -> u64 {
        self.0
    }
}

impl<const BITS: u32> Int<BITS> {
    const WIDTH: u32 = checked_width(BITS);

    /// Minimum value.
    pub const MIN: Self = Self::from_raw(1 << (Self::WIDTH - 1));

    /// Maximum value.
    pub const MAX: Self = Self::from_raw(mask(Self::WIDTH - 1));

    /// Creates the integer. Returns `None` if `value` doesn't fit in `BITS` bits.
    #[must_use]
    #[inline]
    pub const fn new(value: i64) -> Option<Self> {
        let cut = Self::from_raw(value as u64);
        if cut.0 == value {
            Some(cut)
        } else {
            None
        }
    }

    /// Returns the value.
    #[must_use]
    #[inline]
    pub const fn get(self) -> i64 {
        self.0
    }

    /// Creates the integer from the low `BITS` bits of `raw`. The highest bit of a signed integer is the sign. Ignores
    /// the higher bits of `raw`.
    #[must_use]
    #[inline]
    pub const fn from_raw(raw: u64) -> Self {
        Self(sign_extend(raw, Self::WIDTH))
    }

    /// Returns the low `BITS` bits of the integer's representation. All higher bits of the result are 0.
    #[must_use]
    #[inline]
    pub const fn raw(self) -> u64 {
        self.0 as u64 & mask(Self::WIDTH)
    }
}

macro_rules! conversions {
    ($($wide:ident, $native:ty;)*) => {$(
        impl<const BITS: u32> TryFrom<$native> for $wide<BITS> {
            type Error = OutOfRange;

            fn try_from(value: $native) -> Result<Self, OutOfRange> {
                Self::new(value).ok_or(OutOfRange)
            }
        }

        impl<const BITS: u32> From<$wide<BITS>> for $native {
            fn from(value: $wide<BITS>) -> Self {
                value.get()
            }
        }
    )*};
}

conversions! {
    Uint, u64;
    Int, i64;
}

macro_rules! wide {
    ($($wide:ident, $bits:literal, $native:ty, $data_type:ident $(($size:literal))?;)*) => {$(
        impl Value for $wide<$bits> {
            type Native = $native;
            const DATA_TYPE: DataType = DataType::$data_type $(($size))?;
        }

        impl Fixed for $wide<$bits> {
            const BITS: u32 = $bits;

            #[inline]
            fn encode(native: $native, buffer: &mut [u8; 8]) -> Result<usize, OutOfRange> {
                const UNUSED: u32 = <$native>::BITS - $bits;
                if native << UNUSED >> UNUSED != native {
                    return Err(OutOfRange);
                }
                Ok(encode_raw(native as u64 & mask($bits), $bits, buffer))
            }

            #[inline]
            fn decode(bytes: &[u8]) -> Result<$native, LengthError> {
                decode_raw(bytes, $bits).map(|raw| Self::from_raw(raw).get() as $native)
            }

            #[inline]
            fn in_range(value: $native, range: &Range<$native>) -> bool {
                range.contains(value)
            }

            #[inline]
            fn raw_value(native: $native) -> Option<RawValue> {
                Some(native.into())
            }
        }
    )*};
}

wide! {
    Uint, 1, u8, Bits(1);
    Uint, 2, u8, Bits(2);
    Uint, 3, u8, Bits(3);
    Uint, 4, u8, Bits(4);
    Uint, 5, u8, Bits(5);
    Uint, 6, u8, Bits(6);
    Uint, 7, u8, Bits(7);
    Uint, 9, u16, Bits(9);
    Uint, 10, u16, Bits(10);
    Uint, 11, u16, Bits(11);
    Uint, 12, u16, Bits(12);
    Uint, 13, u16, Bits(13);
    Uint, 14, u16, Bits(14);
    Uint, 15, u16, Bits(15);
    Uint, 24, u32, Unsigned24;
    Uint, 40, u64, Unsigned40;
    Uint, 48, u64, Unsigned48;
    Uint, 56, u64, Unsigned56;
    Int, 24, i32, Integer24;
    Int, 40, i64, Integer40;
    Int, 48, i64, Integer48;
    Int, 56, i64, Integer56;
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn limits() {
        assert_eq!(Uint::<3>::MAX.get(), 7);
        assert_eq!(Uint::<3>::new(8), None);
        assert_eq!(Uint::<63>::MAX.get(), u64::MAX >> 1);
        assert_eq!((Int::<3>::MIN.get(), Int::<3>::MAX.get()), (-4, 3));
        assert_eq!((Int::<1>::MIN.get(), Int::<1>::MAX.get()), (-1, 0));
        assert_eq!(Int::<63>::MIN.get(), i64::MIN >> 1);
        assert_eq!(Int::<3>::new(4), None);
        assert_eq!(Int::<3>::new(-5), None);
    }

    #[test]
    fn raw_bits() {
        assert_eq!(Int::<24>::from_raw(0xAAFF_FFFE).get(), -2);
        assert_eq!(Int::<24>::from_raw(0xAAFF_FFFE).raw(), 0x00FF_FFFE);
        assert_eq!(Uint::<12>::from_raw(0xFABC).get(), 0xABC);
    }

    #[test]
    fn wide_values_travel() {
        let mut buffer = [0xAA; 8];
        assert_eq!(<Int<24> as Fixed>::encode(-2, &mut buffer), Ok(3));
        assert_eq!(buffer[..3], [0xFE, 0xFF, 0xFF]);
        assert_eq!(<Int<24> as Fixed>::decode(&buffer[..3]), Ok(-2));
        assert_eq!(<Uint<40> as Fixed>::encode(0x12_3456_789A, &mut buffer), Ok(5));
        assert_eq!(<Uint<40> as Fixed>::decode(&buffer[..5]), Ok(0x12_3456_789A));
        assert_eq!(<Uint<56> as Fixed>::decode(&[0; 8]), Err(LengthError { expected: 7, actual: 8 }));
    }

    #[test]
    fn what_does_not_fit_is_refused() {
        let mut buffer = [0; 8];
        assert_eq!(<Uint<24> as Fixed>::encode(1 << 24, &mut buffer), Err(OutOfRange));
        assert_eq!(<Int<24> as Fixed>::encode(1 << 23, &mut buffer), Err(OutOfRange));
        assert_eq!(<Int<48> as Fixed>::encode(-(1 << 47), &mut buffer), Ok(6));
    }
}
