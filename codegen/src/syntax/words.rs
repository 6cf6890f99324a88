//! Eight bytes compared at once, for texts so short that setting up a search takes longer.

const ONES: u64 = u64::from_le_bytes([1; 8]);
const HIGHS: u64 = ONES << 7;

/// Eight bytes, the first one lowest.
#[inline]
pub(super) fn word(bytes: &[u8]) -> u64 {
    u64::from_le_bytes(bytes.try_into().unwrap_or_default())
}

/// The high bit of each byte of `word` that is `byte`, and perhaps of bytes after the first of these.
#[inline]
pub(super) fn equal(word: u64, byte: u8) -> u64 {
    let zeros = word ^ (ONES * u64::from(byte));
    zeros.wrapping_sub(ONES) & !zeros & HIGHS
}

/// The same for bytes that are less than `byte`, which is at most 0x80.
#[inline]
#[cfg_attr(not(feature = "xml"), allow(dead_code))]
pub(super) fn less(word: u64, byte: u8) -> u64 {
    word.wrapping_sub(ONES * u64::from(byte)) & !word & HIGHS
}

/// The position of the first byte that a result of these marks.
#[inline]
pub(super) fn first(marks: u64) -> usize {
    marks.trailing_zeros() as usize / 8
}
