//! Scaled values: raw values with a unit and a scale.

use core::marker::PhantomData;

use crate::data_type::DataType;
use crate::range::Range;
use crate::raw_value::RawValue;
use crate::value::{Fixed, Value};
use crate::value_error::{LengthError, OutOfRange};

mod sealed {
    pub trait Sealed {}
}

/// A native integer or floating-point type. This trait is sealed.
pub trait Number: Copy + sealed::Sealed {
    /// Converts the number to `f64`. Integers with a magnitude above 2⁵³ are rounded.
    #[must_use]
    fn real(self) -> f64;

    /// Converts the number to an integer and discards the fraction.
    #[must_use]
    fn integer(self) -> i128;

    /// Returns the number of this type that is nearest to `real`. An integer type rounds halves away from zero. Returns
    /// `None` if `real` is NaN, or if the rounded number is outside the limits of the type.
    #[must_use]
    fn nearest(real: f64) -> Option<Self>;
}

macro_rules! integers {
    ($($integer:ty)*) => {$(
        impl sealed::Sealed for $integer {}

        impl Number for $integer {
            #[inline]
            fn real(self) -> f64 {
                self as f64
            }

            #[inline]
            fn integer(self) -> i128 {
                self.into()
            }

            #[inline]
            fn nearest(real: f64) -> Option<Self> {
                // Minimum and maximum of the type are exact as `f64`. Only the maximum of a 64-bit type is rounded up
                // to a power of two.
                let low = Self::MIN as f64;
                if !((real >= low || real > low - 0.5) && real < Self::MAX as f64 + 0.5) {
                    return None;
                }
                let whole = real as Self;
                Some(match real - whole as f64 {
                    rest if rest >= 0.5 => whole + 1,
                    rest if rest <= -0.5 => whole - 1,
                    _ => whole,
                })
            }
        }
    )*};
}

integers! { u8 u16 u32 u64 i8 i16 i32 i64 }

macro_rules! reals {
    ($($real:ty)*) => {$(
        impl sealed::Sealed for $real {}

        impl Number for $real {
            #[inline]
            fn real(self) -> f64 {
                self.into()
            }

            #[inline]
            fn integer(self) -> i128 {
                self as i128
            }

            #[inline]
            fn nearest(real: f64) -> Option<Self> {
                let nearest = real as Self;
                nearest.is_finite().then_some(nearest)
            }
        }
    )*};
}

reals! { f32 f64 }

/// Type of a raw value that represents a physical value. [`Accessor::read_scaled`](crate::Accessor::read_scaled) and
/// [`Item::physical`](crate::Item::physical) use this trait.
///
/// The methods [`read`](crate::Accessor::read) and [`write`](crate::Accessor::write) use the raw value.
pub trait Quantity: Fixed {
    /// Type of the physical value: `f64`, or `Option<f64>` if some raw value has a special meaning.
    type Physical: Copy + Into<Option<f64>>;

    /// Type of the value that determines the scale: `()` for a constant scale, otherwise `f64`.
    type Other: Copy;

    /// Converts a raw value to the physical value.
    #[must_use]
    fn physical(raw: Self::Native, other: Self::Other) -> Self::Physical;

    /// Converts a physical value to the nearest raw value.
    ///
    /// # Errors
    ///
    /// Returns [`OutOfRange`] if the raw value doesn't fit the type or has a special meaning, or if `other` cannot
    /// determine a scale, for example a divisor of 0.
    fn raw(physical: f64, other: Self::Other) -> Result<Self::Native, OutOfRange>;
}

/// Linear scaling: physical = (raw × `NUM` + `OFFSET`) / `DEN`, computed with `f64`.
///
/// ```
/// use lexibus::{Quantity, Scaled};
///
/// type HundredthsOfRevolutions = Scaled<i32, 1, 100>;
/// assert_eq!(HundredthsOfRevolutions::physical(-1234, ()), -12.34);
/// assert_eq!(HundredthsOfRevolutions::raw(15.0, ()), Ok(1500));
/// ```
pub struct Scaled<B, const NUM: i64, const DEN: i64 = 1, const OFFSET: i64 = 0>(PhantomData<B>);

/// Reciprocal scaling: physical = `NUM` / `DEN` / raw. The raw value 0 is read as infinity and cannot be written.
pub struct Reciprocal<B, const NUM: i64, const DEN: i64 = 1>(PhantomData<B>);

/// Fraction of another value: physical = raw / 2^`BITS` × the other value.
pub struct Fraction<B, const BITS: u32>(PhantomData<B>);

/// Scaling with a divisor from another item: physical = raw × `NUM` / `DEN` / the other value.
pub struct PerItem<B, const NUM: i64, const DEN: i64 = 1>(PhantomData<B>);

/// Mantissa whose exponent is in another item: physical = raw / 2^`BITS` × `BASE`^exponent. The exponent is an integer.
///
/// ```
/// use lexibus::{Exponential, Quantity};
///
/// type Gain = Exponential<u16, 2, 15>;
/// assert_eq!(Gain::physical(20_480, 3.0), 5.0);
/// assert_eq!(Exponential::<i16>::physical(5, -3.0), 0.005);
/// ```
pub struct Exponential<B, const BASE: u32 = 10, const BITS: u32 = 0>(PhantomData<B>);

/// A quantity whose raw value `RAW` doesn't represent a physical value. For example, 0xFFFF can mean "no sensor".
pub struct OrNone<V, const RAW: i128>(PhantomData<V>);

/// Implements `Value` and `Fixed` with the encoding of the base type `B`.
macro_rules! like_its_base {
    ([$($generics:tt)*] $quantity:ty, $base:ident) => {
        impl<$($generics)*> Value for $quantity {
            type Native = $base::Native;
            const DATA_TYPE: DataType = $base::DATA_TYPE;
        }

        impl<$($generics)*> Fixed for $quantity {
            const BITS: u32 = $base::BITS;

            #[inline]
            fn encode(native: Self::Native, buffer: &mut [u8; 8]) -> Result<usize, OutOfRange> {
                $base::encode(native, buffer)
            }

            #[inline]
            fn decode(bytes: &[u8]) -> Result<Self::Native, LengthError> {
                $base::decode(bytes)
            }

            #[inline]
            fn in_range(value: Self::Native, range: &Range<Self::Native>) -> bool {
                $base::in_range(value, range)
            }

            #[inline]
            fn raw_value(native: Self::Native) -> Option<RawValue> {
                $base::raw_value(native)
            }
        }
    };
}

like_its_base!([V: Fixed, const RAW: i128] OrNone<V, RAW>, V);

fn nearest<N: Number>(real: f64) -> Result<N, OutOfRange> {
    N::nearest(real).ok_or(OutOfRange)
}

/// Implements a quantity for a number type from two conversions: raw to physical, and physical to raw.
macro_rules! quantity {
    (
        [$($generics:tt)*] $quantity:ty, $Other:ty:
        |$raw:ident, $other:pat_param| $physical:expr, |$number:ident| $nearest:expr
    ) => {
        like_its_base!([B: Fixed, $($generics)*] $quantity, B);

        impl<B, $($generics)*> Quantity for $quantity
        where
            B: Fixed,
            B::Native: Number,
        {
            type Physical = f64;
            type Other = $Other;

            #[inline]
            fn physical($raw: B::Native, $other: $Other) -> f64 {
                $physical
            }

            #[inline]
            fn raw($number: f64, $other: $Other) -> Result<B::Native, OutOfRange> {
                $nearest
            }
        }
    };
}

quantity!(
    [const NUM: i64, const DEN: i64, const OFFSET: i64] Scaled<B, NUM, DEN, OFFSET>, ():
    |raw, _| (raw.real() * NUM as f64 + OFFSET as f64) / DEN as f64,
    |physical| nearest((physical * DEN as f64 - OFFSET as f64) / NUM as f64)
);

quantity!(
    [const NUM: i64, const DEN: i64] Reciprocal<B, NUM, DEN>, ():
    |raw, _| NUM as f64 / (DEN as f64 * raw.real()),
    |physical| {
        let raw: B::Native = nearest(NUM as f64 / (DEN as f64 * physical))?;
        if raw.real() == 0.0 {
            return Err(OutOfRange);
        }
        Ok(raw)
    }
);

quantity!(
    [const BITS_OF_FRACTION: u32] Fraction<B, BITS_OF_FRACTION>, f64:
    |raw, base| raw.real() * base / one_shifted(BITS_OF_FRACTION),
    |physical| nearest(physical * one_shifted(BITS_OF_FRACTION) / base)
);

quantity!(
    [const NUM: i64, const DEN: i64] PerItem<B, NUM, DEN>, f64:
    |raw, divisor| raw.real() * NUM as f64 / (DEN as f64 * divisor),
    |physical| {
        if divisor == 0.0 {
            return Err(OutOfRange);
        }
        nearest(physical * (DEN as f64 * divisor) / NUM as f64)
    }
);

quantity!(
    [const BASE: u32, const BITS_OF_FRACTION: u32] Exponential<B, BASE, BITS_OF_FRACTION>, f64:
    |raw, exponent| scaled_by_power(raw.real() / one_shifted(BITS_OF_FRACTION), BASE, exponent),
    |physical| {
        if !exponent.is_finite() {
            return Err(OutOfRange);
        }
        nearest(scaled_by_power(physical, BASE, -exponent) * one_shifted(BITS_OF_FRACTION))
    }
);

impl<V, const RAW: i128> Quantity for OrNone<V, RAW>
where
    V: Quantity,
    V::Native: Number,
{
    type Physical = Option<f64>;
    type Other = V::Other;

    #[inline]
    fn physical(raw: V::Native, other: V::Other) -> Option<f64> {
        if raw.integer() == RAW {
            return None;
        }
        V::physical(raw, other).into()
    }

    #[inline]
    fn raw(physical: f64, other: V::Other) -> Result<V::Native, OutOfRange> {
        let raw = V::raw(physical, other)?;
        if raw.integer() == RAW {
            return Err(OutOfRange);
        }
        Ok(raw)
    }
}

const fn one_shifted(bits: u32) -> f64 {
    // The mantissa of an `f64` has fewer than 63 bits.
    (1_u64 << if bits > 63 { 63 } else { bits }) as f64
}

/// Returns `number` × `base`^`exponent`.
fn scaled_by_power(number: f64, base: u32, exponent: f64) -> f64 {
    match exponent < 0.0 {
        true => number / power(base, -exponent),
        false => number * power(base, exponent),
    }
}

/// Returns `base`^`exponent` without `powi`, which needs the standard library. The exponent is limited to 1100, so that
/// the loop is short: 2^1100 already exceeds the range of `f64`.
fn power(base: u32, exponent: f64) -> f64 {
    (0..exponent.min(1100.0) as u32).fold(1.0, |power, _| power * f64::from(base))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Int;

    #[test]
    fn mantissa_and_exponent() {
        type Gain = Exponential<u16, 2, 15>;
        assert_eq!(
            (Gain::physical(13_762, 0.0), Gain::physical(26_214, 1.0)),
            (13_762.0 / 32_768.0, 26_214.0 / 16_384.0)
        );
        assert_eq!((Gain::raw(5.0, 3.0), Gain::raw(5.0, -1.0)), (Ok(20_480), Err(OutOfRange)));
        assert_eq!((Gain::physical(32_768, -2.0), Gain::raw(0.25, -2.0)), (0.25, Ok(32_768)));
        assert_eq!(Exponential::<i16>::raw(0.005, -3.0), Ok(5));
    }

    #[test]
    fn no_number_is_sent_where_the_other_value_means_nothing() {
        assert_eq!(PerItem::<i32, 1, 100>::raw(3.0, 0.0), Err(OutOfRange));
        assert_eq!(PerItem::<i32, 1, 100>::raw(3.0, f64::NAN), Err(OutOfRange));
        assert_eq!(Fraction::<i32, 15>::raw(3.0, 0.0), Err(OutOfRange));
        for exponent in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            assert_eq!(Exponential::<i32>::raw(5.0, exponent), Err(OutOfRange));
        }
    }

    #[test]
    fn nearest_numbers() {
        assert_eq!(u8::nearest(254.5), Some(255));
        assert_eq!(u8::nearest(255.49), Some(255));
        assert_eq!(u8::nearest(255.5), None);
        assert_eq!(u8::nearest(-0.49), Some(0));
        assert_eq!(u8::nearest(-0.5), None);
        assert_eq!(i8::nearest(-128.49), Some(-128));
        assert_eq!(i8::nearest(-128.5), None);
        assert_eq!(i32::nearest(-2.5), Some(-3));
        assert_eq!(i32::nearest(0.499_999_999_999_999_94), Some(0));
        assert_eq!(i32::nearest(f64::NAN), None);
        assert_eq!(i32::nearest(f64::INFINITY), None);
        assert_eq!(i64::nearest(9.3e18), None);
        assert_eq!(i64::nearest(-9_223_372_036_854_775_808.0), Some(i64::MIN));
        assert_eq!(i64::nearest(9_223_372_036_854_775_808.0), None);
        assert_eq!(u64::nearest(18_446_744_073_709_549_568.0), Some(18_446_744_073_709_549_568));
        assert_eq!(u64::nearest(18_446_744_073_709_551_616.0), None);
        assert_eq!(f32::nearest(1e300), None);
    }

    #[test]
    fn linear() {
        type Celsius = Scaled<i16, 1, 10, -400>;
        assert_eq!((Celsius::physical(655, ()), Celsius::raw(25.5, ())), (25.5, Ok(655)));
        // In `f64`, 35 × 0.01 isn't 0.35, but 35 / 100 is.
        assert_eq!(Scaled::<u16, 1, 100>::physical(35, ()), 0.35);
        assert_eq!(Scaled::<u16, 20>::raw(1_310_720.0, ()), Err(OutOfRange));
        assert_eq!(Scaled::<u16, 1, 100>::raw(f64::NAN, ()), Err(OutOfRange));
        assert_eq!(Scaled::<Int<24>, 1, 10>::physical(-5, ()), -0.5);
        assert_eq!(Scaled::<f32, 1, 2>::raw(0.75, ()), Ok(1.5));
    }

    #[test]
    fn reciprocal() {
        type Frequency = Reciprocal<u16, 25_000_000>;
        assert_eq!((Frequency::physical(2500, ()), Frequency::raw(10_000.0, ())), (10_000.0, Ok(2500)));
        assert_eq!(Frequency::raw(1e12, ()), Err(OutOfRange));
        assert_eq!(Frequency::raw(0.0, ()), Err(OutOfRange));
        assert_eq!(Frequency::physical(0, ()), f64::INFINITY);
    }

    #[test]
    fn scales_that_depend_on_another_value() {
        assert_eq!(Fraction::<i16, 15>::physical(16_384, 11.0), 5.5);
        assert_eq!(Fraction::<i16, 15>::raw(-5.5, 11.0), Ok(-16_384));
        assert_eq!(PerItem::<i32, 1, 100>::physical(600, 2.0), 3.0);
        assert_eq!(PerItem::<i32, 1, 100>::raw(3.0, 2.0), Ok(600));
        assert_eq!((Exponential::<i32>::physical(5, -3.0), Exponential::<i32>::physical(5, 2.0)), (0.005, 500.0));
        assert_eq!((Exponential::<i32>::raw(0.005, -3.0), Exponential::<i32>::raw(500.0, 2.0)), (Ok(5), Ok(5)));
        assert_eq!(Exponential::<i32>::raw(1.0, f64::NEG_INFINITY), Err(OutOfRange));
    }

    #[test]
    fn numbers_that_are_none() {
        type Ramp = OrNone<OrNone<Scaled<u32, 1, 10>, 0>, 0xFFFF>;
        assert_eq!(
            (Ramp::physical(15, ()), Ramp::physical(0, ()), Ramp::physical(0xFFFF, ())),
            (Some(1.5), None, None)
        );
        assert_eq!(
            (Ramp::raw(1.5, ()), Ramp::raw(0.0, ()), Ramp::raw(6553.5, ())),
            (Ok(15), Err(OutOfRange), Err(OutOfRange))
        );
    }
}
