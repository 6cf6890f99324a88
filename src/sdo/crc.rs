//! Checksum of block transfers.

/// Returns the CRC of a block transfer (CiA 301 7.2.4.3.16): polynomial x^16 + x^12 + x^5 + 1, initial value 0.
pub(super) fn crc(data: &[u8]) -> u16 {
    data.iter().fold(0, |crc, byte| {
        (0..8).fold(crc ^ u16::from(*byte) << 8, |crc, _| if crc >> 15 == 1 { crc << 1 ^ 0x1021 } else { crc << 1 })
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn value_of_the_standard() {
        assert_eq!(crc(b"123456789"), 0x31C3);
        assert_eq!(crc(&[]), 0);
    }
}
