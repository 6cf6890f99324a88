//! Faults of a simulated device.

use core::error;
use core::fmt;

use crate::abort::AbortCode;
use crate::from::from;

/// Reason why an access to a simulated device fails.
///
/// Simulated clients use this type as their error type. [`Bus`](Fault::Bus) and [`Exception`](Fault::Exception) become
/// [`Error::Client`](crate::Error::Client). [`Abort`](Fault::Abort) becomes [`Error::Abort`](crate::Error::Abort).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Fault {
    /// The bus loses the request or the reply.
    Bus,
    /// The device aborts an SDO transfer.
    Abort(AbortCode),
    /// The device refuses a Modbus request.
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

/// Modbus exception: the reason why a device refuses a request (MODBUS Application Protocol 7).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Exception {
    /// The function isn't allowed for the table. For example, discrete inputs cannot be written.
    IllegalFunction,
    /// A register doesn't exist, or cannot be read or written.
    IllegalDataAddress,
    /// The number of registers is 0 or too high, or a value is out of range or has the wrong length.
    IllegalDataValue,
    /// The device failed to execute the request.
    ServerDeviceFailure,
}

impl Exception {
    /// Returns the exception code.
    #[must_use]
    pub const fn code(self) -> u8 {
        match self {
            Self::IllegalFunction => 1,
            Self::IllegalDataAddress => 2,
            Self::IllegalDataValue => 3,
            Self::ServerDeviceFailure => 4,
        }
    }

    /// Returns the Modbus exception that corresponds to an SDO abort code.
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

    /// Returns the Modbus exception for `fault`. A bus fault becomes
    /// [`ServerDeviceFailure`](Self::ServerDeviceFailure).
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
