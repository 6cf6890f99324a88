//! Bit rates of CAN.

use core::fmt;

/// Bit rate in table 0 of CiA 305.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum BitRate {
    /// 1 Mbit/s.
    Kbit1000,
    /// 800 kbit/s.
    Kbit800,
    /// 500 kbit/s.
    Kbit500,
    /// 250 kbit/s.
    Kbit250,
    /// 125 kbit/s.
    Kbit125,
    /// 50 kbit/s.
    Kbit50,
    /// 20 kbit/s.
    Kbit20,
    /// 10 kbit/s.
    Kbit10,
    /// The device detects the bit rate.
    Automatic,
}

impl BitRate {
    /// Bit rates, with their index in table 0 and their value in bit/s. Index 5 is reserved.
    const TABLE: [(Self, u8, u32); 9] = [
        (Self::Kbit1000, 0, 1_000_000),
        (Self::Kbit800, 1, 800_000),
        (Self::Kbit500, 2, 500_000),
        (Self::Kbit250, 3, 250_000),
        (Self::Kbit125, 4, 125_000),
        (Self::Kbit50, 6, 50_000),
        (Self::Kbit20, 7, 20_000),
        (Self::Kbit10, 8, 10_000),
        (Self::Automatic, 9, 0),
    ];

    fn row(self) -> (u8, u32) {
        let row = Self::TABLE.iter().find(|(rate, ..)| *rate == self);
        row.map_or((0, 0), |(_, index, bits)| (*index, *bits))
    }

    /// Returns the index in table 0 of CiA 305.
    #[must_use]
    pub fn index(self) -> u8 {
        self.row().0
    }

    /// Returns the bit rate with this index in table 0 of CiA 305. Returns `None` for reserved indices.
    #[must_use]
    pub fn from_index(index: u8) -> Option<Self> {
        Self::TABLE.iter().find(|(_, other, _)| *other == index).map(|(rate, ..)| *rate)
    }

    /// Returns the bit rate in bit/s, or `None` for [`Automatic`](Self::Automatic).
    #[must_use]
    pub fn bits_per_second(self) -> Option<u32> {
        Some(self.row().1).filter(|bits| *bits > 0)
    }
}

impl fmt::Display for BitRate {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.bits_per_second() {
            Some(bits) => write!(f, "{} kbit/s", bits / 1000),
            None => f.write_str("automatic bit rate"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn indices() {
        let valid: std::vec::Vec<_> = (0..=255).filter_map(BitRate::from_index).collect();
        assert_eq!(valid.len(), 9);
        assert!(valid.iter().all(|rate| BitRate::from_index(rate.index()) == Some(*rate)));
        assert_eq!((BitRate::from_index(5), BitRate::Kbit50.index()), (None, 6));
        assert_eq!(BitRate::Kbit125.bits_per_second(), Some(125_000));
        assert_eq!(BitRate::Automatic.bits_per_second(), None);
    }
}
