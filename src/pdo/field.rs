//! Fields of PDOs, and their conversion to and from bytes.

use crate::bits;
use crate::enumeration::Enumeration;
use crate::pdo::{from_bytes, mask, sign_extend, to_bytes};
use crate::time::{TimeDifference, TimeOfDay};
use crate::value::Value;
use crate::value_error::LengthError;
use crate::wide::{Int, Uint};

/// A type that a PDO field can have: a number, a bool, an enumeration, a bit field, a time, or bytes.
#[diagnostic::on_unimplemented(
    message = "`{Self}` cannot be a field of a PDO",
    label = "expected a type with a fixed number of bits"
)]
pub trait Field: Copy {
    /// Returns a word with the value of the field in the low bits. Bits above the length of the field are undefined.
    #[must_use]
    fn to_word(self) -> u64;

    /// Creates the field from the low `bits` bits of `word`. All higher bits of `word` must be 0.
    #[must_use]
    fn from_word(word: u64, bits: u32) -> Self;

    /// Writes the field to `data` at bit offset `at`. The field has a length of `bits` bits.
    #[inline]
    fn put(self, data: &mut [u8], at: usize, bits: u32) {
        bits::set(data, at, bits, self.to_word());
    }

    /// Reads the field from `data` at bit offset `at`. The field has a length of `bits` bits.
    #[must_use]
    #[inline]
    fn get(data: &[u8], at: usize, bits: u32) -> Self {
        Self::from_word(bits::get(data, at, bits), bits)
    }
}

macro_rules! fields {
    ($([$($generics:tt)*] $field:ty: $value:ident => $to_word:expr, $word:ident $bits:ident => $from_word:expr;)*) => {$(
        impl<$($generics)*> Field for $field {
            #[inline]
            fn to_word(self) -> u64 {
                let $value = self;
                $to_word
            }

            #[inline]
            fn from_word($word: u64, $bits: u32) -> Self {
                $from_word
            }
        }
    )*};
}

fields! {
    [] bool: value => value.into(), word _bits => word != 0;
    [] u8: value => value.into(), word _bits => word as u8;
    [] u16: value => value.into(), word _bits => word as u16;
    [] u32: value => value.into(), word _bits => word as u32;
    [] u64: value => value, word _bits => word;
    [] i8: value => value as u64, word bits => sign_extend(word, bits) as i8;
    [] i16: value => value as u64, word bits => sign_extend(word, bits) as i16;
    [] i32: value => value as u64, word bits => sign_extend(word, bits) as i32;
    [] i64: value => value as u64, word bits => sign_extend(word, bits);
    [] f32: value => value.to_bits().into(), word _bits => f32::from_bits(word as u32);
    [] f64: value => value.to_bits(), word _bits => f64::from_bits(word);
    [const BITS: u32] Uint<BITS>: value => value.raw(), word _bits => Self::from_raw(word);
    [const BITS: u32] Int<BITS>: value => value.raw(), word _bits => Self::from_raw(word);
    [] TimeOfDay: value => value.raw(), word _bits => Self::from_raw(word);
    [] TimeDifference: value => value.raw(), word _bits => Self::from_raw(word);
}

impl<E: Enumeration> Field for E
where
    <E::Base as Value>::Native: Field,
{
    #[inline]
    fn to_word(self) -> u64 {
        self.as_is().to_word()
    }

    #[inline]
    fn from_word(word: u64, bits: u32) -> Self {
        E::from_native(Field::from_word(word, bits))
    }
}

/// Raw bytes, such as the bytes of a text.
impl<const N: usize> Field for [u8; N] {
    #[inline]
    fn to_word(self) -> u64 {
        from_bytes(&self)
    }

    #[inline]
    fn from_word(word: u64, _: u32) -> Self {
        to_bytes(word)
    }

    #[inline]
    fn put(self, data: &mut [u8], at: usize, bits: u32) {
        bits::set_bits(data, at, bits as usize, &self);
    }

    #[inline]
    fn get(data: &[u8], at: usize, bits: u32) -> Self {
        bits::get_bits(data, at, bits as usize)
    }
}

/// The `LEN` bytes of a PDO to which fields are being added. The code of [`pdo!`](crate::pdo!) uses this type.
///
/// A frame of up to 8 bytes is stored as one word, so that the compiler can evaluate all shifts at compile time.
pub struct Frame<const LEN: usize> {
    word: u64,
    data: [u8; LEN],
}

impl<const LEN: usize> Frame<LEN> {
    /// Creates an empty frame, in which all bits are 0.
    #[must_use]
    #[inline]
    pub const fn new() -> Self {
        Self { word: 0, data: [0; LEN] }
    }

    /// Adds a field of `bits` bits at bit offset `at`. The bits of the field must still be 0.
    #[must_use]
    #[inline]
    pub fn with<F: Field>(mut self, field: F, at: u32, bits: u32) -> Self {
        if LEN <= 8 {
            self.word |= (field.to_word() & mask(bits)) << at;
        } else {
            field.put(&mut self.data, at as usize, bits);
        }
        self
    }

    /// Returns the bytes of the frame.
    #[must_use]
    #[inline]
    pub const fn into_bytes(self) -> [u8; LEN] {
        if LEN <= 8 {
            to_bytes(self.word)
        } else {
            self.data
        }
    }
}

impl<const LEN: usize> Default for Frame<LEN> {
    fn default() -> Self {
        Self::new()
    }
}

/// The bytes of a PDO of `LEN` bytes, from which fields are read. The code of [`pdo!`](crate::pdo!) uses this type.
pub struct Fields<'d, const LEN: usize> {
    word: u64,
    data: &'d [u8],
}

impl<'d, const LEN: usize> Fields<'d, LEN> {
    /// Creates the fields from the first `LEN` bytes of `data`. Further bytes are ignored.
    ///
    /// # Errors
    ///
    /// Returns [`LengthError`] if `data` has fewer than `LEN` bytes.
    #[inline]
    pub const fn new(data: &'d [u8]) -> Result<Self, LengthError> {
        if data.len() < LEN {
            return Err(LengthError::new(LEN, data.len()));
        }
        Ok(Self { word: from_bytes(data), data })
    }

    /// Returns the field of `bits` bits at bit offset `at`.
    #[must_use]
    #[inline]
    pub fn get<F: Field>(&self, at: u32, bits: u32) -> F {
        if LEN <= 8 {
            F::from_word(self.word >> at & mask(bits), bits)
        } else {
            F::get(self.data, at as usize, bits)
        }
    }
}

#[cfg(test)]
mod tests {
    use core::fmt::Debug;

    use super::*;

    fn travels<F: Field + PartialEq + Debug>(field: F, bits: u32, word: u64) {
        assert_eq!(field.to_word() & mask(bits), word);
        assert_eq!(F::from_word(word, bits), field);
        // Checks the field at bit offset 7 within a word, and in a frame that is longer than a word.
        let short = Frame::<8>::new().with(field, 7, bits).into_bytes();
        assert_eq!(short, (word << 7).to_le_bytes());
        assert_eq!(Fields::<8>::new(&short).unwrap().get::<F>(7, bits), field);
        let long = Frame::<20>::new().with(field, 79, bits).into_bytes();
        assert_eq!(bits::get(&long, 79, bits), word);
        assert_eq!((bits::get(&long, 0, 64), bits::get(&long, 79 + bits as usize, 64)), (0, 0));
        assert_eq!(Fields::<20>::new(&long).unwrap().get::<F>(79, bits), field);
    }

    #[derive(Clone, Copy, Debug, PartialEq)]
    struct Level(i8);

    impl Enumeration for Level {
        type Base = i8;

        fn from_native(native: i8) -> Self {
            Level(native)
        }

        fn native(self) -> i8 {
            self.0
        }
    }

    #[test]
    fn all_types_travel() {
        travels(true, 1, 1);
        travels(0xFEu8, 8, 0xFE);
        travels(5u8, 3, 5);
        travels(-2i8, 8, 0xFE);
        travels(-2i32, 24, 0xFF_FFFE);
        travels(0x1234_5678u32, 32, 0x1234_5678);
        travels(-1i64, 40, 0xFF_FFFF_FFFF);
        travels(1.0f32, 32, 0x3F80_0000);
        travels(Uint::<12>::from_raw(0xABC), 12, 0xABC);
        travels(Int::<24>::from_raw(0xFF_FFFE), 24, 0xFF_FFFE);
        travels(TimeOfDay::new(1, 2), 48, 0x0002_0000_0001);
        travels(Level(-3), 8, 0xFD);
        travels([1, 2, 3], 24, 0x03_0201);
        assert_eq!(f64::from_word(1.5f64.to_word(), 64), 1.5);
    }

    #[test]
    fn fields_are_cut_to_their_bits() {
        let frame = Frame::<2>::new().with(0xFFu8, 3, 2).with(-1i16, 8, 4).into_bytes();
        assert_eq!(frame, [0b0001_1000, 0x0F]);
    }

    #[test]
    fn long_bytes_travel() {
        let text = *b"more than a word";
        let frame = Frame::<20>::new().with(text, 9, 128).into_bytes();
        assert_eq!(Fields::<20>::new(&frame).unwrap().get::<[u8; 16]>(9, 128), text);
        assert_eq!(frame[1], b'm' << 1);
    }

    #[test]
    fn short_data_are_refused() {
        assert_eq!(Fields::<3>::new(&[0; 2]).map(|_| ()), Err(LengthError { expected: 3, actual: 2 }));
        assert!(Fields::<3>::new(&[0; 4]).is_ok());
    }
}
