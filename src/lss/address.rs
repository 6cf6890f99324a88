//! The address of a device in LSS.

use core::fmt;

/// Address of a device in LSS (CiA 305): the four numbers of the identity object 0x1018. The combination of the numbers
/// is unique worldwide.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Default)]
pub struct LssAddress {
    /// Vendor-ID (0x1018:01).
    pub vendor_id: u32,
    /// Product code (0x1018:02).
    pub product_code: u32,
    /// Revision number (0x1018:03).
    pub revision_number: u32,
    /// Serial number (0x1018:04).
    pub serial_number: u32,
}

impl LssAddress {
    /// Creates an address from its four numbers, in the order of object 0x1018.
    #[must_use]
    pub const fn from_array(parts: [u32; 4]) -> Self {
        let [vendor_id, product_code, revision_number, serial_number] = parts;
        Self { vendor_id, product_code, revision_number, serial_number }
    }

    /// Returns the four numbers, in the order of object 0x1018.
    #[must_use]
    pub const fn to_array(self) -> [u32; 4] {
        [self.vendor_id, self.product_code, self.revision_number, self.serial_number]
    }

    /// Returns the number at a position of the address, or `None` if the position exceeds 3.
    pub(super) fn at(self, position: u8) -> Option<u32> {
        self.to_array().get(usize::from(position)).copied()
    }

    /// Returns one of the four numbers.
    #[must_use]
    pub const fn part(self, part: IdentityPart) -> u32 {
        match part {
            IdentityPart::VendorId => self.vendor_id,
            IdentityPart::ProductCode => self.product_code,
            IdentityPart::RevisionNumber => self.revision_number,
            IdentityPart::SerialNumber => self.serial_number,
        }
    }
}

impl fmt::Display for LssAddress {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [vendor, product, revision, serial] = self.to_array();
        write!(f, "vendor 0x{vendor:08X}, product 0x{product:08X}, revision 0x{revision:08X}, serial number {serial}")
    }
}

/// One of the four numbers of an [`LssAddress`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum IdentityPart {
    /// Vendor-ID (0x1018:01).
    VendorId,
    /// Product code (0x1018:02).
    ProductCode,
    /// Revision number (0x1018:03).
    RevisionNumber,
    /// Serial number (0x1018:04).
    SerialNumber,
}

impl IdentityPart {
    /// All four numbers, in the order of object 0x1018.
    pub const ALL: [Self; 4] = [Self::VendorId, Self::ProductCode, Self::RevisionNumber, Self::SerialNumber];

    /// Returns the position of this number in the address, 0 to 3.
    pub(super) const fn position(self) -> u8 {
        self as u8
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::string::ToString;

    #[test]
    fn parts() {
        let address = LssAddress::from_array([1, 2, 3, 4]);
        assert_eq!(IdentityPart::ALL.map(|part| address.part(part)), address.to_array());
        assert_eq!(IdentityPart::ALL.map(IdentityPart::position), [0, 1, 2, 3]);
        let text = "vendor 0x00000001, product 0x00000002, revision 0x00000003, serial number 4";
        assert_eq!(address.to_string(), text);
    }
}
