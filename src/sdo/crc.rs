//! Checksum of block transfers.

use crate::crc::crc16;

/// Returns the CRC of a block transfer (CiA 301 7.2.4.3.16): polynomial x^16 + x^12 + x^5 + 1, initial value 0.
pub(super) fn crc(data: &[u8]) -> u16 {
    crc16(0x1021, 0, data)
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
