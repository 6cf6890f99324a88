//! Functions that compare eight bytes at once. For short texts, this method is faster than a vectorized search.

const ONES: u64 = u64::from_le_bytes([1; 8]);
const HIGHS: u64 = ONES << 7;

/// Returns eight bytes as a little-endian `u64`, or 0 if `bytes` does not contain exactly eight bytes.
#[inline]
pub(super) fn word(bytes: &[u8]) -> u64 {
    u64::from_le_bytes(bytes.try_into().unwrap_or_default())
}

/// Returns a mask in which the high bit of each byte is set if the byte at this position in `word` equals `byte`. The result can
/// be wrong for bytes after the first match.
#[inline]
pub(super) fn equal(word: u64, byte: u8) -> u64 {
    let zeros = word ^ (ONES * u64::from(byte));
    zeros.wrapping_sub(ONES) & !zeros & HIGHS
}

/// Returns a mask in which the high bit of each byte is set if the byte at this position in `word` is less than `byte`.
/// `byte` must be at most 0x80. The result can be wrong for bytes after the first match.
#[inline]
pub(super) fn less(word: u64, byte: u8) -> u64 {
    word.wrapping_sub(ONES * u64::from(byte)) & !word & HIGHS
}

/// Returns the position of the first byte whose high bit is set in a mask.
#[inline]
pub(super) fn first(marks: u64) -> usize {
    marks.trailing_zeros() as usize / 8
}

/// Returns whether two texts of 8 to 16 bytes and of the same length are equal. For such texts, this function is faster than a
/// comparison of slices.
#[inline]
pub fn equal_texts(one: &[u8], other: &[u8]) -> bool {
    debug_assert!(one.len() == other.len() && (8..=16).contains(&one.len()));
    let ends = |text: &[u8]| (text.first_chunk::<8>().copied(), text.last_chunk::<8>().copied());
    ends(one) == ends(other)
}

/// Returns the position of the first byte that `marks` marks in a word, or the length of `text`. `marks` returns a mask as
/// [`equal`] does, and must mark line feeds.
#[inline(always)]
pub(super) fn find(text: &[u8], marks: impl Fn(u64) -> u64) -> usize {
    let mut at = 0;
    let mut words = text.chunks_exact(8);
    for eight in words.by_ref() {
        let found = marks(word(eight));
        if found != 0 {
            return at + first(found);
        }
        at += 8;
    }
    // The line feeds after the rest of the text mark its end.
    let mut last = [b'\n'; 8];
    let rest = words.remainder();
    last[..rest.len()].copy_from_slice(rest);
    at + first(marks(word(&last)))
}
