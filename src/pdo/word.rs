//! 64-bit words, used to pack and unpack PDOs of at most 8 bytes.

/// Returns a word with the low `bits` bits set; all bits if `bits` is 64 or more.
#[must_use]
#[inline]
pub const fn mask(bits: u32) -> u64 {
    match bits {
        0 => 0,
        1..=63 => u64::MAX >> (64 - bits),
        _ => u64::MAX,
    }
}

/// Returns the low `N` bytes of `word` in little-endian order. Bytes after the eighth are 0.
#[must_use]
#[inline]
#[expect(clippy::indexing_slicing, reason = "`at` is below `N` and 8")]
pub const fn to_bytes<const N: usize>(word: u64) -> [u8; N] {
    let bytes = word.to_le_bytes();
    let mut out = [0; N];
    let mut at = 0;
    while at < N && at < 8 {
        out[at] = bytes[at];
        at += 1;
    }
    out
}

/// Returns the first 8 bytes of `data` as a little-endian word. Missing bytes are 0.
#[must_use]
#[inline]
#[expect(clippy::indexing_slicing, reason = "`data` has less than 8 bytes")]
pub const fn from_bytes(data: &[u8]) -> u64 {
    if let Some(bytes) = data.first_chunk() {
        return u64::from_le_bytes(*bytes);
    }
    let mut bytes = [0; 8];
    let mut at = 0;
    while at < data.len() {
        bytes[at] = data[at];
        at += 1;
    }
    u64::from_le_bytes(bytes)
}

/// Sign-extends the low `bits` bits of `raw`. Returns 0 if `bits` is 0, and all of `raw` if `bits` is 64 or more.
#[must_use]
#[inline]
pub const fn sign_extend(raw: u64, bits: u32) -> i64 {
    match bits {
        0 => 0,
        1..=63 => (raw << (64 - bits)) as i64 >> (64 - bits),
        _ => raw as i64,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn masks() {
        assert_eq!((mask(0), mask(1), mask(12)), (0, 1, 0xFFF));
        assert_eq!((mask(63), mask(64), mask(65)), (u64::MAX >> 1, u64::MAX, u64::MAX));
    }

    #[test]
    fn bytes() {
        assert_eq!(to_bytes::<0>(0x0102), []);
        assert_eq!(to_bytes::<3>(0x0403_0201), [1, 2, 3]);
        assert_eq!(to_bytes::<9>(u64::MAX)[7..], [0xFF, 0]);
        assert_eq!(from_bytes(&[]), 0);
        assert_eq!(from_bytes(&[1, 2, 3]), 0x0003_0201);
        assert_eq!(from_bytes(&[1, 0, 0, 0, 0, 0, 0, 8, 9]), 0x0800_0000_0000_0001);
    }

    #[test]
    fn signs() {
        assert_eq!(sign_extend(0b111, 3), -1);
        assert_eq!(sign_extend(0b1011, 3), 3);
        assert_eq!(sign_extend(u64::MAX, 0), 0);
        assert_eq!(sign_extend(u64::MAX, 64), -1);
        assert_eq!(sign_extend(1 << 62, 63), -(1 << 62));
    }
}
