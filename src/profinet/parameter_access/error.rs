//! What can go wrong with an access to parameters.

use core::error;
use core::fmt;

use super::format::Format;
use crate::value_error::LengthError;

/// Why an access to parameters failed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum ParameterError {
    /// The drive refused a parameter.
    Refused(Refusal),
    /// A request has 1 to [`MAX_PARAMETERS`](super::MAX_PARAMETERS) parameters, not so many.
    Count(usize),
    /// The values of a change aren't a whole number of values of their format, or more than 255.
    Values(Format),
    /// A request has a reference from 1 to 255, or it is too short to be one.
    NoRequest,
    /// The response is to another request.
    OtherReference {
        /// The reference of the request.
        expected: u8,
        /// The one of the response.
        actual: u8,
    },
    /// The response is of another kind than the request: 0x01 and 0x81 are those to a reading one, 0x02 and 0x82 those to a
    /// changing one.
    ResponseId(u8),
    /// The response is about another axis.
    OtherAxis {
        /// The axis of the request.
        expected: u8,
        /// The one of the response.
        actual: u8,
    },
    /// The response has more parameters than the request, or fewer although none is refused.
    ParameterCount {
        /// How many parameters the request has.
        expected: u8,
        /// How many the response has.
        actual: u8,
    },
    /// The drive sent a value in another format than it was asked for, or in one whose length isn't known.
    Format(Format),
    /// The response has no such value.
    NoValue,
    /// A request or a response has fewer bytes than it needs.
    Length(LengthError),
}

/// What a drive says of a parameter that it didn't read or change.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Refusal {
    /// The parameter's place in the request, from 0.
    pub parameter: u8,
    /// Why.
    pub number: ErrorNumber,
    /// The second error value, where the drive sends one: for many numbers the first subindex that is concerned.
    pub information: Option<u16>,
}

impl fmt::Display for ParameterError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Refused(refusal) => refusal.fmt(f),
            Self::Count(count) => write!(f, "a request has 1 to {} parameters, not {count}", super::MAX_PARAMETERS),
            Self::Values(format) => write!(f, "the bytes aren't 1 to 255 values of {format}"),
            Self::NoRequest => {
                f.write_str("a request begins with a reference from 1 to 255 and has four bytes at least")
            }
            Self::OtherReference { expected, actual } => {
                write!(f, "the response has reference {actual}, the request {expected}")
            }
            Self::ResponseId(id) => write!(f, "the response is of another kind than the request: {id:#04X}"),
            Self::OtherAxis { expected, actual } => {
                write!(f, "the response is about axis {actual}, the request about {expected}")
            }
            Self::ParameterCount { expected, actual } => {
                write!(f, "the response has {actual} parameters, the request {expected}")
            }
            Self::Format(format) => write!(f, "the drive sent a value of {format}"),
            Self::NoValue => f.write_str("the response has no such value"),
            Self::Length(error) => error.fmt(f),
        }
    }
}

impl fmt::Display for Refusal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        // The first is the only one, mostly.
        match self.parameter {
            0 => f.write_str("the drive refused: ")?,
            place => write!(f, "the drive refused the parameter at place {place} of the request: ")?,
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

/// Why a drive refuses to read or change a parameter. Numbers up to 0x64 are those of PROFIdrive, further ones the
/// vendor's.
///
/// ```
/// use lexibus::profinet::parameter_access::ErrorNumber;
///
/// assert_eq!(ErrorNumber::LIMITS.to_string(), "0x0002: the value is beyond a limit");
/// assert_eq!(ErrorNumber(0x65).to_string(), "0x0065: a vendor's own reason");
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

            /// What the number means; `None` where PROFIdrive gives it no meaning.
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
    NOT_CHANGEABLE = 0x01, "the value can't be changed";
    LIMITS = 0x02, "the value is beyond a limit";
    NO_SUBINDEX = 0x03, "there is no such subindex";
    NO_ARRAY = 0x04, "the parameter is no array";
    DATA_TYPE = 0x05, "wrong data type";
    RESET_ONLY = 0x06, "the value can only be reset to 0";
    DESCRIPTION_NOT_CHANGEABLE = 0x07, "the element of the description can't be changed";
    NO_DESCRIPTION = 0x09, "there is no description";
    NO_RIGHT = 0x0B, "no right to change parameters";
    NO_TEXT = 0x0F, "there is no text";
    OPERATING_STATE = 0x11, "not possible in this operating state";
    VALUE = 0x14, "the value isn't allowed";
    TOO_LONG = 0x15, "the response is too long";
    ADDRESS = 0x16, "attribute, number of elements, parameter number or subindex isn't allowed";
    FORMAT = 0x17, "the format isn't allowed";
    VALUE_COUNT = 0x18, "the number of values isn't the number of elements";
    NO_AXIS = 0x19, "there is no such axis";
    TEXT_NOT_CHANGEABLE = 0x20, "the text can't be changed";
}

impl fmt::Display for ErrorNumber {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let other = if self.0 > 0x64 { "a vendor's own reason" } else { "unknown error number" };
        write!(f, "{:#06X}: {}", self.0, self.text().unwrap_or(other))
    }
}
