//! Parameter records.

use core::error;
use core::fmt;

use crate::from::from;
use crate::value_error::LengthError;

/// A parameter record as a struct. Generated code implements this trait.
pub trait RecordData: Sized {
    /// Index of the record.
    const INDEX: u16;

    /// Length in bytes.
    const LEN: usize;

    /// Position of the record among the start-up records of the submodule; 0 means any position.
    const TRANSFER_SEQUENCE: u16;

    /// Decodes a record.
    ///
    /// # Errors
    ///
    /// Returns [`LengthError`] if `data` has fewer than [`RecordData::LEN`] bytes.
    fn decode(data: &[u8]) -> Result<Self, LengthError>;

    /// Writes the record to the first [`RecordData::LEN`] bytes of `data` and returns these bytes.
    ///
    /// # Errors
    ///
    /// Returns [`RecordError::NotAllowed`] if a field has a value that isn't allowed, or [`RecordError::Length`] if
    /// `data` is too short. After an error, `data` is unchanged.
    fn encode_into<'b>(&self, data: &'b mut [u8]) -> Result<&'b [u8], RecordError>;
}

/// Reasons why a record cannot be encoded.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum RecordError {
    /// A field has a value that isn't allowed.
    NotAllowed(NotAllowed),
    /// The buffer is too short.
    Length(LengthError),
}

impl fmt::Display for RecordError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotAllowed(error) => error.fmt(f),
            Self::Length(error) => error.fmt(f),
        }
    }
}

impl error::Error for RecordError {}

from! {
    NotAllowed => RecordError::NotAllowed;
    LengthError => RecordError::Length;
}

/// A field of a record has a value that the device description doesn't allow.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct NotAllowed {
    /// Name of the field in the device description.
    pub field: &'static str,
}

impl fmt::Display for NotAllowed {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "the value of `{}` isn't allowed", self.field)
    }
}

impl error::Error for NotAllowed {}

/// Checks that `value` is in one of the `allowed` ranges. The ranges include their limits.
///
/// # Errors
///
/// Returns [`NotAllowed`] if `value` is in none of the ranges.
pub fn check<T: PartialOrd>(field: &'static str, value: T, allowed: &[(T, T)]) -> Result<(), NotAllowed> {
    if allowed.iter().any(|(first, last)| *first <= value && value <= *last) {
        Ok(())
    } else {
        Err(NotAllowed { field })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::string::ToString;

    #[test]
    fn limits_belong_to_the_range() {
        let allowed = [(0, 4), (7, 7)];
        for good in [0, 4, 7] {
            assert_eq!(check("Delay", good, &allowed), Ok(()));
        }
        for bad in [-1, 5, 8] {
            assert_eq!(check("Delay", bad, &allowed), Err(NotAllowed { field: "Delay" }));
        }
        assert!(check("Gain", f32::NAN, &[(0.0, 1.0)]).is_err());
        assert_eq!(NotAllowed { field: "Delay" }.to_string(), "the value of `Delay` isn't allowed");
    }
}
