//! Options that supply facts for an SII image.

use crate::options::{options, OptionValue};

options! {
    /// Facts that override the facts of the source or supply missing ones.
    pub struct Options, TrackedOptions {
        /// Vendor ID assigned by the EtherCAT Technology Group.
        vendor_id: u32 = "vendor-id",
        /// Product code, as in object 0x1018.
        product_code: u32 = "product-code",
        /// Revision number, as in object 0x1018.
        revision: u32 = "revision",
        /// Serial number of one device.
        serial_number: u32 = "serial-number",
        /// Station alias of one device.
        station_alias: u16 = "station-alias",
        /// First bytes of the EEPROM, which configure the slave controller, such as 050603446400.
        config_data: Octets = "config-data",
        /// Size of the EEPROM in bytes, a multiple of 128.
        eeprom_size: EepromSize = "eeprom-size",
    }
}

/// The first bytes of the configuration area, up to 14.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Octets(pub Vec<u8>);

impl OptionValue for Octets {
    const WHAT: &'static str = "up to 14 bytes as pairs of hexadecimal digits";

    fn parse(text: &str) -> Option<Self> {
        let digits: Option<Vec<u8>> = text.trim().chars().map(|digit| Some(digit.to_digit(16)? as u8)).collect();
        let octets: Vec<u8> =
            digits?.chunks(2).map(|pair| pair.iter().fold(0, |byte, digit| byte << 4 | digit)).collect();
        let is_whole = text.trim().len() == 2 * octets.len();
        (is_whole && (1..=14).contains(&octets.len())).then_some(Octets(octets))
    }
}

/// Size of an EEPROM in bytes: a multiple of 128 bytes (1 Kibit), up to 4 Mibit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct EepromSize(u32);

impl EepromSize {
    /// Unit of the size word (word address 0x3E), in bytes.
    pub(super) const STEP: u32 = 128;

    /// Creates a size from a number of bytes. Returns `None` if the number is 0, above 524288 (4 Mibit) or not a multiple
    /// of 128.
    pub fn new(bytes: u32) -> Option<Self> {
        ((1..=0x8_0000).contains(&bytes) && bytes.is_multiple_of(Self::STEP)).then_some(EepromSize(bytes))
    }

    /// Returns the size in bytes.
    pub fn bytes(self) -> usize {
        self.0 as usize
    }

    /// Returns the value of the size word: the size in Kibit minus 1.
    pub(super) fn word(self) -> u16 {
        (self.0 / Self::STEP - 1) as u16
    }
}

impl OptionValue for EepromSize {
    const WHAT: &'static str = "a multiple of 128 up to 524288";

    fn parse(text: &str) -> Option<Self> {
        <u32 as OptionValue>::parse(text).and_then(EepromSize::new)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values() {
        let octets = |text| Octets::parse(text).map(|octets| octets.0);
        assert_eq!(octets("0506 "), Some(vec![5, 6]));
        assert_eq!([octets(""), octets("050"), octets("0x05"), octets(&"00".repeat(15))], [None, None, None, None]);
        let size = |text| EepromSize::parse(text).map(|size| (size.bytes(), size.word()));
        assert_eq!(size("2048"), Some((2048, 15)));
        assert_eq!([size("0"), size("100"), size("0x80080")], [None, None, None]);
    }
}
