//! Abort codes of SDO transfers.

use core::error;
use core::fmt;

/// Abort code of an SDO transfer: the reason why the client or the server aborted the transfer (CiA 301 7.2.4.3.17).
/// Any code is allowed; [`text`](Self::text) describes the codes of the standard.
///
/// ```
/// use lexibus::AbortCode;
///
/// assert_eq!(AbortCode::READ_ONLY.to_string(), "0x06010002: attempt to write a read-only object");
/// assert_eq!(AbortCode(0x1234).to_string(), "0x00001234: unknown abort code");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct AbortCode(pub u32);

macro_rules! codes {
    ($($(#[$attribute:meta])* $name:ident = $code:literal, $text:literal;)*) => {
        impl AbortCode {
            $(
                #[doc = concat!("Abort code ", stringify!($code), ": ", $text, ".")]
                pub const $name: Self = Self($code);
            )*

            /// Returns a description of the code, or `None` if the standard doesn't define the code.
            #[must_use]
            pub const fn text(self) -> Option<&'static str> {
                match self.0 {
                    $($code => Some($text),)*
                    _ => None,
                }
            }
        }
    };
}

codes! {
    TOGGLE_BIT = 0x0503_0000, "toggle bit not alternated";
    TIMEOUT = 0x0504_0000, "the transfer timed out";
    COMMAND = 0x0504_0001, "unknown command specifier";
    BLOCK_SIZE = 0x0504_0002, "invalid block size";
    SEQUENCE_NUMBER = 0x0504_0003, "invalid sequence number";
    CRC = 0x0504_0004, "CRC error";
    OUT_OF_MEMORY = 0x0504_0005, "out of memory";
    UNSUPPORTED_ACCESS = 0x0601_0000, "unsupported access to an object";
    WRITE_ONLY = 0x0601_0001, "attempt to read a write-only object";
    READ_ONLY = 0x0601_0002, "attempt to write a read-only object";
    NO_OBJECT = 0x0602_0000, "the object doesn't exist in the dictionary";
    NOT_MAPPABLE = 0x0604_0041, "the object cannot be mapped into the PDO";
    PDO_LENGTH = 0x0604_0042, "the mapped objects are longer than a PDO";
    PARAMETER_INCOMPATIBLE = 0x0604_0043, "incompatible parameters";
    INTERNAL_INCOMPATIBLE = 0x0604_0047, "internal incompatibility of the device";
    HARDWARE = 0x0606_0000, "access failed because of a hardware error";
    LENGTH = 0x0607_0010, "the length of the value doesn't match";
    TOO_LONG = 0x0607_0012, "the value is too long";
    TOO_SHORT = 0x0607_0013, "the value is too short";
    NO_SUB_INDEX = 0x0609_0011, "the sub-index doesn't exist";
    INVALID_VALUE = 0x0609_0030, "invalid value";
    TOO_HIGH = 0x0609_0031, "the value is too high";
    TOO_LOW = 0x0609_0032, "the value is too low";
    MAXIMUM_BELOW_MINIMUM = 0x0609_0036, "the maximum is less than the minimum";
    NO_RESOURCE = 0x060A_0023, "a resource isn't available";
    GENERAL = 0x0800_0000, "general error";
    CANNOT_STORE = 0x0800_0020, "the data cannot be transferred or stored";
    LOCAL_CONTROL = 0x0800_0021, "the data cannot be transferred or stored because of local control";
    DEVICE_STATE = 0x0800_0022, "the data cannot be transferred or stored in the present state of the device";
    NO_DICTIONARY = 0x0800_0023, "no object dictionary is present";
    NO_DATA = 0x0800_0024, "no data available";
}

impl fmt::Display for AbortCode {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:#010X}: {}", self.0, self.text().unwrap_or("unknown abort code"))
    }
}

impl error::Error for AbortCode {}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn codes_have_texts() {
        assert_eq!(AbortCode(0x0609_0030).text(), Some("invalid value"));
        assert_eq!(AbortCode(0).text(), None);
        assert_eq!(AbortCode::TOO_HIGH, AbortCode(0x0609_0031));
    }
}
