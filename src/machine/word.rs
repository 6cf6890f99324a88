//! Status words and control words as integers.

use crate::enumeration::Enumeration;
use crate::value::Value;

/// The value of a status item or control item, as an integer. Integers of 8, 16 and 32 bits, and generated enumerations
/// and bit fields implement this trait.
pub trait StateWord: Copy {
    /// Returns all bits of the value, including reserved bits.
    fn bits(self) -> u32;

    /// Creates the value from its bits. Bits that do not fit are dropped.
    fn from_bits(bits: u32) -> Self;
}

macro_rules! integers {
    ($($ty:ty as $unsigned:ty),*) => { $(
        impl StateWord for $ty {
            #[inline]
            fn bits(self) -> u32 {
                u32::from(self as $unsigned)
            }

            #[inline]
            fn from_bits(bits: u32) -> Self {
                bits as $ty
            }
        }
    )* };
}

integers! { u8 as u8, u16 as u16, u32 as u32, i8 as u8, i16 as u16, i32 as u32 }

impl<T: Enumeration<Base: Value<Native: StateWord>>> StateWord for T {
    #[inline]
    fn bits(self) -> u32 {
        self.as_is().bits()
    }

    #[inline]
    fn from_bits(bits: u32) -> Self {
        Self::from_native(<T::Base as Value>::Native::from_bits(bits))
    }
}
