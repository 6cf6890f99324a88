//! Errors of an access to a device.

use core::error;
use core::fmt;

use crate::abort::AbortCode;
use crate::bus::Object;
use crate::from::from;
use crate::profinet::parameter_access::ParameterError;
use crate::profinet::{NotAllowed, RecordError};
use crate::value_error::{LengthError, OutOfRange, TextError};

/// Reason why an access failed. `E` is the error type of the client.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Error<E> {
    /// The client returned an error, for example because the bus failed.
    Client(E),
    /// The device refused the access, with an SDO abort code (CiA 301 7.2.4.3.17) or an equivalent error of another
    /// bus.
    Abort(AbortCode),
    /// The mailbox of an EtherCAT device rejected the request, with an error code (ETG.1000.4 5.6): 1 syntax, 2
    /// unsupported protocol, 3 invalid channel, 4 unsupported service, 5 invalid header, 6 too short, 7 no memory, 8
    /// invalid length.
    Mailbox(u16),
    /// The device refused the access without a reason, or with a reason that this type cannot represent.
    Refused,
    /// The reply of the device doesn't match the request.
    UnexpectedReply,
    /// The parameter doesn't exist, or the protocol has no message for this access to the parameter. Nothing was sent.
    NoMessage,
    /// The device didn't reply in time, or the bus was busy.
    Timeout,
    /// The access needs a clock or a pause, but the client has no clock or cannot wait
    /// ([`Client::wait`](crate::Client::wait)). For example, the device needs time before it has the value. Use
    /// [`Timed`](crate::Timed) to add a clock to the client.
    NoClock,
    /// The device marks its cyclic data as invalid (PROFINET provider status "bad").
    InvalidData,
    /// The device doesn't have the axis, or the axis doesn't have the object. Nothing was sent.
    NoSuchAxis {
        /// Axis number, from 1.
        axis: u8,
        /// Object, with the index that it has on the first axis.
        object: Object,
    },
    /// In a write, the value is outside the item's declared range, or doesn't fit the item's type or its length on this
    /// bus. Nothing was sent. In a read, the bus transfers more bits than the item's type has, and the value doesn't
    /// fit the type.
    OutOfRange(OutOfRange),
    /// The device sent, or the caller passed, the wrong number of bytes.
    Length(LengthError),
    /// The text isn't valid for the item's type.
    Text(TextError),
    /// A field of a PROFINET record has an invalid value. Nothing was sent.
    NotAllowed(NotAllowed),
    /// An access to a parameter of a PROFIdrive drive was refused or failed.
    ParameterAccess(ParameterError),
}

impl<E: fmt::Display> fmt::Display for Error<E> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Client(error) => error.fmt(f),
            Self::Abort(code) => write!(f, "the device refused: {code}"),
            Self::Mailbox(code) => write!(f, "the mailbox of the device rejected the request: error 0x{code:04X}"),
            Self::Refused => f.write_str("the device refused"),
            Self::UnexpectedReply => f.write_str("unexpected reply"),
            Self::NoMessage => f.write_str("the protocol has no message for this access"),
            Self::Timeout => f.write_str("timeout: no reply from the device, or the bus is busy"),
            Self::NoClock => f.write_str("the device needs time, but the client has no clock"),
            Self::InvalidData => f.write_str("the device marks its cyclic data as invalid"),
            Self::NoSuchAxis { axis, object } => write!(f, "axis {axis} doesn't exist or has no object {object}"),
            Self::OutOfRange(error) => error.fmt(f),
            Self::Length(error) => error.fmt(f),
            Self::Text(error) => error.fmt(f),
            Self::NotAllowed(error) => error.fmt(f),
            Self::ParameterAccess(error) => error.fmt(f),
        }
    }
}

impl<E: error::Error> error::Error for Error<E> {
    fn source(&self) -> Option<&(dyn error::Error + 'static)> {
        match self {
            Self::Client(error) => error.source(),
            _ => None,
        }
    }
}

from! {
    AbortCode => Error::Abort<E>;
    OutOfRange => Error::OutOfRange<E>;
    LengthError => Error::Length<E>;
    TextError => Error::Text<E>;
    NotAllowed => Error::NotAllowed<E>;
}

impl<E> From<RecordError> for Error<E> {
    fn from(error: RecordError) -> Self {
        match error {
            RecordError::NotAllowed(error) => Self::NotAllowed(error),
            RecordError::Length(error) => Self::Length(error),
        }
    }
}

impl<E> From<ParameterError> for Error<E> {
    fn from(error: ParameterError) -> Self {
        match error {
            ParameterError::Length(error) => Self::Length(error),
            error => Self::ParameterAccess(error),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::string::ToString;

    #[test]
    fn messages() {
        let length = Error::<OutOfRange>::from(LengthError { expected: 4, actual: 2 });
        assert_eq!(length.to_string(), "expected 4 bytes, got 2");
        assert_eq!(Error::Client(TextError).to_string(), "invalid text");
        let missing = Error::<TextError>::NoSuchAxis { axis: 4, object: Object::new(0x6040, 0) };
        assert_eq!(missing.to_string(), "axis 4 doesn't exist or has no object 0x6040:00");
        let refused = Error::<TextError>::from(AbortCode::READ_ONLY);
        assert_eq!(refused.to_string(), "the device refused: 0x06010002: attempt to write a read-only object");
        assert_eq!(Error::<TextError>::from(OutOfRange).to_string(), "value out of range");
    }
}
