//! Fields of a fixed process image.

use crate::bits;
use crate::profinet::be;
use crate::value::byte_len;
use crate::value_error::LengthError;

/// In which order the bytes of a field lie.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum ImageOrder {
    /// A number, its most significant byte first, as PROFINET has it. A field that is no whole number of bytes is a part of
    /// such a number.
    #[default]
    BigEndian,
    /// A number, its least significant byte first, as EtherCAT has it.
    LittleEndian,
    /// A text or other bytes, one after the other.
    Bytes,
}

/// Some bits of a fixed process image.
///
/// A [`Client`](crate::Client) deals in bytes, the least significant first; an image has its own order:
///
/// ```
/// use lexibus::ImageField;
///
/// // Four bytes from byte 3 on, which the device sends.
/// const POSITION: ImageField = ImageField::input(8 * 3, 32);
/// let mut image = [0; 32];
/// POSITION.put(&mut image, &(-2_i32).to_le_bytes())?;
/// assert_eq!(image[2..8], [0, 0xFF, 0xFF, 0xFF, 0xFE, 0]);
///
/// let mut bytes = [0; 4];
/// assert_eq!(POSITION.get(&image, &mut bytes)?, 4);
/// assert_eq!(i32::from_le_bytes(bytes), -2);
/// # Ok::<(), lexibus::LengthError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct ImageField {
    /// Whether the device gets it (an output of the controller), or sends it (an input).
    pub is_output: bool,
    /// The first bit: 8 for each byte before it, and the free bits below it in its last byte; of a little-endian field, in
    /// its first one.
    pub bit: u32,
    /// How many bits; of a number 64 at most.
    pub bits: u16,
    /// In which order they lie.
    pub order: ImageOrder,
}

impl ImageField {
    /// A big-endian number that the device sends.
    #[must_use]
    pub const fn input(bit: u32, bits: u16) -> Self {
        Self { is_output: false, bit, bits, order: ImageOrder::BigEndian }
    }

    /// A big-endian number that the device gets.
    #[must_use]
    pub const fn output(bit: u32, bits: u16) -> Self {
        Self { is_output: true, bit, bits, order: ImageOrder::BigEndian }
    }

    /// The same bits in another order.
    #[must_use]
    pub const fn ordered(self, order: ImageOrder) -> Self {
        Self { order, ..self }
    }

    /// How many bytes the value has, outside of the image.
    #[must_use]
    pub const fn byte_len(&self) -> usize {
        match self.order {
            ImageOrder::Bytes => self.bits.div_ceil(8) as usize,
            _ => byte_len(self.bits as u32),
        }
    }

    const fn first_byte(&self) -> usize {
        (self.bit / 8) as usize
    }

    /// The bits of the field, where its number is no longer than 64.
    const fn width(&self) -> u32 {
        if self.bits > 64 {
            64
        } else {
            self.bits as u32
        }
    }

    /// Whether `image` has all of the field.
    fn check(&self, image: &[u8]) -> Result<(), LengthError> {
        let end = (u64::from(self.bit) + u64::from(self.bits)).div_ceil(8);
        match usize::try_from(end) {
            Ok(end) if end <= image.len() => Ok(()),
            end => Err(LengthError::new(end.unwrap_or(usize::MAX), image.len())),
        }
    }

    /// Puts the value that the field has in `image` to the start of `buffer`, the least significant byte first, and returns
    /// how many bytes it has.
    ///
    /// # Errors
    ///
    /// [`LengthError`] where the image ends before the field does.
    pub fn get(&self, image: &[u8], buffer: &mut [u8]) -> Result<usize, LengthError> {
        self.check(image)?;
        let (at, shift) = (self.first_byte(), self.bit % 8);
        let number = match self.order {
            ImageOrder::BigEndian => be::number(image, at, shift, self.width()),
            ImageOrder::LittleEndian => bits::get(image, self.bit as usize, self.width()),
            ImageOrder::Bytes => {
                let bytes = image.get(at..).unwrap_or_default().iter().take(self.byte_len());
                buffer.iter_mut().zip(bytes).for_each(|(to, from)| *to = *from);
                return Ok(self.byte_len());
            }
        };
        let bytes = number.to_le_bytes();
        buffer.iter_mut().zip(bytes.iter().take(self.byte_len())).for_each(|(to, from)| *to = *from);
        Ok(self.byte_len())
    }

    /// Puts the value whose bytes `data` has, the least significant first, into the field, and leaves all other bits as they
    /// are. A text may be shorter than its field, which is filled up with 0.
    ///
    /// # Errors
    ///
    /// [`LengthError`] where the image ends before the field does, or `data` has another length.
    pub fn put(&self, image: &mut [u8], data: &[u8]) -> Result<(), LengthError> {
        self.check(image)?;
        let is_short_text = self.order == ImageOrder::Bytes && data.len() < self.byte_len();
        if data.len() != self.byte_len() && !is_short_text {
            return Err(LengthError::new(self.byte_len(), data.len()));
        }
        let (at, shift) = (self.first_byte(), self.bit % 8);
        match self.order {
            ImageOrder::BigEndian => be::put_number(image, at, shift, self.width(), crate::pdo::from_bytes(data)),
            ImageOrder::LittleEndian => {
                bits::set(image, self.bit as usize, self.width(), crate::pdo::from_bytes(data));
            }
            ImageOrder::Bytes => {
                let bytes = image.get_mut(at..).unwrap_or_default().iter_mut().take(self.byte_len());
                let padded = data.iter().chain(core::iter::repeat(&0));
                bytes.zip(padded).for_each(|(to, from)| *to = *from);
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn round_trip(field: ImageField, data: &[u8], image: [u8; 6]) {
        let mut frame = [0; 6];
        assert_eq!(field.put(&mut frame, data), Ok(()));
        assert_eq!(frame, image);
        let mut back = [0xAA; 4];
        assert_eq!(field.get(&image, &mut back[..data.len()]), Ok(data.len()));
        assert_eq!(&back[..data.len()], data);
    }

    #[test]
    fn orders() {
        round_trip(ImageField::output(8, 32), &[1, 2, 3, 4], [0, 4, 3, 2, 1, 0]);
        let little = ImageField::output(8, 32).ordered(ImageOrder::LittleEndian);
        round_trip(little, &[1, 2, 3, 4], [0, 1, 2, 3, 4, 0]);
        round_trip(little.ordered(ImageOrder::Bytes), b"abcd", [0, b'a', b'b', b'c', b'd', 0]);
    }

    #[test]
    fn bits_leave_the_others_alone() {
        round_trip(ImageField::input(8 + 2, 3), &[0b101], [0, 0b1_0100, 0, 0, 0, 0]);
        let mut image = [0xFF; 2];
        assert_eq!(ImageField::input(8 + 2, 3).put(&mut image, &[0]), Ok(()));
        assert_eq!(image, [0xFF, 0b1110_0011]);
    }

    #[test]
    fn texts_are_filled_up() {
        let text = ImageField::output(0, 32).ordered(ImageOrder::Bytes);
        let mut image = [0xFF; 5];
        assert_eq!(text.put(&mut image, b"ab"), Ok(()));
        assert_eq!(image, [b'a', b'b', 0, 0, 0xFF]);
        assert_eq!(text.put(&mut image, b"abcde"), Err(LengthError::new(4, 5)));
    }

    #[test]
    fn what_is_beyond_the_end_is_an_error() {
        let field = ImageField::input(8 * 3, 32);
        assert_eq!(field.get(&[0; 6], &mut [0; 4]), Err(LengthError::new(7, 6)));
        assert_eq!(field.put(&mut [0; 6], &[0; 4]), Err(LengthError::new(7, 6)));
        assert_eq!(field.put(&mut [0; 7], &[0; 2]), Err(LengthError::new(4, 2)));
        let far = ImageField { bit: u32::MAX, bits: u16::MAX, ..field };
        assert!(far.get(&[0; 6], &mut [0; 4]).is_err());
    }
}
