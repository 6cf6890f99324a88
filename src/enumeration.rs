//! Integers whose values or bits have names.

use crate::data_type::DataType;
use crate::range::Range;
use crate::raw_value::RawValue;
use crate::value::{Fixed, Value};
use crate::value_error::{LengthError, OutOfRange};

/// An integer with named values. Bit fields, whose bits have names, also implement this trait.
///
/// A generated enumeration has the variant `Unknown` unless every value of the integer has a name. A value that isn't
/// in the device description can therefore be read. A type with this trait can be the [`Value`] of an item:
///
/// ```
/// use lexibus::{Enumeration, Fixed};
///
/// #[derive(Clone, Copy, Debug, PartialEq)]
/// enum Mode {
///     Off,
///     On,
///     Unknown(u8),
/// }
///
/// impl Enumeration for Mode {
///     type Base = u8;
///
///     fn from_native(native: u8) -> Self {
///         match native {
///             0 => Mode::Off,
///             1 => Mode::On,
///             other => Mode::Unknown(other),
///         }
///     }
///
///     fn native(self) -> u8 {
///         match self {
///             Mode::Off => 0,
///             Mode::On => 1,
///             Mode::Unknown(other) => other,
///         }
///     }
/// }
///
/// assert_eq!(Mode::decode(&[1]), Ok(Mode::On));
/// assert_eq!(Mode::decode(&[9]), Ok(Mode::Unknown(9)));
/// ```
pub trait Enumeration: Copy + 'static {
    /// Type of the integer.
    type Base: Fixed;

    /// Creates the enumeration or bit field from an integer.
    fn from_native(native: <Self::Base as Value>::Native) -> Self;

    /// Returns the integer to write to an item. Reserved bits of a bit field have the values that the device requires.
    fn native(self) -> <Self::Base as Value>::Native;

    /// Returns the integer to write to a PDO. Keeps all bits, including reserved bits.
    fn as_is(self) -> <Self::Base as Value>::Native {
        self.native()
    }
}

impl<E: Enumeration> Value for E {
    type Native = E;
    const DATA_TYPE: DataType = <E::Base as Value>::DATA_TYPE;
}

impl<E: Enumeration> Fixed for E {
    const BITS: u32 = <E::Base as Fixed>::BITS;

    #[inline]
    fn encode(native: E, buffer: &mut [u8; 8]) -> Result<usize, OutOfRange> {
        <E::Base as Fixed>::encode(native.native(), buffer)
    }

    #[inline]
    fn decode(bytes: &[u8]) -> Result<E, LengthError> {
        <E::Base as Fixed>::decode(bytes).map(E::from_native)
    }

    /// Returns whether the integer of the value is within `range`.
    #[inline]
    fn in_range(value: E, range: &Range<E>) -> bool {
        // The comparison is not a recursive call, because the compiler could neither inline it nor evaluate a constant
        // range.
        let within = |base: Range<_>| <E::Base as Fixed>::in_range(value.native(), &base);
        match *range {
            Range::Full => true,
            Range::From(low) => within(Range::From(low.native())),
            Range::To(high) => within(Range::To(high.native())),
            Range::Between(low, high) => within(Range::Between(low.native(), high.native())),
            Range::OneOf(list) => list.iter().any(|(low, high)| within(Range::Between(low.native(), high.native()))),
        }
    }

    #[inline]
    fn raw_value(native: E) -> Option<RawValue> {
        <E::Base as Fixed>::raw_value(native.native())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Uint;

    #[derive(Clone, Copy, Debug, PartialEq)]
    struct Level(u8);

    impl Enumeration for Level {
        type Base = Uint<2>;

        fn from_native(native: u8) -> Self {
            Level(native)
        }

        fn native(self) -> u8 {
            self.0
        }
    }

    #[test]
    fn travels_as_its_integer() {
        let mut buffer = [0; 8];
        assert_eq!(Level::encode(Level(3), &mut buffer), Ok(1));
        assert_eq!((buffer[0], Level::BITS, Level::DATA_TYPE), (3, 2, DataType::Bits(2)));
        assert_eq!(Level::encode(Level(4), &mut buffer), Err(OutOfRange));
        assert_eq!(Level::decode(&[2]), Ok(Level(2)));
        assert!(Level::decode(&[2, 0]).is_err());
    }

    #[test]
    fn limits_are_those_of_the_numbers() {
        assert!(Level::in_range(Level(1), &Range::Between(Level(1), Level(2))));
        assert!(!Level::in_range(Level(3), &Range::To(Level(2))));
        assert!(!Level::in_range(Level(0), &Range::From(Level(1))));
        assert!(Level::in_range(Level(9), &Range::Full));
    }
}
