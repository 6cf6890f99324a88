//! Types of values.

use std::fmt;

use super::{Access, Availability, CompactString, Documentation, ItemRef, Mark, Texts, Value};
use crate::source::Origin;

/// The type of an item: basic, or the position of a [`TypeDef`] in its device.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum Type {
    /// BOOLEAN (CiA 301 code 0x01): one bit in a PDO, one byte in an SDO.
    Boolean,
    /// INTEGER8 … INTEGER64, of any number of bits up to 64.
    Integer(u8),
    /// UNSIGNED8 … UNSIGNED64, of any number of bits up to 64.
    Unsigned(u8),
    /// REAL32 (0x08).
    Real32,
    /// REAL64 (0x11).
    Real64,
    /// VISIBLE_STRING (0x09), at most so many bytes where known.
    VisibleString(Option<u32>),
    /// OCTET_STRING (0x0A), at most so many bytes where known.
    OctetString(Option<u32>),
    /// UNICODE_STRING (0x0B), at most so many UTF-16 units where known.
    UnicodeString(Option<u32>),
    /// TIME_OF_DAY (0x0C).
    TimeOfDay,
    /// TIME_DIFFERENCE (0x0D).
    TimeDifference,
    /// DOMAIN (0x0F): a block of data of any length.
    Domain,
    /// A type of time of IEC 61158-6 that CANopen doesn't have.
    Time(TimeFormat),
    /// A type that the source names or numbers and nobody defines: raw bytes. The number is the source's code, if any.
    Opaque(Option<u32>),
    /// A type that the source defines.
    Named(TypeId),
}

/// Types of time of IEC 61158-6-10, all big-endian on PROFINET.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum TimeFormat {
    /// Date: 7 bytes.
    Date,
    /// TimeOfDay without date indication: 4 bytes, milliseconds after midnight.
    TimeOfDay,
    /// TimeDifference without date indication: 4 bytes, milliseconds.
    TimeDifference,
    /// NetworkTime: 8 bytes.
    NetworkTime,
    /// NetworkTimeDifference: 8 bytes.
    NetworkTimeDifference,
    /// TimeStamp: 12 bytes.
    TimeStamp,
    /// TimeStampDifference: 12 bytes.
    TimeStampDifference,
    /// TimeStampDifferenceShort: 8 bytes.
    TimeStampDifferenceShort,
}

impl TimeFormat {
    /// Length in bytes.
    pub fn bytes(self) -> u32 {
        match self {
            TimeFormat::Date => 7,
            TimeFormat::TimeOfDay | TimeFormat::TimeDifference => 4,
            TimeFormat::NetworkTime | TimeFormat::NetworkTimeDifference | TimeFormat::TimeStampDifferenceShort => 8,
            TimeFormat::TimeStamp | TimeFormat::TimeStampDifference => 12,
        }
    }

    /// The name in IEC 61158-6-10.
    pub fn name(self) -> &'static str {
        match self {
            TimeFormat::Date => "Date",
            TimeFormat::TimeOfDay => "TimeOfDay without date indication",
            TimeFormat::TimeDifference => "TimeDifference without date indication",
            TimeFormat::NetworkTime => "NetworkTime",
            TimeFormat::NetworkTimeDifference => "NetworkTimeDifference",
            TimeFormat::TimeStamp => "TimeStamp",
            TimeFormat::TimeStampDifference => "TimeStampDifference",
            TimeFormat::TimeStampDifferenceShort => "TimeStampDifferenceShort",
        }
    }
}

/// Position of a [`TypeDef`] in the types of what holds it: the device's, the module's, or for everything in a PROFINET
/// submodule [`Catalog::types`](super::Catalog::types).
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct TypeId(pub u32);

impl Type {
    /// Length in bits, where the type has a fixed one and needs no [`TypeDef`] to know it.
    pub fn bits(self) -> Option<u32> {
        match self {
            Type::Boolean => Some(1),
            Type::Integer(bits) | Type::Unsigned(bits) => Some(u32::from(bits)),
            Type::Real32 => Some(32),
            Type::Real64 => Some(64),
            Type::TimeOfDay | Type::TimeDifference => Some(48),
            Type::Time(format) => Some(8 * format.bytes()),
            _ => None,
        }
    }

    /// The name with the greatest length of a text, where that is known: `VISIBLE_STRING(25)`.
    pub fn with_length(self) -> String {
        match self {
            Type::VisibleString(Some(length)) | Type::OctetString(Some(length)) | Type::UnicodeString(Some(length)) => {
                format!("{self}({length})")
            }
            other => other.to_string(),
        }
    }

    /// The basic type with this code in CiA 301 (7.4.7, table of the data type area); `None` for every other code.
    pub fn from_cia301(code: u32) -> Option<Type> {
        Some(match code {
            0x01 => Type::Boolean,
            0x02 => Type::Integer(8),
            0x03 => Type::Integer(16),
            0x04 => Type::Integer(32),
            0x05 => Type::Unsigned(8),
            0x06 => Type::Unsigned(16),
            0x07 => Type::Unsigned(32),
            0x08 => Type::Real32,
            0x09 => Type::VisibleString(None),
            0x0A => Type::OctetString(None),
            0x0B => Type::UnicodeString(None),
            0x0C => Type::TimeOfDay,
            0x0D => Type::TimeDifference,
            0x0F => Type::Domain,
            0x10 => Type::Integer(24),
            0x11 => Type::Real64,
            0x12 => Type::Integer(40),
            0x13 => Type::Integer(48),
            0x14 => Type::Integer(56),
            0x15 => Type::Integer(64),
            0x16 => Type::Unsigned(24),
            0x18 => Type::Unsigned(40),
            0x19 => Type::Unsigned(48),
            0x1A => Type::Unsigned(56),
            0x1B => Type::Unsigned(64),
            _ => return None,
        })
    }

    /// The least and greatest value of an integer type.
    pub fn integer_range(self) -> Option<(i128, i128)> {
        match self {
            Type::Boolean => Some((0, 1)),
            Type::Integer(bits @ 1..=64) => Some((-(1 << (bits - 1)), (1 << (bits - 1)) - 1)),
            Type::Unsigned(bits @ 1..=64) => Some((0, (1 << bits) - 1)),
            _ => None,
        }
    }

    /// The name of an integer as a part of another name: `U16`, `I8`.
    pub(crate) fn integer_suffix(self) -> String {
        match self {
            Type::Unsigned(bits) => format!("U{bits}"),
            Type::Integer(bits) => format!("I{bits}"),
            _ => String::new(),
        }
    }

    /// Whether the value is a number with a sign.
    pub fn is_signed(self) -> bool {
        matches!(self, Type::Integer(_))
    }

    /// Whether the value is a sequence of bytes: text or raw data, for which a register has no order of words.
    pub fn is_bytes(self) -> bool {
        use Type::{Domain, OctetString, Opaque, UnicodeString, VisibleString};
        matches!(self, VisibleString(_) | OctetString(_) | UnicodeString(_) | Domain | Opaque(_))
    }
}

impl fmt::Display for Type {
    /// The name in CiA 301.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Type::Boolean => f.write_str("BOOLEAN"),
            Type::Integer(bits) => write!(f, "INTEGER{bits}"),
            Type::Unsigned(bits) => write!(f, "UNSIGNED{bits}"),
            Type::Real32 => f.write_str("REAL32"),
            Type::Real64 => f.write_str("REAL64"),
            Type::VisibleString(_) => f.write_str("VISIBLE_STRING"),
            Type::OctetString(_) => f.write_str("OCTET_STRING"),
            Type::UnicodeString(_) => f.write_str("UNICODE_STRING"),
            Type::TimeOfDay => f.write_str("TIME_OF_DAY"),
            Type::TimeDifference => f.write_str("TIME_DIFFERENCE"),
            Type::Domain => f.write_str("DOMAIN"),
            Type::Time(format) => f.write_str(format.name()),
            Type::Opaque(Some(code)) => write!(f, "type {code:#06X}"),
            Type::Opaque(None) => f.write_str("unknown type"),
            Type::Named(TypeId(id)) => write!(f, "type #{id}"),
        }
    }
}

/// A type that a device defines.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct TypeDef {
    /// Its name in the source.
    pub name: CompactString,
    /// Its number in the source (a DEFTYPE or DEFSTRUCT's index), if it has one.
    pub code: Option<u32>,
    /// What it is made of.
    pub shape: Shape,
    /// Its length in bits, where fixed.
    pub bits: Option<u32>,
    /// What the source says about it.
    pub documentation: Option<Box<Documentation>>,
    /// Where it is defined.
    pub origin: Origin,
}

/// What a defined type is made of.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum Shape {
    /// Another name of a type.
    Alias(Type),
    /// Equal elements, in up to three dimensions, the outermost first.
    Array {
        /// Type of an element.
        element: Type,
        /// Lower bound and number of elements of each dimension.
        dimensions: Vec<(i32, u32)>,
    },
    /// Fields at bit offsets (ETG.2000 SubItem, a parameter record of GSDML).
    Record(Vec<Field>),
    /// Named bits of an integer.
    BitField {
        /// The integer below.
        base: Type,
        /// The fields, by offset.
        fields: Vec<BitFieldEntry>,
    },
    /// Named values of an integer.
    Enumeration {
        /// The integer below.
        base: Type,
        /// The values, in the order of the source.
        values: Vec<EnumValue>,
        /// Whether a device never has a value that isn't listed.
        closed: bool,
    },
    /// An integer that stands for a physical number.
    Scaled {
        /// The integer below.
        base: Type,
        /// How the two relate.
        scale: Scale,
    },
}

/// A field of a record.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Field {
    /// Its name.
    pub name: CompactString,
    /// Its sub-index, where records are addressed by sub-index.
    pub sub_index: Option<u16>,
    /// Its type.
    pub ty: Type,
    /// Its length in bits.
    pub bits: u32,
    /// Its first bit, counted from the record's first.
    pub bit_offset: u32,
}

/// A field of a bit field.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct BitFieldEntry {
    /// Its name.
    pub name: CompactString,
    /// The name in other languages.
    pub names: Texts,
    /// Its first bit.
    pub offset: u8,
    /// Its length in bits.
    pub bits: u8,
    /// What the bits mean.
    pub meaning: BitMeaning,
    /// The value of another item that gives the bits this meaning (the mode of operation, say).
    pub when: Option<Condition>,
    /// Whether the field acts on an edge, clears itself, or toggles.
    pub trigger: Option<Trigger>,
    /// Who may do what with the bits, where it isn't what the item says.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub access: Option<Access>,
    /// Models and firmware versions in which the bits mean this.
    pub availability: Option<Box<Availability>>,
    /// What the source says about it.
    pub documentation: Option<Box<Documentation>>,
    /// Where it stands.
    #[cfg_attr(feature = "serde", serde(skip))]
    pub at: Mark,
}

impl BitFieldEntry {
    /// Bits of which nothing else is known.
    pub fn new(name: CompactString, offset: u8, bits: u8, meaning: BitMeaning) -> Self {
        BitFieldEntry {
            name,
            names: Texts::default(),
            offset,
            bits,
            meaning,
            when: None,
            trigger: None,
            access: None,
            availability: None,
            documentation: None,
            at: Default::default(),
        }
    }

    /// Whether the bits are reserved.
    pub fn is_reserved(&self) -> bool {
        matches!(self.meaning, BitMeaning::Reserved { .. })
    }

    /// The first bit behind the field.
    pub fn end(&self) -> u32 {
        u32::from(self.offset) + u32::from(self.bits)
    }

    /// `bit 3`, `bits 7-4`: the bits in messages.
    pub(crate) fn place(&self) -> String {
        match self.bits {
            1 => format!("bit {}", self.offset),
            _ => format!("bits {}-{}", self.end().saturating_sub(1), self.offset),
        }
    }

    /// Returns the bits of the field.
    pub(crate) fn mask(&self) -> u64 {
        let bits = u64::MAX.checked_shr(64u32.saturating_sub(self.bits.into())).unwrap_or(0);
        bits.checked_shl(self.offset.into()).unwrap_or(0)
    }
}

/// What the bits of a field mean.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum BitMeaning {
    /// One bit that is set or not.
    Flag {
        /// Whether 0 means "set".
        inverted: bool,
    },
    /// An unsigned number.
    Number,
    /// Named values; the type is an enumeration.
    Enumeration(TypeId),
    /// Reserved: what a writer has to put there, where known.
    Reserved {
        /// 0, 1, or `None` for "as it was read".
        write: Option<bool>,
    },
}

/// When a bit acts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum Trigger {
    /// On the change from 0 to 1.
    Rising,
    /// On the change from 1 to 0.
    Falling,
    /// On every change.
    Toggle,
    /// While set; the device clears it by itself.
    SelfClearing,
}

/// One value, or a range of values, of an enumeration.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct EnumValue {
    /// Its name.
    pub name: CompactString,
    /// The value; the first of a range.
    pub value: i128,
    /// The last value of a range.
    pub last: Option<i128>,
    /// Whether the value, or the range, is reserved or left to the vendor.
    pub zone: Option<Zone>,
    /// The name in other languages.
    pub names: Texts,
    /// The value of another item with which the device has it (the mode of operation, say).
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub when: Option<Condition>,
    /// Models, firmware versions and buses that have it.
    pub availability: Option<Box<Availability>>,
    /// What the source says about it.
    pub documentation: Option<Box<Documentation>>,
    /// Where it stands.
    #[cfg_attr(feature = "serde", serde(skip))]
    pub at: Mark,
}

impl EnumValue {
    /// One value of which nothing else is known.
    pub fn new(name: CompactString, value: i128) -> Self {
        EnumValue {
            name,
            value,
            last: None,
            zone: None,
            names: Texts::default(),
            when: None,
            availability: None,
            documentation: None,
            at: Default::default(),
        }
    }

    /// The first and the last value.
    pub fn range(&self) -> (i128, i128) {
        (self.value, self.last.unwrap_or(self.value))
    }

    /// Whether it is a name, and no zone.
    pub fn is_named(&self) -> bool {
        self.zone.is_none()
    }

    /// `3`, `4 to 7`: the value, or the range of values, in messages.
    pub(crate) fn numbers(&self) -> String {
        match self.last {
            Some(last) => format!("{} to {last}", self.value),
            None => self.value.to_string(),
        }
    }
}

/// A zone of an enumeration.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum Zone {
    /// Must not be used.
    Reserved,
    /// Left to the vendor.
    Vendor,
}

/// How a raw number relates to a physical one.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum Scale {
    /// physical = raw × factor + offset.
    Linear {
        /// Physical units per count.
        #[cfg_attr(feature = "serde", serde(with = "super::real"))]
        factor: f64,
        /// The physical value of raw 0.
        #[cfg_attr(feature = "serde", serde(with = "super::real"))]
        offset: f64,
    },
    /// physical = numerator / raw.
    Reciprocal {
        /// The numerator.
        #[cfg_attr(feature = "serde", serde(with = "super::real"))]
        numerator: f64,
    },
    /// A fraction of a base value: physical = raw / 2^bits × base.
    Fraction {
        /// Number of fractional bits (15 for Q15).
        bits: u8,
        /// The name of the base value, a constant of the variant.
        base: CompactString,
    },
    /// physical = raw / 2^fraction × base^exponent, in two items or two halves of one.
    Exponent {
        /// The item that holds the exponent.
        exponent: ItemRef,
        /// What is raised to it: 10, or 2.
        base: u8,
        /// Number of fractional bits of the raw number (15 for Q15); 0 for an integer.
        fraction: u8,
    },
    /// physical = raw × factor / value of another item.
    ByItem {
        /// The other item.
        item: ItemRef,
        /// The constant part.
        #[cfg_attr(feature = "serde", serde(with = "super::real"))]
        factor: f64,
    },
    /// physical = raw × factor × value of another item.
    TimesItem {
        /// The other item.
        item: ItemRef,
        /// The constant part.
        #[cfg_attr(feature = "serde", serde(with = "super::real"))]
        factor: f64,
    },
}

/// "While the item `item` has one of these values."
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Condition {
    /// The other item.
    pub item: ItemRef,
    /// Its values.
    pub values: Vec<Value>,
    /// The names of all values, where a profile has the condition and names them; else empty.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Vec::is_empty"))]
    pub names: Vec<CompactString>,
    /// The bits of the item that are compared with the values; `None` = all.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub mask: Option<u64>,
}
