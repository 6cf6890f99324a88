//! Errors of parameter access.

use core::error;
use core::fmt;

use super::format::Format;
use crate::value_error::LengthError;

/// Reasons why a parameter access failed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum ParameterError {
    /// The drive refused to read or change a parameter.
    Refused(Refusal),
    /// The number of parameters isn't in the range 1 to [`MAX_PARAMETERS`](super::MAX_PARAMETERS).
    Count(usize),
    /// The data of a change don't consist of 1 to 255 values of this format.
    Values(Format),
    /// The request has the reference 0, or it has fewer than four bytes.
    NoRequest,
    /// The response belongs to another request.
    OtherReference {
        /// Reference of the request.
        expected: u8,
        /// Reference of the response.
        actual: u8,
    },
    /// The response ID doesn't match the request ID. The response to a read request has the ID 0x01 or 0x81. The
    /// response to a change request has the ID 0x02 or 0x82.
    ResponseId(u8),
    /// The response is for another axis.
    OtherAxis {
        /// Axis of the request.
        expected: u8,
        /// Axis of the response.
        actual: u8,
    },
    /// The response has more parameters than the request, or it has fewer parameters and contains no refusal.
    ParameterCount {
        /// Number of parameters in the request.
        expected: u8,
        /// Number of parameters in the response.
        actual: u8,
    },
    /// A value has a format that the requested type cannot read, or a format of unknown length.
    Format(Format),
    /// The response doesn't contain the requested value, or the refusal that it reports.
    NoValue,
    /// The buffer for a request is too short, or the response is incomplete.
    Length(LengthError),
}

/// The drive's reason for the refusal of a parameter.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Refusal {
    /// Position of the parameter in the request, starting at 0.
    pub parameter: u8,
    /// Error number.
    pub number: ErrorNumber,
    /// Second error value, if the drive sends one. For many error numbers, the second error value is the first affected
    /// subindex.
    pub information: Option<u16>,
}

impl fmt::Display for ParameterError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Refused(refusal) => refusal.fmt(f),
            Self::Count(count) => write!(f, "a request has 1 to {} parameters, not {count}", super::MAX_PARAMETERS),
            Self::Values(format) => write!(f, "the bytes are not 1 to 255 values of {format}"),
            Self::NoRequest => f.write_str("the request is shorter than four bytes, or its reference is 0"),
            Self::OtherReference { expected, actual } => {
                write!(f, "the response has reference {actual}, expected {expected}")
            }
            Self::ResponseId(id) => write!(f, "the response ID {id:#04X} doesn't match the request"),
            Self::OtherAxis { expected, actual } => {
                write!(f, "the response is for axis {actual}, expected {expected}")
            }
            Self::ParameterCount { expected, actual } => {
                write!(f, "the response has {actual} parameters, expected {expected}")
            }
            Self::Format(format) => write!(f, "unexpected format of a value: {format}"),
            Self::NoValue => f.write_str("the response doesn't contain the value"),
            Self::Length(error) => error.fmt(f),
        }
    }
}

impl fmt::Display for Refusal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        // Most requests have only one parameter, so its position isn't printed.
        match self.parameter {
            0 => f.write_str("the drive refused: ")?,
            place => write!(f, "the drive refused the parameter at position {place} of the request: ")?,
        }
        self.number.fmt(f)?;
        match self.information {
            Some(information) => write!(f, " ({information})"),
            None => Ok(()),
        }
    }
}

impl error::Error for ParameterError {}
impl error::Error for Refusal {}

impl From<LengthError> for ParameterError {
    fn from(error: LengthError) -> Self {
        Self::Length(error)
    }
}

/// The error number of a refusal. PROFIdrive defines the numbers up to 0x64. Vendors define higher numbers.
///
/// ```
/// use lexibus::profinet::parameter_access::ErrorNumber;
///
/// assert_eq!(ErrorNumber::LIMITS.to_string(), "0x0002: the value is outside its limits");
/// assert_eq!(ErrorNumber(0x65).to_string(), "0x0065: vendor-specific reason");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct ErrorNumber(pub u16);

macro_rules! numbers {
    ($($name:ident = $number:literal, $text:literal;)*) => {
        impl ErrorNumber {
            $(
                #[doc = concat!("The number ", stringify!($number), ": ", $text, ".")]
                pub const $name: Self = Self($number);
            )*

            /// Returns the meaning of the error number. Returns `None` if this type has no constant for the number.
            #[must_use]
            pub const fn text(self) -> Option<&'static str> {
                match self.0 {
                    $($number => Some($text),)*
                    _ => None,
                }
            }
        }
    };
}

numbers! {
    NO_PARAMETER = 0x00, "there is no such parameter";
    NOT_CHANGEABLE = 0x01, "the value cannot be changed";
    LIMITS = 0x02, "the value is outside its limits";
    NO_SUBINDEX = 0x03, "there is no such subindex";
    NO_ARRAY = 0x04, "the parameter isn't an array";
    DATA_TYPE = 0x05, "wrong data type";
    RESET_ONLY = 0x06, "the value can only be reset to 0";
    DESCRIPTION_NOT_CHANGEABLE = 0x07, "the element of the description cannot be changed";
    NO_DESCRIPTION = 0x09, "there is no description";
    NO_RIGHT = 0x0B, "no right to change parameters";
    NO_TEXT = 0x0F, "there is no text";
    OPERATING_STATE = 0x11, "not possible in this operating state";
    VALUE = 0x14, "the value isn't allowed";
    TOO_LONG = 0x15, "the response is too long";
    ADDRESS = 0x16, "attribute, number of elements, parameter number or subindex isn't allowed";
    FORMAT = 0x17, "the format isn't allowed";
    VALUE_COUNT = 0x18, "the number of values differs from the number of elements";
    NO_AXIS = 0x19, "there is no such axis";
    TEXT_NOT_CHANGEABLE = 0x20, "the text cannot be changed";
}

impl fmt::Display for ErrorNumber {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let other = if self.0 > 0x64 { "vendor-specific reason" } else { "unknown error number" };
        write!(f, "{:#06X}: {}", self.0, self.text().unwrap_or(other))
    }
}
