//! What can go wrong between an accessor and a device.

use core::error;
use core::fmt;

use crate::abort::AbortCode;
use crate::bus::Object;
use crate::from::from;
use crate::profinet::parameter_access::ParameterError;
use crate::profinet::{NotAllowed, RecordError};
use crate::value_error::{LengthError, OutOfRange, TextError};

/// Why an access failed. `E` is the client's own error.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Error<E> {
    /// The bus failed.
    Client(E),
    /// The device refused: an abort of an SDO transfer (CiA 301 7.2.4.3.17), or what a bus has instead.
    Abort(AbortCode),
    /// The device refused with a message that says no more than that, or more than fits here.
    Refused,
    /// The device answered something that is no answer to what it was asked.
    UnexpectedReply,
    /// The protocol has no message that does this to the parameter. Nothing was sent.
    NoMessage,
    /// The device didn't answer in time, or the bus didn't become free.
    Timeout,
    /// The device needs time before it has the value, and the client can't wait ([`Client::wait`](crate::Client::wait)):
    /// [`Timed`](crate::Timed) gives it a clock.
    NoClock,
    /// The device says that its cyclic data aren't valid (the provider status of PROFINET).
    InvalidData,
    /// The device has no such axis, or that axis doesn't have the object. Nothing was sent.
    NoSuchAxis {
        /// The number of the axis, from 1.
        axis: u8,
        /// The object, as the first axis has it.
        object: Object,
    },
    /// The value is outside the item's declared range, or doesn't fit its type on this bus. Nothing was sent. Of a value that
    /// was read: it has more bits on this bus than the item's type, and doesn't fit that.
    OutOfRange(OutOfRange),
    /// The device sent, or the caller gave, a number of bytes that doesn't fit.
    Length(LengthError),
    /// The text isn't valid for the item's type.
    Text(TextError),
    /// A field of a PROFINET record has a value that isn't allowed. Nothing was sent.
    NotAllowed(NotAllowed),
    /// An access to a parameter of a PROFIdrive drive was refused, or went wrong.
    ParameterAccess(ParameterError),
}

impl<E: fmt::Display> fmt::Display for Error<E> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Client(error) => error.fmt(f),
            Self::Abort(code) => write!(f, "the device refused: {code}"),
            Self::Refused => f.write_str("the device refused"),
            Self::UnexpectedReply => f.write_str("unexpected reply"),
            Self::NoMessage => f.write_str("the protocol has no message for that"),
            Self::Timeout => f.write_str("no answer in time"),
            Self::NoClock => f.write_str("the device needs time, and the client can't wait"),
            Self::InvalidData => f.write_str("the device says that its cyclic data aren't valid"),
            Self::NoSuchAxis { axis, object } => write!(f, "there is no axis {axis} that has object {object}"),
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
        assert_eq!(missing.to_string(), "there is no axis 4 that has object 0x6040:00");
        let refused = Error::<TextError>::from(AbortCode::READ_ONLY);
        assert_eq!(refused.to_string(), "the device refused: 0x06010002: attempt to write a read-only object");
        assert_eq!(Error::<TextError>::from(OutOfRange).to_string(), "value out of range");
    }
}
