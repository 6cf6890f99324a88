//! Words of 64 bits, with which a PDO of at most 8 bytes is packed and unpacked.

/// A word whose low `bits` bits are set; all of them from 64 on.
#[must_use]
#[inline]
pub const fn mask(bits: u32) -> u64 {
    match bits {
        0 => 0,
        1..=63 => u64::MAX >> (64 - bits),
        _ => u64::MAX,
    }
}

/// The low `N` bytes of `word`, the least significant first. Bytes beyond the eighth are 0.
#[must_use]
#[inline]
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

/// The first 8 bytes of `data` as a word, the least significant first. Missing bytes are 0.
#[must_use]
#[inline]
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

/// The low `bits` bits of `raw` as a number in two's complement. 0 where `bits` is 0, all of `raw` from 64 on.
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
