//! Emergency messages of CANopen and CANopen over EtherCAT.

use crate::codes::CodeTable;

/// An emergency message, in which a device reports that an error has occurred or has been cleared (CiA 301 7.2.7).
///
/// ```
/// use lexibus::Emergency;
/// use lexibus_drives::demo_drive::codes::DriveErrors;
///
/// let emergency = Emergency::from_bytes(&[0x11, 0x86, 0x21, 0, 0, 0, 0, 0]).expect("eight bytes");
/// assert_eq!(emergency.alarm::<DriveErrors>(), DriveErrors::FollowingError);
/// assert!(!emergency.is_reset());
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Emergency {
    /// Error code.
    pub code: u16,
    /// Error register (object 0x1001).
    pub register: u8,
    /// Vendor-specific data.
    pub vendor: [u8; 5],
}

impl Emergency {
    /// Decodes an emergency message, or returns `None` if `data` isn't eight bytes long.
    #[must_use]
    pub const fn from_bytes(data: &[u8]) -> Option<Self> {
        match *data {
            [low, high, register, a, b, c, d, e] => {
                Some(Self { code: u16::from_le_bytes([low, high]), register, vendor: [a, b, c, d, e] })
            }
            _ => None,
        }
    }

    /// Returns the eight bytes of the message.
    #[must_use]
    pub const fn to_bytes(&self) -> [u8; 8] {
        let ([low, high], [a, b, c, d, e]) = (self.code.to_le_bytes(), self.vendor);
        [low, high, self.register, a, b, c, d, e]
    }

    /// Returns whether the device reports that an error or all errors have been cleared (codes 0x0000 to 0x00FF, CiA
    /// 301 7.2.7.1).
    #[must_use]
    pub const fn is_reset(&self) -> bool {
        self.code <= 0xFF
    }

    /// Returns the code as a variant of the code table `T`, a generated type such as `codes::Emergency`.
    #[must_use]
    pub fn alarm<T: CodeTable>(&self) -> T
    where
        T::Raw: From<u16>,
    {
        T::from_raw(self.code.into())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bytes() {
        let emergency = Emergency { code: 0x8130, register: 0x11, vendor: [1, 2, 3, 4, 5] };
        assert_eq!(emergency.to_bytes(), [0x30, 0x81, 0x11, 1, 2, 3, 4, 5]);
        assert_eq!(Emergency::from_bytes(&emergency.to_bytes()), Some(emergency));
        assert_eq!(Emergency::from_bytes(&[0; 7]), None);
        assert!(Emergency { code: 0, ..emergency }.is_reset());
    }
}
