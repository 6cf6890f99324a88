//! What goes wrong with a simulated device.

use core::error;
use core::fmt;

use crate::abort::AbortCode;
use crate::from::from;

/// What an access to a simulated device ends in, other than in a value.
///
/// It is the error of its clients: [`Bus`](Fault::Bus) and [`Exception`](Fault::Exception) arrive as
/// [`Error::Client`](crate::Error::Client), [`Abort`](Fault::Abort) as [`Error::Abort`](crate::Error::Abort).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Fault {
    /// The bus fails: the request doesn't arrive, or the answer doesn't.
    Bus,
    /// The device refuses an SDO transfer.
    Abort(AbortCode),
    /// The device refuses a request of Modbus.
    Exception(Exception),
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Bus => f.write_str("the simulated bus failed"),
            Self::Abort(code) => write!(f, "the device refused: {code}"),
            Self::Exception(exception) => write!(f, "the device refused: {exception}"),
        }
    }
}

impl error::Error for Fault {}

from! {
    AbortCode => Fault::Abort;
    Exception => Fault::Exception;
}

/// Why a device refuses a request of Modbus (MODBUS Application Protocol 7, exception codes).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Exception {
    /// The table takes no such function: inputs can't be written.
    IllegalFunction,
    /// One of the registers doesn't exist, or can't be read or written.
    IllegalDataAddress,
    /// The number of registers is 0 or too great, or a value is outside its range.
    IllegalDataValue,
    /// The device can't do it now.
    ServerDeviceFailure,
}

impl Exception {
    /// The exception code.
    #[must_use]
    pub const fn code(self) -> u8 {
        match self {
            Self::IllegalFunction => 1,
            Self::IllegalDataAddress => 2,
            Self::IllegalDataValue => 3,
            Self::ServerDeviceFailure => 4,
        }
    }

    /// What a device says on Modbus that would abort an SDO transfer with `code`.
    #[must_use]
    pub const fn of_abort(code: AbortCode) -> Self {
        match code {
            AbortCode::NO_OBJECT | AbortCode::NO_SUB_INDEX | AbortCode::READ_ONLY | AbortCode::WRITE_ONLY => {
                Self::IllegalDataAddress
            }
            AbortCode::INVALID_VALUE
            | AbortCode::TOO_HIGH
            | AbortCode::TOO_LOW
            | AbortCode::LENGTH
            | AbortCode::TOO_LONG
            | AbortCode::TOO_SHORT => Self::IllegalDataValue,
            _ => Self::ServerDeviceFailure,
        }
    }

    /// What a device says on Modbus of `fault`; [`ServerDeviceFailure`](Self::ServerDeviceFailure) of a bus that failed.
    #[must_use]
    pub const fn of_fault(fault: Fault) -> Self {
        match fault {
            Fault::Exception(exception) => exception,
            Fault::Abort(code) => Self::of_abort(code),
            Fault::Bus => Self::ServerDeviceFailure,
        }
    }
}

impl fmt::Display for Exception {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::IllegalFunction => "illegal function",
            Self::IllegalDataAddress => "illegal data address",
            Self::IllegalDataValue => "illegal data value",
            Self::ServerDeviceFailure => "server device failure",
        })
    }
}

impl error::Error for Exception {}

#[cfg(test)]
mod tests {
    use super::*;
    use std::string::ToString;

    #[test]
    fn messages_and_codes() {
        assert_eq!(Fault::from(Exception::IllegalDataAddress).to_string(), "the device refused: illegal data address");
        let refused = Fault::from(AbortCode::READ_ONLY);
        assert_eq!(refused.to_string(), "the device refused: 0x06010002: attempt to write a read-only object");
        assert_eq!(Exception::of_fault(refused).code(), 2);
        assert_eq!(Exception::of_fault(AbortCode::TOO_LOW.into()).code(), 3);
        assert_eq!(Exception::of_fault(Fault::Bus).code(), 4);
        assert_eq!(Exception::of_fault(Exception::IllegalFunction.into()).code(), 1);
    }
}
