//! What can go wrong between an accessor and a device.

use core::error;
use core::fmt;

/// Why an access failed. `E` is the client's own error.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Error<E> {
    /// The client failed: the bus, or an abort by the device.
    Client(E),
    /// The value is outside the item's declared range, or doesn't fit its type. Nothing was sent.
    OutOfRange(OutOfRange),
    /// The device sent, or the caller gave, a number of bytes that doesn't fit.
    Length(LengthError),
    /// The text isn't valid for the item's type.
    Text(TextError),
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
            Self::OutOfRange(error) => error.fmt(f),
            Self::Length(error) => error.fmt(f),
            Self::Text(error) => error.fmt(f),
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
        assert_eq!(Error::<TextError>::from(OutOfRange).to_string(), "value out of range");
    }
}
