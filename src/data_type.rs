//! Data types of an object dictionary.

use core::fmt;

/// A basic or extended data type of CiA 301 (7.1.4 and 7.1.6), [`Bits`](DataType::Bits) or
/// [`Opaque`](DataType::Opaque).
///
/// `Display` writes the name in the standard, for example `INTEGER32`. For [`Opaque`](DataType::Opaque), `Display`
/// writes `OPAQUE`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum DataType {
    /// A Boolean value (CiA 301 7.1.4.3).
    Boolean,
    /// A signed integer of 8 bits (CiA 301 7.1.4.6).
    Integer8,
    /// A signed integer of 16 bits.
    Integer16,
    /// A signed integer of 24 bits.
    Integer24,
    /// A signed integer of 32 bits.
    Integer32,
    /// A signed integer of 40 bits.
    Integer40,
    /// A signed integer of 48 bits.
    Integer48,
    /// A signed integer of 56 bits.
    Integer56,
    /// A signed integer of 64 bits.
    Integer64,
    /// An unsigned integer of 8 bits (CiA 301 7.1.4.5).
    Unsigned8,
    /// An unsigned integer of 16 bits.
    Unsigned16,
    /// An unsigned integer of 24 bits.
    Unsigned24,
    /// An unsigned integer of 32 bits.
    Unsigned32,
    /// An unsigned integer of 40 bits.
    Unsigned40,
    /// An unsigned integer of 48 bits.
    Unsigned48,
    /// An unsigned integer of 56 bits.
    Unsigned56,
    /// An unsigned integer of 64 bits.
    Unsigned64,
    /// An IEEE 754 floating-point number of 32 bits (CiA 301 7.1.4.7).
    Real32,
    /// An IEEE 754 floating-point number of 64 bits.
    Real64,
    /// ISO 646 text, one byte per character (CiA 301 7.1.6.3).
    VisibleString,
    /// A byte string (CiA 301 7.1.6.2).
    OctetString,
    /// UTF-16 text, two bytes per code unit (CiA 301 7.1.6.4).
    UnicodeString,
    /// A date with the time of day (CiA 301 7.1.6.5).
    TimeOfDay,
    /// A time span (CiA 301 7.1.6.6).
    TimeDifference,
    /// A block of bytes of any length (CiA 301 7.1.6.7).
    Domain,
    /// An unsigned integer of 1 to 16 bits that shares its bytes with other values, for example in a PDO (BIT1 … BIT16
    /// of ETG.1000.6).
    Bits(u8),
    /// Bytes whose meaning is not in the device description.
    Opaque,
}

impl DataType {
    /// Returns whether the type is a signed integer.
    pub(crate) const fn is_signed(self) -> bool {
        matches!(
            self,
            Self::Integer8
                | Self::Integer16
                | Self::Integer24
                | Self::Integer32
                | Self::Integer40
                | Self::Integer48
                | Self::Integer56
                | Self::Integer64
        )
    }

    /// Returns the size in bits, or `None` if the type has no fixed size.
    #[must_use]
    pub const fn bits(self) -> Option<u32> {
        Some(match self {
            Self::Boolean => 1,
            Self::Integer8 | Self::Unsigned8 => 8,
            Self::Integer16 | Self::Unsigned16 => 16,
            Self::Integer24 | Self::Unsigned24 => 24,
            Self::Integer32 | Self::Unsigned32 | Self::Real32 => 32,
            Self::Integer40 | Self::Unsigned40 => 40,
            Self::Integer48 | Self::Unsigned48 | Self::TimeOfDay | Self::TimeDifference => 48,
            Self::Integer56 | Self::Unsigned56 => 56,
            Self::Integer64 | Self::Unsigned64 | Self::Real64 => 64,
            Self::Bits(bits) => bits as u32,
            Self::VisibleString | Self::OctetString | Self::UnicodeString | Self::Domain | Self::Opaque => return None,
        })
    }

    const fn name(self) -> &'static str {
        match self {
            Self::Boolean => "BOOLEAN",
            Self::Integer8 => "INTEGER8",
            Self::Integer16 => "INTEGER16",
            Self::Integer24 => "INTEGER24",
            Self::Integer32 => "INTEGER32",
            Self::Integer40 => "INTEGER40",
            Self::Integer48 => "INTEGER48",
            Self::Integer56 => "INTEGER56",
            Self::Integer64 => "INTEGER64",
            Self::Unsigned8 => "UNSIGNED8",
            Self::Unsigned16 => "UNSIGNED16",
            Self::Unsigned24 => "UNSIGNED24",
            Self::Unsigned32 => "UNSIGNED32",
            Self::Unsigned40 => "UNSIGNED40",
            Self::Unsigned48 => "UNSIGNED48",
            Self::Unsigned56 => "UNSIGNED56",
            Self::Unsigned64 => "UNSIGNED64",
            Self::Real32 => "REAL32",
            Self::Real64 => "REAL64",
            Self::VisibleString => "VISIBLE_STRING",
            Self::OctetString => "OCTET_STRING",
            Self::UnicodeString => "UNICODE_STRING",
            Self::TimeOfDay => "TIME_OF_DAY",
            Self::TimeDifference => "TIME_DIFFERENCE",
            Self::Domain => "DOMAIN",
            Self::Bits(_) => "BIT",
            Self::Opaque => "OPAQUE",
        }
    }
}

impl fmt::Display for DataType {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Bits(bits) => write!(f, "BIT{bits}"),
            _ => f.pad(self.name()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::format;

    #[test]
    fn names_are_those_of_the_standard() {
        assert_eq!(format!("{}", DataType::Integer32), "INTEGER32");
        assert_eq!(format!("{}", DataType::Bits(3)), "BIT3");
        assert_eq!(format!("{:>8}", DataType::Domain), "  DOMAIN");
    }

    #[test]
    fn sizes() {
        assert_eq!(DataType::Boolean.bits(), Some(1));
        assert_eq!(DataType::TimeOfDay.bits(), Some(48));
        assert_eq!(DataType::VisibleString.bits(), None);
    }
}
