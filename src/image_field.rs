//! Fields of a fixed process image.

use crate::bits;
use crate::profinet::be;
use crate::value::byte_len;
use crate::value_error::LengthError;

/// Byte order of a field.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum ImageOrder {
    /// A number with its most significant byte first, as in PROFINET. A field that doesn't fill whole bytes is a bit
    /// field of a big-endian number.
    #[default]
    BigEndian,
    /// A number with its least significant byte first, as in EtherCAT.
    LittleEndian,
    /// A text or a byte string.
    Bytes,
}

/// A field in a fixed process image: a number, a text or a byte string.
///
/// A [`Client`](crate::Client) transfers values with the least significant byte first. In an image, each field has its
/// own byte order:
///
/// ```
/// use lexibus::ImageField;
///
/// // An input of the controller: four bytes from byte offset 3 on.
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
    /// True if the field is an output of the controller, which the device receives; false if the field is an input,
    /// which the device sends.
    pub is_output: bool,
    /// Bit offset: eight times the offset of the first byte, plus the position of the field's least significant bit in
    /// its byte (0 to 7). The least significant bit is in the last byte of a big-endian field, and in the first byte of
    /// a little-endian field.
    pub bit: u32,
    /// Length in bits, at most 64 for a number.
    pub bits: u16,
    /// Byte order of the field.
    pub order: ImageOrder,
}

impl ImageField {
    /// Creates a big-endian input field, which the device sends.
    #[must_use]
    pub const fn input(bit: u32, bits: u16) -> Self {
        Self { is_output: false, bit, bits, order: ImageOrder::BigEndian }
    }

    /// Creates a big-endian output field, which the device receives.
    #[must_use]
    pub const fn output(bit: u32, bits: u16) -> Self {
        Self { is_output: true, bit, bits, order: ImageOrder::BigEndian }
    }

    /// Returns the field with the byte order `order`.
    #[must_use]
    pub const fn ordered(self, order: ImageOrder) -> Self {
        Self { order, ..self }
    }

    /// Returns the length of the value that [`get`](Self::get) and [`put`](Self::put) transfer, in bytes.
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

    /// Returns the length of the field in bits, at most 64.
    const fn width(&self) -> u32 {
        if self.bits > 64 {
            64
        } else {
            self.bits as u32
        }
    }

    /// Checks that `image` contains the whole field.
    fn check(&self, image: &[u8]) -> Result<(), LengthError> {
        let end = (u64::from(self.bit) + u64::from(self.bits)).div_ceil(8);
        match usize::try_from(end) {
            Ok(end) if end <= image.len() => Ok(()),
            end => Err(LengthError::new(end.unwrap_or(usize::MAX), image.len())),
        }
    }

    /// Reads the field from `image` and writes the value to the start of `buffer`. In `buffer`, the least significant
    /// byte of a number comes first. Returns the length of the value in bytes, even if `buffer` is shorter.
    ///
    /// # Errors
    ///
    /// Returns [`LengthError`] if the image ends before the end of the field.
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

    /// Writes the value in `data` to the field. In `data`, the least significant byte of a number comes first. All
    /// other bits of the image keep their values. A text that is shorter than its field is padded with zeros.
    ///
    /// # Errors
    ///
    /// Returns [`LengthError`] if the image ends before the end of the field, or if the length of `data` doesn't match
    /// the field.
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
