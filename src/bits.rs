//! Bit fields at any bit offset of a byte string.
//!
//! Bit 0 is the lowest bit of the first byte, bit 8 the lowest bit of the second byte. The bits of a PDO have the same
//! order (CiA 301 7.1.4).

use crate::pdo::{from_bytes, mask};
use crate::value_error::LengthError;

/// Checks that `data` contains at least `bits` bits.
///
/// # Errors
///
/// Returns [`LengthError`] if `data` contains fewer bits.
#[inline]
pub const fn check_length(data: &[u8], bits: usize) -> Result<(), LengthError> {
    let expected = bits.div_ceil(8);
    if data.len() < expected {
        return Err(LengthError::new(expected, data.len()));
    }
    Ok(())
}

/// Returns the field of `width` bits at bit offset `bit` of `data`. Bits beyond the end of `data`, and beyond the 64th
/// bit of the field, are 0.
#[must_use]
#[inline]
pub const fn get(data: &[u8], bit: usize, width: u32) -> u64 {
    let rest = skip(data, bit / 8);
    let shift = (bit % 8) as u32;
    // If offset and width are constants, the compiler reduces this `match` to one load of the bytes of the field.
    match shift.saturating_add(width).div_ceil(8) {
        1 => {
            if let Some(bytes) = rest.first_chunk() {
                return (u8::from_le_bytes(*bytes) >> shift) as u64 & mask(width);
            }
        }
        2 => {
            if let Some(bytes) = rest.first_chunk() {
                return (u16::from_le_bytes(*bytes) >> shift) as u64 & mask(width);
            }
        }
        3 | 4 => {
            if let Some(bytes) = rest.first_chunk() {
                return (u32::from_le_bytes(*bytes) >> shift) as u64 & mask(width);
            }
        }
        _ => {}
    }
    let low = from_bytes(rest) >> shift;
    let high = if let [_, _, _, _, _, _, _, _, ninth, ..] = rest { above(*ninth as u64, shift) } else { 0 };
    (low | high) & mask(width)
}

/// Returns `buffer` with the low `width` bits of `value` at bit offset `bit`. Ignores bits beyond the end of `buffer`
/// and beyond the 64th bit of the field.
#[must_use]
#[inline]
#[expect(clippy::indexing_slicing, reason = "`first + 8` is below `N`")]
pub const fn put<const N: usize>(buffer: [u8; N], bit: usize, width: u32, value: u64) -> [u8; N] {
    let (first, shift) = (bit / 8, (bit % 8) as u32);
    // If the offset is a constant, the compiler writes whole bytes with one store.
    if shift == 0 && width % 8 == 0 {
        return put_first(buffer, first, width as usize / 8, value);
    }
    let field = mask(width);
    let value = value & field;
    let word = from_bytes(skip(&buffer, first)) & !(field << shift) | value << shift;
    let mut out = put_word(buffer, first, word);
    if first < N && N - first > 8 {
        out[first + 8] = (out[first + 8] as u64 & !beyond(field, shift) | beyond(value, shift)) as u8;
    }
    out
}

/// Returns the first `N` bytes of `words`. Each word starts with its lowest byte. Bytes after the last word are 0.
#[must_use]
#[inline]
#[expect(clippy::indexing_slicing, reason = "`at` is below `W`")]
pub const fn from_words<const W: usize, const N: usize>(words: [u64; W]) -> [u8; N] {
    let mut out = [0; N];
    let mut at = 0;
    while at < W {
        out = put_word(out, 8 * at, words[at]);
        at += 1;
    }
    out
}

/// Writes the low `width` bits of `value` at bit offset `bit` of `data`. Ignores bits beyond the end of `data` and
/// beyond the 64th bit of the field.
#[inline]
pub fn set(data: &mut [u8], bit: usize, width: u32, value: u64) {
    let (first, shift) = (bit / 8, (bit % 8) as u32);
    let field = mask(width);
    let value = value & field;
    let Some(rest) = data.get_mut(first..) else { return };
    // If offset and width are constants, the compiled code accesses only the bytes of the field.
    match shift.saturating_add(width).div_ceil(8) {
        1 => {
            if let Some(bytes) = rest.first_chunk_mut() {
                *bytes = (u8::from_le_bytes(*bytes) & !((field << shift) as u8) | (value << shift) as u8).to_le_bytes();
                return;
            }
        }
        2 => {
            if let Some(bytes) = rest.first_chunk_mut() {
                let kept = u16::from_le_bytes(*bytes) & !((field << shift) as u16);
                *bytes = (kept | (value << shift) as u16).to_le_bytes();
                return;
            }
        }
        3 | 4 => {
            if let Some(bytes) = rest.first_chunk_mut() {
                let kept = u32::from_le_bytes(*bytes) & !((field << shift) as u32);
                *bytes = (kept | (value << shift) as u32).to_le_bytes();
                return;
            }
        }
        _ => {}
    }
    if let Some(bytes) = rest.first_chunk_mut::<8>() {
        *bytes = (u64::from_le_bytes(*bytes) & !(field << shift) | value << shift).to_le_bytes();
    } else {
        let word = from_bytes(rest) & !(field << shift) | value << shift;
        for (byte, new) in rest.iter_mut().zip(word.to_le_bytes()) {
            *byte = new;
        }
    }
    if let Some(byte) = rest.get_mut(8) {
        *byte = (u64::from(*byte) & !beyond(field, shift) | beyond(value, shift)) as u8;
    }
}

/// Writes `bytes` at bit offset `bit` of `data`. Ignores bits beyond the end of `data`.
#[inline]
pub fn set_bytes(data: &mut [u8], bit: usize, bytes: &[u8]) {
    if bit % 8 == 0 {
        let rest = data.get_mut(bit / 8..).unwrap_or_default();
        let fitting = rest.len().min(bytes.len());
        if let (Some(to), Some(from)) = (rest.get_mut(..fitting), bytes.get(..fitting)) {
            to.copy_from_slice(from);
        }
        return;
    }
    set_bits(data, bit, 8 * bytes.len(), bytes);
}

/// Writes the first `width` bits of `bytes` at bit offset `bit` of `data`. Ignores bits beyond the end of `data`.
#[inline]
pub fn set_bits(data: &mut [u8], bit: usize, width: usize, bytes: &[u8]) {
    for (chunk, from) in bytes.chunks(8).zip((0..width).step_by(64)) {
        let left = width - from;
        set(data, bit.saturating_add(from), part(chunk, left), from_bytes(chunk));
    }
}

/// Returns the `N` bytes at bit offset `bit` of `data`. Bits beyond the end of `data` are 0.
#[must_use]
#[inline]
pub const fn get_bytes<const N: usize>(data: &[u8], bit: usize) -> [u8; N] {
    if bit % 8 == 0 {
        if let Some(bytes) = skip(data, bit / 8).first_chunk() {
            return *bytes;
        }
    }
    let mut out = [0; N];
    let (mut at, mut from) = (0, bit);
    while at < N && from / 8 < data.len() {
        out = put_word(out, at, get(data, from, 64));
        at += 8;
        from += 64;
    }
    out
}

/// Returns the first `width` bits of the `N` bytes at bit offset `bit`. The other bits of the result are 0, and so are
/// bits beyond the end of `data`.
#[must_use]
#[inline]
#[expect(clippy::indexing_slicing, reason = "`at` is below `N`")]
pub const fn get_bits<const N: usize>(data: &[u8], bit: usize, width: usize) -> [u8; N] {
    let mut out = get_bytes(data, bit);
    let mut at = width / 8;
    let mut kept = mask(width as u32 % 8) as u8;
    while at < N {
        out[at] &= kept;
        at += 1;
        kept = 0;
    }
    out
}

/// Returns `buffer` with `bytes` at bit offset `bit`. Ignores bits beyond the end of `buffer`.
#[must_use]
#[inline]
pub const fn put_bytes<const N: usize>(buffer: [u8; N], bit: usize, bytes: &[u8]) -> [u8; N] {
    put_bits(buffer, bit, 8 * bytes.len(), bytes)
}

/// Returns `buffer` with the first `width` bits of `bytes` at bit offset `bit`. Ignores bits beyond the end of
/// `buffer`.
#[must_use]
#[inline]
pub const fn put_bits<const N: usize>(buffer: [u8; N], bit: usize, width: usize, bytes: &[u8]) -> [u8; N] {
    let mut out = buffer;
    let (mut rest, mut left) = (bytes, width);
    let mut to = bit;
    while !rest.is_empty() && left > 0 && to / 8 < N {
        out = put(out, to, part(rest, left), from_bytes(rest));
        rest = skip(rest, 8);
        left = left.saturating_sub(64);
        to += 64;
    }
    out
}

/// Returns how many of the `left` remaining bits are in the first eight bytes of `bytes`.
#[inline]
const fn part(bytes: &[u8], left: usize) -> u32 {
    let word = if bytes.len() < 8 { 8 * bytes.len() } else { 64 };
    (if left < word { left } else { word }) as u32
}

/// Returns `data` without its first `count` bytes.
#[inline]
const fn skip(data: &[u8], count: usize) -> &[u8] {
    if count < data.len() {
        data.split_at(count).1
    } else {
        &[]
    }
}

/// Writes the bytes of `word` to `buffer` at byte offset `first`, lowest byte first, and returns `buffer`. Ignores
/// bytes beyond the end of `buffer`.
#[inline]
const fn put_word<const N: usize>(buffer: [u8; N], first: usize, word: u64) -> [u8; N] {
    put_first(buffer, first, 8, word)
}

/// Writes the `count` lowest bytes of `word` to `buffer`, lowest byte first, and returns `buffer`. `first` is the byte
/// offset in `buffer`. Writes at most eight bytes, and ignores bytes beyond the end of `buffer`.
#[inline]
#[expect(clippy::indexing_slicing, reason = "`at` is below 8, and `first + at` is below `N`")]
const fn put_first<const N: usize>(buffer: [u8; N], first: usize, count: usize, word: u64) -> [u8; N] {
    let bytes = word.to_le_bytes();
    let mut out = buffer;
    let mut at = 0;
    while at < 8 && at < count && first < N && at < N - first {
        out[first + at] = bytes[at];
        at += 1;
    }
    out
}

/// Returns the bits that a right shift by `shift` bits moves into a word. `byte` is the byte after the word, and
/// `shift` is at most 7.
#[inline]
const fn above(byte: u64, shift: u32) -> u64 {
    byte << 1 << (63 - shift)
}

/// Returns the bits that a left shift by `shift` bits moves out of `word`. `shift` is at most 7.
#[inline]
const fn beyond(word: u64, shift: u32) -> u64 {
    word >> 1 >> (63 - shift)
}

#[cfg(test)]
mod tests {
    use super::*;

    const LEN: usize = 11;

    fn bit_of(data: &[u8], bit: usize) -> bool {
        data.get(bit / 8).is_some_and(|byte| byte >> (bit % 8) & 1 == 1)
    }

    fn slow_get(data: &[u8], bit: usize, width: u32) -> u64 {
        (0..width.min(64)).fold(0, |word, at| word | u64::from(bit_of(data, bit + at as usize)) << at)
    }

    fn set_bit(data: &mut [u8], bit: usize, value: bool) {
        if let Some(byte) = data.get_mut(bit / 8) {
            *byte = *byte & !(1 << (bit % 8)) | u8::from(value) << (bit % 8);
        }
    }

    fn slow_put(mut buffer: [u8; LEN], bit: usize, width: u32, value: u64) -> [u8; LEN] {
        (0..width.min(64)).for_each(|at| set_bit(&mut buffer, bit + at as usize, value >> at & 1 == 1));
        buffer
    }

    /// Returns a pseudorandom word, which depends only on `seed`.
    fn noise(seed: u64) -> u64 {
        let mixed = (seed ^ 0x9E37_79B9_7F4A_7C15).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        (mixed ^ mixed >> 31).wrapping_mul(0x94D0_49BB_1331_11EB)
    }

    fn noisy_bytes(seed: u64) -> [u8; LEN] {
        core::array::from_fn(|at| noise(seed + at as u64) as u8)
    }

    #[test]
    fn agrees_with_bit_by_bit() {
        for bit in 0..LEN * 8 + 20 {
            for width in 0..=66 {
                let seed = (bit * 100 + width as usize) as u64;
                let (data, value) = (noisy_bytes(seed), noise(!seed));
                assert_eq!(get(&data, bit, width), slow_get(&data, bit, width), "get {bit} {width}");
                assert_eq!(put(data, bit, width, value), slow_put(data, bit, width, value), "put {bit} {width}");
                let mut changed = data;
                set(&mut changed, bit, width, value);
                assert_eq!(changed, slow_put(data, bit, width, value), "set {bit} {width}");
            }
        }
    }

    #[test]
    fn byte_strings_agree_with_bit_by_bit() {
        let data = noisy_bytes(7);
        for bit in 0..LEN * 8 + 20 {
            let got: [u8; 10] = get_bytes(&data, bit);
            assert!((0..80).all(|at| bit_of(&got, at) == bit_of(&data, bit + at)), "get {bit}");
            let mut expected = [0xFF; LEN];
            (0..80).for_each(|at| set_bit(&mut expected, bit + at, bit_of(&data, at)));
            assert_eq!(put_bytes([0xFF; LEN], bit, &data[..10]), expected, "put {bit}");
            let mut changed = [0xFF; LEN];
            set_bytes(&mut changed, bit, &data[..10]);
            assert_eq!(changed, expected, "set {bit}");
        }
    }

    #[test]
    fn parts_of_byte_strings_agree_with_bit_by_bit() {
        let data = noisy_bytes(9);
        for (bit, width) in (0..LEN * 8 + 5).flat_map(|bit| (0..=80).map(move |width| (bit, width))) {
            let got: [u8; 10] = get_bits(&data, bit, width);
            assert!((0..80).all(|at| bit_of(&got, at) == (at < width && bit_of(&data, bit + at))), "get {bit} {width}");
            let mut expected = [0xA5; LEN];
            (0..width).for_each(|at| set_bit(&mut expected, bit + at, bit_of(&data, at)));
            assert_eq!(put_bits([0xA5; LEN], bit, width, &data[..10]), expected, "put {bit} {width}");
            let mut changed = [0xA5; LEN];
            set_bits(&mut changed, bit, width, &data[..10]);
            assert_eq!(changed, expected, "set {bit} {width}");
        }
        // A width beyond the end of `bytes` writes only the bits of `bytes`.
        assert_eq!(put_bits([0xFF; 3], 4, 100, &[0]), [0x0F, 0xF0, 0xFF]);
        let mut changed = [0xFF; 3];
        set_bits(&mut changed, 4, usize::MAX, &[0]);
        assert_eq!(changed, [0x0F, 0xF0, 0xFF]);
        assert_eq!(get_bits::<2>(&[0xFF; 3], 4, usize::MAX), [0xFF; 2]);
    }

    #[test]
    fn far_beyond_the_end() {
        assert_eq!(get(&[0xFF; 3], usize::MAX, 64), 0);
        assert_eq!(put([0; 3], usize::MAX, 64, u64::MAX), [0; 3]);
        assert_eq!(get_bytes::<20>(&[0xFF; 3], usize::MAX - 70), [0; 20]);
        assert_eq!(put_bytes([0; 3], usize::MAX, &[0xFF; 20]), [0; 3]);
        assert_eq!(put_bytes([0; 0], 0, &[1]), [0_u8; 0]);
        let mut data = [0; 3];
        set_bytes(&mut data, usize::MAX - 70, &[0xFF; 20]);
        assert_eq!(data, [0; 3]);
    }

    #[test]
    fn words_become_bytes() {
        let words = [0x0807_0605_0403_0201, 0x100F_0E0D_0C0B_0A09];
        assert_eq!(from_words::<2, 11>(words), [1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11]);
        assert_eq!(from_words::<1, 10>([u64::MAX])[7..], [0xFF, 0, 0]);
        assert_eq!(from_words::<0, 1>([]), [0]);
    }

    #[test]
    fn works_in_constants() {
        const FRAME: [u8; 2] = put([0; 2], 4, 8, 0xAB);
        const FIELD: u64 = get(&FRAME, 4, 8);
        assert_eq!((FRAME, FIELD), ([0xB0, 0x0A], 0xAB));
    }
}
