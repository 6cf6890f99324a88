//! Error detection codes at the end of a frame.

/// Error detection code after the data of a frame. The parameter of a variant is the initial value of the code.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Check {
    /// No error detection code.
    #[default]
    None,
    /// One byte: XOR of the data.
    Xor(u8),
    /// One byte: the low eight bits of the sum of the data.
    Sum(u8),
    /// One byte: the two's complement of the sum of the data (modulo 256). With the initial value 0, the data and the
    /// code add up to 0 (modulo 256).
    Lrc(u8),
    /// Two bytes, the low byte first: a reflected CRC with the polynomial 0x8005. Modbus RTU uses this CRC with the
    /// initial value 0xFFFF.
    Crc16(u16),
}

impl Check {
    /// Returns the length of the code in bytes.
    #[must_use]
    pub const fn len(self) -> usize {
        match self {
            Self::None => 0,
            Self::Xor(_) | Self::Sum(_) | Self::Lrc(_) => 1,
            Self::Crc16(_) => 2,
        }
    }

    /// Returns whether the frames have no error detection code.
    #[must_use]
    pub const fn is_empty(self) -> bool {
        self.len() == 0
    }

    /// Computes the error detection code of `data`. Only the first [`len`](Self::len) bytes of the result are used.
    #[must_use]
    pub fn of(self, data: &[u8]) -> [u8; 2] {
        let sum = |seed: u8| data.iter().fold(seed, |sum, byte| sum.wrapping_add(*byte));
        match self {
            Self::None => [0; 2],
            Self::Xor(seed) => [data.iter().fold(seed, |all, byte| all ^ byte), 0],
            Self::Sum(seed) => [sum(seed), 0],
            Self::Lrc(seed) => [sum(seed).wrapping_neg(), 0],
            Self::Crc16(seed) => data.iter().fold(seed, |crc, byte| crc16(crc, *byte)).to_le_bytes(),
        }
    }
}

/// Adds one byte to a reflected CRC with the polynomial 0x8005.
fn crc16(crc: u16, byte: u8) -> u16 {
    (0..8).fold(crc ^ u16::from(byte), |crc, _| if crc & 1 == 1 { crc >> 1 ^ 0xA001 } else { crc >> 1 })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn known_checks() {
        let digits = b"123456789";
        // These are the check values of the CRC catalog for MODBUS and ARC.
        assert_eq!(Check::Crc16(0xFFFF).of(digits), 0x4B37_u16.to_le_bytes());
        assert_eq!(Check::Crc16(0).of(digits), 0xBB3D_u16.to_le_bytes());
        // The sum of the digits is 477, which is 0x1DD.
        assert_eq!((Check::Sum(0).of(digits)[0], Check::Lrc(0).of(digits)[0]), (0xDD, 0x23));
        assert_eq!((Check::Xor(0).of(digits)[0], Check::Xor(0xFF).of(digits)[0]), (0x31, 0xCE));
        assert_eq!([Check::None, Check::Lrc(0), Check::Crc16(0)].map(Check::len), [0, 1, 2]);
        assert!(Check::None.is_empty() && !Check::Sum(0).is_empty());
    }
}
