//! Errors of values and their encodings.

use core::error;
use core::fmt;

/// The number of bytes differs from the expected number.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct LengthError {
    /// Expected length in bytes, or the minimum or maximum length.
    pub expected: usize,
    /// Actual length in bytes.
    pub actual: usize,
}

impl LengthError {
    /// Creates the error for a length of `actual` bytes instead of `expected` bytes.
    #[must_use]
    pub const fn new(expected: usize, actual: usize) -> Self {
        Self { expected, actual }
    }
}

/// A value is outside the declared range of its item, or outside the range of its type.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct OutOfRange;

/// A text contains characters that its type doesn't allow, or the bytes are not a valid text.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct TextError;

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

impl error::Error for LengthError {}
impl error::Error for OutOfRange {}
impl error::Error for TextError {}
