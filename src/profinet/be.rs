//! Big-endian fields in a byte string.
//!
//! A bit field is a part of a big-endian number. This number consists of all bytes that contain bits of the field. Bit
//! 0 is the least significant bit of the last byte. If a number exceeds the end of the data, its missing bytes are read
//! as 0. A write beyond the end has no effect.

use crate::pdo::{mask, sign_extend};
use crate::time::{TimeDifference, TimeOfDay};
use crate::value_error::LengthError;

/// Returns `N` bytes that start at byte offset `at`. Returns zeros if the data are too short.
#[must_use]
#[inline]
pub const fn bytes<const N: usize>(data: &[u8], at: usize) -> [u8; N] {
    if let Some((_, rest)) = data.split_at_checked(at) {
        if let Some(chunk) = rest.first_chunk() {
            return *chunk;
        }
    }
    [0; N]
}

/// Returns the first `N` bytes of the data.
///
/// # Errors
///
/// Returns [`LengthError`] if the data have fewer than `N` bytes.
#[inline]
pub const fn chunk<const N: usize>(data: &[u8]) -> Result<&[u8; N], LengthError> {
    match data.first_chunk() {
        Some(chunk) => Ok(chunk),
        None => Err(LengthError::new(N, data.len())),
    }
}

/// Returns the first `N` bytes of the data for writing.
///
/// # Errors
///
/// Returns [`LengthError`] if the data have fewer than `N` bytes.
#[inline]
pub fn chunk_mut<const N: usize>(data: &mut [u8]) -> Result<&mut [u8; N], LengthError> {
    let error = LengthError::new(N, data.len());
    data.first_chunk_mut().ok_or(error)
}

/// Writes `bytes` to the start of the data and returns the written bytes.
///
/// # Errors
///
/// Returns [`LengthError`] if the data are shorter than `bytes`.
#[inline]
pub fn write<'d>(data: &'d mut [u8], bytes: &[u8]) -> Result<&'d [u8], LengthError> {
    let error = LengthError::new(bytes.len(), data.len());
    let to = data.get_mut(..bytes.len()).ok_or(error)?;
    to.copy_from_slice(bytes);
    Ok(to)
}

/// Writes `bytes` at byte offset `at`.
#[inline]
pub fn put(data: &mut [u8], at: usize, bytes: &[u8]) {
    if let Some(to) = data.get_mut(at..).and_then(|rest| rest.get_mut(..bytes.len())) {
        to.copy_from_slice(bytes);
    }
}

/// Sets or clears a bit of the byte at offset `at`. Bit 0 is the least significant bit.
#[inline]
pub fn put_bit(data: &mut [u8], at: usize, bit: u32, value: bool) {
    if let Some(byte) = data.get_mut(at) {
        let mask = 1_u8.wrapping_shl(bit);
        *byte = if value { *byte | mask } else { *byte & !mask };
    }
}

/// Returns the number of bytes that contain bits of a field, at most 8. The field has `width` bits at bit offset
/// `shift`.
const fn touched(shift: u32, width: u32) -> usize {
    let bytes = shift.saturating_add(width).div_ceil(8);
    if bytes > 8 {
        8
    } else {
        bytes as usize
    }
}

/// Returns the number of bits that a field has in a ninth byte, or `None` if the field ends before the ninth byte.
const fn in_ninth(shift: u32, width: u32) -> Option<u32> {
    if shift < 8 && width <= 64 && shift + width > 64 {
        Some(8 - shift)
    } else {
        None
    }
}

/// Reads an unsigned number of `width` bits, 1 to 64. The number starts at byte offset `at` and bit offset `shift`.
#[must_use]
#[inline]
#[expect(clippy::indexing_slicing, reason = "`next` is below the length")]
pub const fn number(data: &[u8], at: usize, shift: u32, width: u32) -> u64 {
    let (mut word, mut next) = (0, at);
    if let Some(low) = in_ninth(shift, width) {
        let high = number(data, at, 0, width - low);
        return high << low | number(data, at.saturating_add(8), shift, low);
    }
    let end = at.saturating_add(touched(shift, width));
    while next < end {
        word = word << 8 | if next < data.len() { data[next] as u64 } else { 0 };
        next += 1;
    }
    word.wrapping_shr(shift) & mask(width)
}

macro_rules! bits {
    ($($unsigned:ident $u:ty, $signed:ident $i:ty;)*) => {$(
        /// Reads a [`number`] as an unsigned integer. Bits above the width of the integer are discarded.
        #[must_use]
        #[inline]
        pub const fn $unsigned(data: &[u8], at: usize, shift: u32, width: u32) -> $u {
            number(data, at, shift, width) as $u
        }

        /// Reads a [`number`] as a signed integer in two's complement. Bits above the width of the integer are
        /// discarded.
        #[must_use]
        #[inline]
        pub const fn $signed(data: &[u8], at: usize, shift: u32, width: u32) -> $i {
            sign_extend(number(data, at, shift, width), width) as $i
        }
    )*};
}

bits! {
    bits_u8 u8, bits_i8 i8;
    bits_u16 u16, bits_i16 i16;
    bits_u32 u32, bits_i32 i32;
    bits_u64 u64, bits_i64 i64;
}

/// Writes the low `width` bits of `value` at byte offset `at` and bit offset `shift`. All other bits keep their values.
#[inline]
pub fn put_number(data: &mut [u8], at: usize, shift: u32, width: u32, value: u64) {
    if let Some(low) = in_ninth(shift, width) {
        let last = at.saturating_add(8);
        if last < data.len() {
            put_number(data, at, 0, width - low, value >> low);
            put_number(data, last, shift, low, value);
        }
        return;
    }
    let field = mask(width).wrapping_shl(shift);
    let value = value.wrapping_shl(shift) & field;
    let last = touched(shift, width).saturating_sub(1);
    if let Some(bytes) = data.get_mut(at..).and_then(|rest| rest.get_mut(..=last)) {
        for (place, byte) in bytes.iter_mut().rev().enumerate() {
            let down = 8 * place as u32;
            *byte = *byte & !((field >> down) as u8) | (value >> down) as u8;
        }
    }
}

/// Reads a "TimeOfDay with date indication" (IEC 61158-6). The low 28 bits of the first 4 bytes contain milliseconds.
/// The last 2 bytes contain days since 1984.
#[must_use]
#[inline]
pub const fn time_of_day(data: &[u8], at: usize) -> TimeOfDay {
    let [a, b, c, d, high, low] = bytes(data, at);
    TimeOfDay::new(u32::from_be_bytes([a & 0x0F, b, c, d]), u16::from_be_bytes([high, low]))
}

/// Encodes a "TimeOfDay with date indication", the format of [`time_of_day`].
#[must_use]
#[inline]
pub const fn from_time_of_day(time: TimeOfDay) -> [u8; 6] {
    from_time(time.milliseconds, time.days)
}

/// Reads a "TimeDifference with date indication" (IEC 61158-6). The low 28 bits of the first 4 bytes contain
/// milliseconds. The last 2 bytes contain days.
#[must_use]
#[inline]
pub const fn time_difference(data: &[u8], at: usize) -> TimeDifference {
    let [a, b, c, d, high, low] = bytes(data, at);
    TimeDifference::new(u32::from_be_bytes([a & 0x0F, b, c, d]), u16::from_be_bytes([high, low]))
}

/// Encodes a "TimeDifference with date indication", the format of [`time_difference`].
#[must_use]
#[inline]
pub const fn from_time_difference(time: TimeDifference) -> [u8; 6] {
    from_time(time.milliseconds, time.days)
}

const fn from_time(milliseconds: u32, days: u16) -> [u8; 6] {
    let [a, b, c, d] = milliseconds.to_be_bytes();
    let [high, low] = days.to_be_bytes();
    [a & 0x0F, b, c, d, high, low]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn whole_bytes() {
        const WORD: [u8; 2] = bytes(&[1, 2, 3], 1);
        assert_eq!(WORD, [2, 3]);
        assert_eq!(bytes::<2>(&[1, 2, 3], 2), [0, 0], "beyond the end");
        assert_eq!(bytes::<1>(&[1], usize::MAX), [0]);
        let mut data = [0; 4];
        put(&mut data, 1, &0x0102_u16.to_be_bytes());
        put(&mut data, 3, &[9, 9]);
        put(&mut data, usize::MAX, &[9, 9]);
        assert_eq!(data, [0, 1, 2, 0]);
        assert_eq!(chunk::<2>(&data), Ok(&[0, 1]));
        assert_eq!(chunk::<5>(&data), Err(LengthError::new(5, 4)));
        *chunk_mut::<2>(&mut data).unwrap() = [7, 8];
        assert_eq!(write(&mut data, &[9]), Ok(&[9][..]));
        assert_eq!(data, [9, 8, 2, 0]);
        assert_eq!(chunk_mut::<5>(&mut data), Err(LengthError::new(5, 4)));
        assert_eq!(write(&mut data, &[0; 5]), Err(LengthError::new(5, 4)));
    }

    #[test]
    fn bits_within_a_byte() {
        let mut data = [0b1000_0001, 0xFF];
        put_bit(&mut data, 0, 2, true);
        put_bit(&mut data, 1, 7, false);
        put_bit(&mut data, 2, 0, true);
        assert_eq!(data, [0b1000_0101, 0x7F]);
        assert_eq!(number(&data, 0, 2, 3), 0b001);
        put_number(&mut data, 0, 4, 3, 0xFF);
        assert_eq!(data, [0b1111_0101, 0x7F]);
    }

    /// Reference implementation of [`number`], which reads bit by bit.
    fn slowly(data: &[u8], at: usize, shift: u32, width: u32) -> u64 {
        let last = at + ((shift + width).div_ceil(8) as usize) - 1;
        (0..width).fold(0, |number, bit| {
            let place = shift + bit;
            let byte = data[last - (place / 8) as usize];
            number | u64::from(byte >> (place % 8) & 1) << bit
        })
    }

    #[test]
    fn fields_of_every_width_at_every_bit() {
        let data: [u8; 12] = core::array::from_fn(|at| (at as u8).wrapping_mul(73) ^ 0xA5);
        for (shift, width) in (0..8).flat_map(|shift| (1..=64).map(move |width| (shift, width))) {
            let value = number(&data, 1, shift, width);
            assert_eq!(value, slowly(&data, 1, shift, width), "{shift} {width}");
            let mut written = data;
            put_number(&mut written, 1, shift, width, !value);
            assert_eq!(number(&written, 1, shift, width), !value & mask(width), "{shift} {width}");
            put_number(&mut written, 1, shift, width, value);
            assert_eq!(written, data, "no other bit changes: {shift} {width}");
            let short = &mut written[..((shift + width).div_ceil(8)) as usize];
            let before = short.to_vec();
            put_number(short, 1, shift, width, !value);
            assert_eq!(short, before, "a write beyond the end changes nothing: {shift} {width}");
        }
    }

    #[test]
    fn bits_across_bytes_are_a_part_of_a_big_endian_number() {
        // 0x1234 >> 6 & 0xF = 0b0001_00[10_00]11_0100 = 8.
        assert_eq!(number(&[0x12, 0x34], 0, 6, 4), 0b1000);
        let mut data = [0xFF; 4];
        put_number(&mut data, 1, 6, 4, 0);
        assert_eq!(data, [0xFF, 0b1111_1100, 0b0011_1111, 0xFF]);
        assert_eq!(number(&[1, 2, 3], 0, 0, 24), 0x01_0203);
        put_number(&mut data, 0, 0, 24, 0xAA01_0203);
        assert_eq!(data, [1, 2, 3, 0xFF]);
        assert_eq!((bits_u8(&[0x0C], 0, 2, 2), bits_i8(&[0x0C], 0, 2, 2)), (3, -1));
        assert_eq!((bits_u32(&[0xFF; 3], 0, 0, 24), bits_i32(&[0xFF; 3], 0, 0, 24)), (0xFF_FFFF, -1));
    }

    #[test]
    fn every_field_comes_back_and_leaves_the_rest() {
        for shift in 0..8 {
            for width in 1..=64 - shift {
                let value = 0xDEAD_BEEF_0BAD_CAFE & mask(width);
                let mut data = [0x55; 10];
                put_number(&mut data, 1, shift, width, value);
                assert_eq!(number(&data, 1, shift, width), value, "{shift} {width}");
                put_number(&mut data, 1, shift, width, number(&[0x55; 10], 1, shift, width));
                assert_eq!(data, [0x55; 10], "{shift} {width}");
            }
        }
    }

    #[test]
    fn far_beyond_the_end() {
        assert_eq!(number(&[0xFF; 2], 1, 0, 16), 0xFF00);
        assert_eq!(number(&[0xFF; 2], usize::MAX, 0, 16), 0);
        let mut data = [0; 2];
        put_number(&mut data, 1, 0, 16, 0xFFFF);
        put_number(&mut data, usize::MAX, 0, 16, 0xFFFF);
        put_number(&mut data, 0, 80, 16, 0xFFFF);
        assert_eq!(data, [0; 2]);
    }

    #[test]
    fn times() {
        let data = [0xFF, 0xF1, 0x02, 0x03, 0x04, 0x12, 0x34];
        let time = time_of_day(&data, 1);
        assert_eq!((time.milliseconds, time.days), (0x0102_0304, 0x1234));
        assert_eq!(from_time_of_day(time), [0x01, 0x02, 0x03, 0x04, 0x12, 0x34]);
        assert_eq!(from_time_difference(time_difference(&data, 1)), [0x01, 0x02, 0x03, 0x04, 0x12, 0x34]);
    }
}
