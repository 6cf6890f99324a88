//! Raw values independent of their type.

use core::fmt;

use crate::pdo::mask;
use crate::range::Range;
use crate::value::{byte_len, Fixed};

/// Raw value of an item as a number. For an enumeration or a bit field, the raw value is the number that is sent. For a
/// BOOLEAN, the raw value is 0 or 1.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub enum RawValue {
    /// A signed integer.
    Signed(i64),
    /// An unsigned integer, an enumeration, a bit field or a BOOLEAN.
    Unsigned(u64),
    /// A floating-point number.
    Real(f64),
}

macro_rules! from {
    ($($native:ty => $variant:ident;)*) => {$(
        impl From<$native> for RawValue {
            #[inline]
            fn from(value: $native) -> Self {
                Self::$variant(value.into())
            }
        }
    )*};
}

from! {
    bool => Unsigned;
    u8 => Unsigned;
    u16 => Unsigned;
    u32 => Unsigned;
    u64 => Unsigned;
    i8 => Signed;
    i16 => Signed;
    i32 => Signed;
    i64 => Signed;
    f32 => Real;
    f64 => Real;
}

impl fmt::Display for RawValue {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Signed(value) => value.fmt(f),
            Self::Unsigned(value) => value.fmt(f),
            Self::Real(value) => value.fmt(f),
        }
    }
}

/// Returns the minimum and the maximum of a type, or `None` if the values of the type aren't numbers.
fn type_limits<V: Fixed>() -> Option<[RawValue; 2]> {
    let zero = V::decode([0; 8].get(..byte_len(V::BITS))?).ok()?;
    Some(match V::raw_value(zero)? {
        RawValue::Signed(_) => {
            let maximum = mask(V::BITS.saturating_sub(1)) as i64;
            [RawValue::Signed(-maximum - 1), RawValue::Signed(maximum)]
        }
        RawValue::Unsigned(_) => [RawValue::Unsigned(0), RawValue::Unsigned(mask(V::BITS))],
        RawValue::Real(_) => [RawValue::Real(f64::NEG_INFINITY), RawValue::Real(f64::INFINITY)],
    })
}

/// Returns the minimum and the maximum of a range, or `None` if the values aren't numbers. If the range has no minimum
/// or maximum, the limit of the type is returned.
#[inline]
pub(crate) fn limits<V: Fixed>(range: &Range<V::Native>) -> Option<[RawValue; 2]> {
    let [lowest, highest] = type_limits::<V>()?;
    Some(match *range {
        Range::Full => [lowest, highest],
        Range::From(low) => [V::raw_value(low)?, highest],
        Range::To(high) => [lowest, V::raw_value(high)?],
        Range::Between(low, high) => [V::raw_value(low)?, V::raw_value(high)?],
        Range::OneOf(list) => {
            let mut hull = [highest, lowest];
            for (low, high) in list {
                let (low, high) = (V::raw_value(*low)?, V::raw_value(*high)?);
                hull = [if low < hull[0] { low } else { hull[0] }, if high > hull[1] { high } else { hull[1] }];
            }
            hull
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Int, OrNone, Scaled, TimeOfDay, Uint};
    use std::string::ToString;

    #[test]
    fn limits_of_ranges() {
        use RawValue::{Real, Signed, Unsigned};
        assert_eq!(limits::<i64>(&Range::Full), Some([Signed(i64::MIN), Signed(i64::MAX)]));
        assert_eq!(limits::<u64>(&Range::From(7)), Some([Unsigned(7), Unsigned(u64::MAX)]));
        assert_eq!(limits::<Int<24>>(&Range::To(-3)), Some([Signed(-0x80_0000), Signed(-3)]));
        assert_eq!(limits::<Uint<3>>(&Range::Full), Some([Unsigned(0), Unsigned(7)]));
        assert_eq!(limits::<bool>(&Range::Full), Some([Unsigned(0), Unsigned(1)]));
        assert_eq!(limits::<f32>(&Range::From(0.5)), Some([Real(0.5), Real(f64::INFINITY)]));
        assert_eq!(limits::<i8>(&Range::OneOf(&[(4, 6), (-2, 1)])), Some([Signed(-2), Signed(6)]));
        assert_eq!(limits::<OrNone<Scaled<u16, 1, 10>, 9>>(&Range::Between(1, 5)), Some([Unsigned(1), Unsigned(5)]));
        assert_eq!(limits::<TimeOfDay>(&Range::Full), None);
    }

    #[test]
    fn numbers_as_text() {
        assert_eq!(RawValue::from(-5_i8).to_string(), "-5");
        assert_eq!(RawValue::from(u64::MAX).to_string(), "18446744073709551615");
        assert_eq!(RawValue::from(0.5_f32).to_string(), "0.5");
        assert_eq!(RawValue::from(true).to_string(), "1");
    }
}
