//! Formats of parameter values and the corresponding Rust types.

use core::fmt;

use crate::value_error::LengthError;

/// The format of a parameter value. A format is the number of a data type of IEC 61158 or PROFIdrive, or of a type that
/// only defines a length.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Format(pub u8);

macro_rules! formats {
    ($($name:ident = $number:literal, $text:literal, $size:expr;)*) => {
        impl Format {
            $(
                #[doc = concat!("The format ", stringify!($number), ": ", $text, ".")]
                pub const $name: Self = Self($number);
            )*

            /// Returns the name of the format. Returns `None` for an unknown format.
            #[must_use]
            pub const fn name(self) -> Option<&'static str> {
                match self.0 {
                    $($number => Some($text),)*
                    _ => None,
                }
            }

            /// Returns the length of a value in bytes. Returns `None` if the length is unknown. For strings, a value is
            /// one character.
            #[must_use]
            pub const fn size(self) -> Option<usize> {
                match self.0 {
                    $($number => $size,)*
                    _ => None,
                }
            }
        }
    };
}

formats! {
    BOOLEAN = 1, "Boolean", Some(1);
    INTEGER8 = 2, "Integer8", Some(1);
    INTEGER16 = 3, "Integer16", Some(2);
    INTEGER32 = 4, "Integer32", Some(4);
    UNSIGNED8 = 5, "Unsigned8", Some(1);
    UNSIGNED16 = 6, "Unsigned16", Some(2);
    UNSIGNED32 = 7, "Unsigned32", Some(4);
    FLOAT32 = 8, "Float32", Some(4);
    VISIBLE_STRING = 9, "VisibleString", Some(1);
    OCTET_STRING = 10, "OctetString", Some(1);
    TIME_OF_DAY = 12, "TimeOfDay", None;
    FLOAT64 = 15, "Float64", Some(8);
    DATE = 50, "Date", Some(7);
    INTEGER64 = 55, "Integer64", Some(8);
    UNSIGNED64 = 56, "Unsigned64", Some(8);
    N2 = 113, "N2", Some(2);
    N4 = 114, "N4", Some(4);
    V2 = 115, "V2", Some(2);
    L2 = 116, "L2", Some(2);
    R2 = 117, "R2", Some(2);
    T2 = 118, "T2", Some(2);
    T4 = 119, "T4", Some(4);
    D2 = 120, "D2", Some(2);
    E2 = 121, "E2", Some(2);
    C4 = 122, "C4", Some(4);
    X2 = 123, "X2", Some(2);
    X4 = 124, "X4", Some(4);
    ZERO = 0x40, "Zero", Some(1);
    BYTE = 0x41, "Byte", Some(1);
    WORD = 0x42, "Word", Some(2);
    DOUBLE_WORD = 0x43, "Double word", Some(4);
    ERROR = 0x44, "Error", Some(2);
}

impl fmt::Display for Format {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "format {} ({})", self.0, self.name().unwrap_or("unknown"))
    }
}

/// A Rust type for parameter values. A newtype can implement this trait through its inner type.
pub trait ParameterValue: Sized {
    /// Format in which the type writes values.
    const FORMAT: Format;

    /// Type of the big-endian bytes of a value.
    type Bytes: AsRef<[u8]>;

    /// Returns whether the type can read values of this format.
    ///
    /// A number type can read its own format, other number formats of the same length and signedness, and the format
    /// that defines only this length.
    #[must_use]
    fn reads(format: Format) -> bool;

    /// Returns the big-endian bytes of the value.
    fn to_bytes(self) -> Self::Bytes;

    /// Decodes a value from big-endian bytes.
    ///
    /// # Errors
    ///
    /// Returns [`LengthError`] if the number of bytes differs from the length of the value.
    fn from_bytes(bytes: &[u8]) -> Result<Self, LengthError>;
}

macro_rules! values {
    ($($type:ident $size:literal: $format:ident $(| $other:ident)*;)*) => {$(
        impl ParameterValue for $type {
            const FORMAT: Format = Format::$format;
            type Bytes = [u8; $size];

            fn reads(format: Format) -> bool {
                matches!(format, Format::$format $(| Format::$other)*)
            }

            fn to_bytes(self) -> [u8; $size] {
                self.to_be_bytes()
            }

            fn from_bytes(bytes: &[u8]) -> Result<Self, LengthError> {
                let bytes = bytes.try_into().map_err(|_| LengthError::new($size, bytes.len()))?;
                Ok(Self::from_be_bytes(bytes))
            }
        }
    )*};
}

values! {
    u8 1: UNSIGNED8 | BYTE;
    u16 2: UNSIGNED16 | WORD | V2 | L2 | R2 | T2 | D2;
    u32 4: UNSIGNED32 | DOUBLE_WORD | T4;
    u64 8: UNSIGNED64;
    i8 1: INTEGER8 | BYTE;
    i16 2: INTEGER16 | WORD | N2 | E2 | X2;
    i32 4: INTEGER32 | DOUBLE_WORD | N4 | C4 | X4;
    i64 8: INTEGER64;
    f32 4: FLOAT32 | DOUBLE_WORD;
    f64 8: FLOAT64;
}

/// One byte. `false` is written as 0, and `true` as 1. Every value except 0 is read as `true`.
impl ParameterValue for bool {
    const FORMAT: Format = Format::BOOLEAN;
    type Bytes = [u8; 1];

    fn reads(format: Format) -> bool {
        matches!(format, Format::BOOLEAN | Format::BYTE)
    }

    fn to_bytes(self) -> [u8; 1] {
        [u8::from(self)]
    }

    fn from_bytes(bytes: &[u8]) -> Result<Self, LengthError> {
        u8::from_bytes(bytes).map(|byte| byte != 0)
    }
}
