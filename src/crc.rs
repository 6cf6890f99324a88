//! 16-bit CRC that processes the most significant bit first.

/// Updates a CRC with `data`. `polynomial` omits the term x^16, and the result is not inverted.
#[expect(clippy::indexing_slicing, reason = "`at` is below the length")]
pub(crate) const fn crc16(polynomial: u16, crc: u16, data: &[u8]) -> u16 {
    let (mut crc, mut at) = (crc, 0);
    while at < data.len() {
        crc ^= (data[at] as u16) << 8;
        let mut bit = 0;
        while bit < 8 {
            crc = if crc & 0x8000 != 0 { crc << 1 ^ polynomial } else { crc << 1 };
            bit += 1;
        }
        at += 1;
    }
    crc
}
