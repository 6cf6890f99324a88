//! Types of texts and byte strings with variable length.

use core::char::decode_utf16;
use core::fmt::{self, Write};

use crate::data_type::DataType;
use crate::value::Value;
use crate::value_error::{LengthError, TextError};

/// ISO 646 text, one byte per character (CiA 301 7.1.6.3).
#[derive(Clone, Copy, Debug, Default)]
pub struct VisibleString;

/// UTF-16 text, two bytes per code unit, the low byte first (CiA 301 7.1.6.4).
#[derive(Clone, Copy, Debug, Default)]
pub struct UnicodeString;

/// A byte string (CiA 301 7.1.6.2).
#[derive(Clone, Copy, Debug, Default)]
pub struct OctetString;

/// A block of bytes of any length (CiA 301 7.1.6.7).
#[derive(Clone, Copy, Debug, Default)]
pub struct Domain;

/// Bytes whose meaning is not in the device description.
#[derive(Clone, Copy, Debug, Default)]
pub struct Opaque;

macro_rules! variable {
    ($($marker:ident, $native:ty;)*) => {$(
        impl Value for $marker {
            type Native = $native;
            const DATA_TYPE: DataType = DataType::$marker;
        }
    )*};
}

variable! {
    VisibleString, &'static str;
    UnicodeString, &'static str;
    OctetString, &'static [u8];
    Domain, &'static [u8];
    Opaque, &'static [u8];
}

/// Returns the text in `bytes` up to the first NUL. Devices pad texts of a fixed length with NULs.
pub(crate) fn decode_visible(bytes: &[u8]) -> Result<&str, TextError> {
    let text = bytes.split(|&byte| byte == 0).next().unwrap_or_default();
    core::str::from_utf8(text).map_err(|_| TextError)
}

/// Returns the bytes of `text` if all characters are in the range 0x20 to 0x7E.
pub(crate) fn encode_visible(text: &str) -> Result<&[u8], TextError> {
    let bytes = text.as_bytes();
    if bytes.iter().all(|byte| matches!(byte, 0x20..=0x7E)) {
        Ok(bytes)
    } else {
        Err(TextError)
    }
}

/// Encodes `text` as UTF-16 at the start of `scratch` and returns the encoded part.
pub(crate) fn encode_utf16<'s>(text: &str, scratch: &'s mut [u8]) -> Result<&'s [u8], LengthError> {
    let (expected, actual) = (text.encode_utf16().count() * 2, scratch.len());
    let room = scratch.get_mut(..expected).ok_or(LengthError { expected, actual })?;
    for (pair, unit) in room.chunks_exact_mut(2).zip(text.encode_utf16()) {
        pair.copy_from_slice(&unit.to_le_bytes());
    }
    Ok(room)
}

/// UTF-16 text from a device. All code units are valid UTF-16. `Display` writes the text.
///
/// ```
/// use lexibus::Utf16;
///
/// let text = Utf16::new(&[b'5', 0, 0xB0, 0])?;
/// assert!(text.chars().eq("5°".chars()));
/// # Ok::<(), lexibus::TextError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Utf16<'b> {
    bytes: &'b [u8],
}

impl<'b> Utf16<'b> {
    /// Creates the text from `bytes`, which contain the low byte of each code unit first. The text ends before the
    /// first NUL.
    ///
    /// # Errors
    ///
    /// Returns [`TextError`] if the number of bytes is odd or one half of a surrogate pair is missing.
    pub fn new(bytes: &'b [u8]) -> Result<Self, TextError> {
        let length = units(bytes).take_while(|&unit| unit != 0).count() * 2;
        let text = Self { bytes: bytes.get(..length).unwrap_or(bytes) };
        let whole = bytes.len() % 2 == 0 && decode_utf16(units(text.bytes)).all(|unit| unit.is_ok());
        whole.then_some(text).ok_or(TextError)
    }

    /// Returns the characters of the text.
    pub fn chars(&self) -> impl Iterator<Item = char> + 'b {
        // `new` checked every code unit, so the filter discards nothing.
        decode_utf16(units(self.bytes)).filter_map(Result::ok)
    }
}

impl fmt::Display for Utf16<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.chars().try_for_each(|character| f.write_char(character))
    }
}

impl PartialEq<str> for Utf16<'_> {
    fn eq(&self, other: &str) -> bool {
        self.chars().eq(other.chars())
    }
}

impl PartialEq<&str> for Utf16<'_> {
    fn eq(&self, other: &&str) -> bool {
        self == *other
    }
}

fn units(bytes: &[u8]) -> impl Iterator<Item = u16> + '_ {
    bytes.chunks_exact(2).filter_map(|pair| pair.try_into().ok()).map(u16::from_le_bytes)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::string::ToString;

    #[test]
    fn visible_text_ends_at_the_first_nul() {
        assert_eq!(decode_visible(b"Drive\0\0\0"), Ok("Drive"));
        assert_eq!(decode_visible(b"\0rest"), Ok(""));
        assert_eq!(decode_visible(b""), Ok(""));
        assert_eq!(decode_visible(&[0xB0]), Err(TextError));
    }

    #[test]
    fn only_visible_characters_are_sent() {
        assert_eq!(encode_visible(" save~"), Ok(b" save~".as_slice()));
        assert_eq!(encode_visible("5°"), Err(TextError));
        assert_eq!(encode_visible("a\n"), Err(TextError));
    }

    #[test]
    fn utf16_round_trip() {
        let mut scratch = [0; 16];
        let bytes = encode_utf16("ä😀", &mut scratch).unwrap();
        assert_eq!(bytes, [0xE4, 0, 0x3D, 0xD8, 0x00, 0xDE]);
        let text = Utf16::new(bytes).unwrap();
        assert_eq!(text, "ä😀");
        assert_eq!(text.to_string(), "ä😀");
    }

    #[test]
    fn utf16_needs_room() {
        let error = LengthError { expected: 4, actual: 3 };
        assert_eq!(encode_utf16("ab", &mut [0; 3]), Err(error));
    }

    #[test]
    fn utf16_is_checked() {
        assert_eq!(Utf16::new(&[b'a', 0, b'b']), Err(TextError));
        assert_eq!(Utf16::new(&[0x3D, 0xD8]), Err(TextError));
        assert_eq!(Utf16::new(&[b'a', 0, 0, 0, 0x3D, 0xD8]).unwrap(), "a");
    }
}
