//! Parameter records.

use core::error;
use core::fmt;

use crate::from::from;
use crate::value_error::LengthError;

/// A parameter record as a struct of its fields. Implemented by generated code.
pub trait RecordData: Sized {
    /// The record's index.
    const INDEX: u16;

    /// Its length in bytes.
    const LEN: usize;

    /// Its place among the records of its submodule at start-up; 0 = any.
    const TRANSFER_SEQUENCE: u16;

    /// The fields of a record that was read from the device.
    ///
    /// # Errors
    ///
    /// When `data` has fewer than [`RecordData::LEN`] bytes.
    fn decode(data: &[u8]) -> Result<Self, LengthError>;

    /// Writes the record to the first [`RecordData::LEN`] bytes of `data` and returns these.
    ///
    /// # Errors
    ///
    /// When a field has a value that isn't allowed, or `data` has fewer bytes. It is then left as it was.
    fn encode_into<'b>(&self, data: &'b mut [u8]) -> Result<&'b [u8], RecordError>;
}

/// Why a record isn't written.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum RecordError {
    /// A field has a value that isn't allowed.
    NotAllowed(NotAllowed),
    /// There are too few bytes for the record.
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

/// A field of a record has a value that the description of the device doesn't allow.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct NotAllowed {
    /// What the description calls the field.
    pub field: &'static str,
}

impl fmt::Display for NotAllowed {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "the value of `{}` isn't allowed", self.field)
    }
}

impl error::Error for NotAllowed {}

/// Checks that `value` lies in one of the `allowed` ranges, whose limits belong to them.
///
/// # Errors
///
/// When it doesn't.
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
