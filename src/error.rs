//! What can go wrong between an accessor and a device.

use core::error;
use core::fmt;

use crate::abort::AbortCode;
use crate::bus::Object;
use crate::profinet::parameter_access::ParameterError;
use crate::profinet::NotAllowed;

/// Why an access failed. `E` is the client's own error.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Error<E> {
    /// The bus failed.
    Client(E),
    /// The device refused: an abort of an SDO transfer (CiA 301 7.2.4.3.17), or what a bus has instead.
    Abort(AbortCode),
    /// The device answered something that is no answer to what it was asked.
    UnexpectedReply,
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

/// A number of bytes other than the expected one.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct LengthError {
    /// How many bytes the value takes, or how many the buffer holds at most.
    pub expected: usize,
    /// How many bytes there are.
    pub actual: usize,
}

impl LengthError {
    /// `actual` bytes where there should be `expected`.
    #[must_use]
    pub const fn new(expected: usize, actual: usize) -> Self {
        Self { expected, actual }
    }
}

/// A value outside the declared range of its item, or outside what its type can hold.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct OutOfRange;

/// Text with characters that its type doesn't allow, or bytes that aren't text.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct TextError;

impl<E: fmt::Display> fmt::Display for Error<E> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Client(error) => error.fmt(f),
            Self::Abort(code) => write!(f, "the device refused: {code}"),
            Self::UnexpectedReply => f.write_str("unexpected reply"),
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

impl fmt::Display for LengthError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "expected {} bytes, got {}", self.expected, self.actual)
    }
}

impl fmt::Display for OutOfRange {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("value out of range")
    }
}

impl fmt::Display for TextError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("invalid text")
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

impl error::Error for LengthError {}
impl error::Error for OutOfRange {}
impl error::Error for TextError {}

impl<E> From<AbortCode> for Error<E> {
    fn from(code: AbortCode) -> Self {
        Self::Abort(code)
    }
}

impl<E> From<OutOfRange> for Error<E> {
    fn from(error: OutOfRange) -> Self {
        Self::OutOfRange(error)
    }
}

impl<E> From<LengthError> for Error<E> {
    fn from(error: LengthError) -> Self {
        Self::Length(error)
    }
}

impl<E> From<TextError> for Error<E> {
    fn from(error: TextError) -> Self {
        Self::Text(error)
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
