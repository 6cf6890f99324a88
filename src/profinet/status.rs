//! Status of a refused record access.

use core::error;
use core::fmt;

/// The PNIO status of a failed record access (IEC 61158-6-10). From the most significant byte down, the status contains
/// error code, error decode, error code 1 and error code 2.
///
/// Controller libraries return the PNIO status as a 32-bit number or as four bytes. A
/// [`RecordClient`](super::RecordClient) can use this type as its error type, or as a part of its error type.
///
/// ```
/// use lexibus::profinet::PnioStatus;
///
/// let status = PnioStatus(0xDE80_B000);
/// assert_eq!(status.to_string(), "0xDE80B000: invalid index");
/// assert!(!status.is_busy() && PnioStatus(0xDE80_B500).is_busy());
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct PnioStatus(pub u32);

impl PnioStatus {
    /// Returns the error code, which identifies the service: 0xDE for a record read, 0xDF for a record write.
    #[must_use]
    pub const fn error_code(self) -> u8 {
        self.0.to_be_bytes()[0]
    }

    /// Returns the error decode, which determines the meaning of the error codes: 0x80 for record access, 0x81 for
    /// other services.
    #[must_use]
    pub const fn error_decode(self) -> u8 {
        self.0.to_be_bytes()[1]
    }

    /// Returns error code 1, which is the reason for the failure.
    #[must_use]
    pub const fn error_code_1(self) -> u8 {
        self.0.to_be_bytes()[2]
    }

    /// Returns error code 2, which is a detail of the reason.
    #[must_use]
    pub const fn error_code_2(self) -> u8 {
        self.0.to_be_bytes()[3]
    }

    /// Returns whether the device cannot reply yet because it is busy, a resource is busy, or there is a state
    /// conflict. Drives report a state conflict while the response to a parameter request isn't available.
    #[must_use]
    pub const fn is_busy(self) -> bool {
        self.error_decode() == 0x80 && matches!(self.error_code_1(), 0xA7 | 0xB5 | 0xC2)
    }

    /// Returns the meaning of error code 1. Returns `None` unless the meaning is the same for all devices.
    #[must_use]
    pub const fn text(self) -> Option<&'static str> {
        if self.error_decode() != 0x80 {
            return None;
        }
        Some(match self.error_code_1() {
            0xA0 => "read error",
            0xA1 => "write error",
            0xA2 => "module failure",
            0xA7 => "busy",
            0xA8 => "version conflict",
            0xA9 => "feature not supported",
            0xB0 => "invalid index",
            0xB1 => "wrong length of the record",
            0xB2 => "invalid slot or subslot",
            0xB3 => "type conflict",
            0xB4 => "invalid area or API",
            0xB5 => "state conflict",
            0xB6 => "access denied",
            0xB7 => "invalid range",
            0xB8 => "invalid parameter",
            0xB9 => "invalid type",
            0xBA => "backup",
            0xC0 => "read constrain conflict",
            0xC1 => "write constrain conflict",
            0xC2 => "resource busy",
            0xC3 => "resource unavailable",
            _ => return None,
        })
    }
}

impl fmt::Display for PnioStatus {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:#010X}: {}", self.0, self.text().unwrap_or("unknown PNIO status"))
    }
}

impl error::Error for PnioStatus {}

#[cfg(test)]
mod tests {
    use super::*;
    use std::string::ToString;

    #[test]
    fn four_bytes() {
        let status = PnioStatus(0xDF80_B102);
        assert_eq!((status.error_code(), status.error_decode()), (0xDF, 0x80));
        assert_eq!((status.error_code_1(), status.error_code_2()), (0xB1, 2));
        assert_eq!(status.to_string(), "0xDF80B102: wrong length of the record");
    }

    #[test]
    fn reasons_of_other_services_are_not_mistaken() {
        let status = PnioStatus(0xDB81_B500);
        assert!(!status.is_busy());
        assert_eq!(status.to_string(), "0xDB81B500: unknown PNIO status");
        assert_eq!(PnioStatus(0xDE80_BF00).text(), None);
    }
}
