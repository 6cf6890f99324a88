//! Types of values, and their definitions.

use std::fmt;
use std::sync::Arc;

use super::{Access, Availability, CompactString, Documentation, Doubts, FactOrigin, ItemRef, Mark, Texts, Value};
use crate::number::hex16;
use crate::source::Origin;

/// The type of an item: a basic type, or a reference to a [`TypeDef`] of the item's device, module or catalog.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum Type {
    /// BOOLEAN (CiA 301, 0x01): one bit in a PDO, one byte in an SDO.
    Boolean,
    /// INTEGER8 to INTEGER64, with any number of bits up to 64.
    Integer(u8),
    /// UNSIGNED8 to UNSIGNED64, with any number of bits up to 64.
    Unsigned(u8),
    /// REAL32 (0x08), with single precision.
    Real32,
    /// REAL64 (0x11), with double precision.
    Real64,
    /// VISIBLE_STRING (0x09), with the maximum length in bytes if known.
    VisibleString(Option<u32>),
    /// OCTET_STRING (0x0A), with the maximum length in bytes if known.
    OctetString(Option<u32>),
    /// UNICODE_STRING (0x0B), with the maximum length in UTF-16 code units if known.
    UnicodeString(Option<u32>),
    /// TIME_OF_DAY (0x0C): a date and a time of day.
    TimeOfDay,
    /// TIME_DIFFERENCE (0x0D): a duration.
    TimeDifference,
    /// DOMAIN (0x0F): a block of data of any length.
    Domain,
    /// A time type of IEC 61158-6-10 that does not exist in CANopen.
    Time(TimeFormat),
    /// Raw bytes of a type without a definition. The number is the code of the type in the source, if any.
    Opaque(Option<u32>),
    /// A type that the source defines.
    Named(TypeId),
}

/// A time type of IEC 61158-6-10. All time types are big-endian on PROFINET.
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
    /// Returns the length of the time type in bytes.
    pub fn bytes(self) -> u32 {
        match self {
            TimeFormat::Date => 7,
            TimeFormat::TimeOfDay | TimeFormat::TimeDifference => 4,
            TimeFormat::NetworkTime | TimeFormat::NetworkTimeDifference | TimeFormat::TimeStampDifferenceShort => 8,
            TimeFormat::TimeStamp | TimeFormat::TimeStampDifference => 12,
        }
    }

    /// Returns the name of the time type in IEC 61158-6-10.
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

/// Position of a [`TypeDef`] in the types of its device or module. Types of PROFINET submodules are in
/// [`Catalog::types`](super::Catalog::types).
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct TypeId(pub u32);

impl Type {
    /// Returns the length in bits, if the type is basic and has a fixed length.
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

    /// Returns the name of the type in CiA 301 or IEC 61158-6-10, with the maximum length of a string if known:
    /// `VISIBLE_STRING(25)`. Returns a placeholder if the type has no such name.
    pub fn with_length(self) -> String {
        match self {
            Type::VisibleString(Some(length)) | Type::OctetString(Some(length)) | Type::UnicodeString(Some(length)) => {
                format!("{self}({length})")
            }
            other => other.to_string(),
        }
    }

    /// Returns the basic type with this code in CiA 301 (7.4.7, table of the data type area), or `None` for other codes.
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

    /// Returns the minimum and the maximum of an integer type or BOOLEAN, or `None` for any other type.
    pub fn integer_range(self) -> Option<(i128, i128)> {
        match self {
            Type::Boolean => Some((0, 1)),
            Type::Integer(bits @ 1..=64) => Some((-(1 << (bits - 1)), (1 << (bits - 1)) - 1)),
            Type::Unsigned(bits @ 1..=64) => Some((0, (1 << bits) - 1)),
            _ => None,
        }
    }

    /// Returns the abbreviation of an integer type for use in a longer name: `U16`, `I8`. The text is empty for other
    /// types.
    pub(crate) fn integer_suffix(self) -> String {
        match self {
            Type::Unsigned(bits) => format!("U{bits}"),
            Type::Integer(bits) => format!("I{bits}"),
            _ => String::new(),
        }
    }

    /// Returns whether the type is a signed integer.
    pub fn is_signed(self) -> bool {
        matches!(self, Type::Integer(_))
    }

    /// Returns whether values of the type are byte sequences: strings or raw data. Byte sequences have no word order in
    /// registers.
    pub fn is_bytes(self) -> bool {
        use Type::{Domain, OctetString, Opaque, UnicodeString, VisibleString};
        matches!(self, VisibleString(_) | OctetString(_) | UnicodeString(_) | Domain | Opaque(_))
    }
}

impl fmt::Display for Type {
    /// Writes the name of the type in CiA 301 or IEC 61158-6-10, or a placeholder if the type has no such name.
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
            Type::Opaque(Some(code)) => write!(f, "type {}", hex16(*code)),
            Type::Opaque(None) => f.write_str("unknown type"),
            Type::Named(TypeId(id)) => write!(f, "type #{id}"),
        }
    }
}

/// A type that a device defines.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct TypeDef {
    /// Name of the type in the source.
    pub name: CompactString,
    /// Number of the type in the source (index of a DEFTYPE or DEFSTRUCT), if any.
    pub code: Option<u32>,
    /// Definition of the type.
    pub shape: Shape,
    /// Length of the type in bits, if fixed.
    pub bits: Option<u32>,
    /// Description of the type from the source.
    pub documentation: Option<Arc<Documentation>>,
    /// Ambiguities in the source about the type and its bits or values, with the assumptions made.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Doubts::is_empty"))]
    pub doubts: Doubts,
    /// Origin of the definition; `None` = the description itself.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub stated_by: Option<Box<FactOrigin>>,
    /// Location of the type in the source.
    pub origin: Origin,
}

impl TypeDef {
    /// Creates a definition without a number, a description or an origin.
    pub fn new(name: impl Into<CompactString>, shape: Shape, bits: Option<u32>) -> Self {
        let name = name.into();
        let (doubts, origin) = Default::default();
        TypeDef { name, code: None, shape, bits, documentation: None, doubts, stated_by: None, origin }
    }
}

/// The definition of a type: an alias, an array, a record, a bit field, an enumeration or a scaled integer.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum Shape {
    /// Another name of an existing type.
    Alias(Type),
    /// Elements of one type in up to three dimensions, outermost dimension first.
    Array {
        /// Type of each element.
        element: Type,
        /// Lower bound and number of elements of each dimension.
        dimensions: Vec<(i32, u32)>,
    },
    /// Fields at bit offsets (ETG.2000 SubItem, GSDML parameter record).
    Record(Vec<Field>),
    /// Named bits of an integer.
    BitField {
        /// The underlying integer type.
        base: Type,
        /// Named bits and groups of bits, sorted by offset.
        fields: Vec<BitFieldEntry>,
    },
    /// Named values of an integer.
    Enumeration {
        /// The underlying integer type.
        base: Type,
        /// Named values in the order of the source.
        values: Vec<EnumValue>,
        /// True if the list is complete: a device never has another value.
        closed: bool,
    },
    /// An integer with a conversion to a physical value.
    Scaled {
        /// The underlying integer type.
        base: Type,
        /// Conversion between raw value and physical value.
        scale: Scale,
    },
}

/// A field of a record.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Field {
    /// Name of the field.
    pub name: CompactString,
    /// Sub-index, if fields of the record have sub-indices.
    pub sub_index: Option<u16>,
    /// Type of the field.
    pub ty: Type,
    /// Length of the field in bits.
    pub bits: u32,
    /// Bit offset from the start of the record.
    pub bit_offset: u32,
}

/// A named bit or group of adjacent bits in a bit field.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct BitFieldEntry {
    /// Name of the field.
    pub name: CompactString,
    /// Name of the field in other languages.
    pub names: Texts,
    /// Offset of the least significant bit.
    pub offset: u8,
    /// Length in bits.
    pub bits: u8,
    /// Meaning of the bits.
    pub meaning: BitMeaning,
    /// Condition on another item, such as the mode of operation, under which the bits have this meaning.
    pub when: Option<Box<Condition>>,
    /// Event at which the bits take effect; `None` = the bits take effect as long as they are set.
    pub trigger: Option<Trigger>,
    /// Access rights of the bits, if they differ from those of the item.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub access: Option<Access>,
    /// Models and firmware versions in which the bits have this meaning.
    pub availability: Option<Box<Availability>>,
    /// Description of the field from the source.
    pub documentation: Option<Arc<Documentation>>,
    /// Location of the field in the source.
    #[cfg_attr(feature = "serde", serde(skip))]
    pub at: Mark,
}

impl BitFieldEntry {
    /// Creates a field that has the given facts and no others.
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

    /// Returns whether the bits are reserved.
    pub fn is_reserved(&self) -> bool {
        matches!(self.meaning, BitMeaning::Reserved { .. })
    }

    /// Returns the number of the first bit after the field.
    pub fn end(&self) -> u32 {
        u32::from(self.offset) + u32::from(self.bits)
    }

    /// Returns the bits as text for diagnostics: `bit 3`, `bits 7-4`.
    pub(crate) fn bit_range(&self) -> String {
        match self.bits {
            1 => format!("bit {}", self.offset),
            _ => format!("bits {}-{}", self.end().saturating_sub(1), self.offset),
        }
    }

    /// Returns a mask with the bits of the field.
    pub(crate) fn mask(&self) -> u64 {
        let bits = u64::MAX.checked_shr(64u32.saturating_sub(self.bits.into())).unwrap_or(0);
        bits.checked_shl(self.offset.into()).unwrap_or(0)
    }
}

/// The meaning of the bits of a field.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum BitMeaning {
    /// A single bit that states whether something is active.
    Flag {
        /// True if the bit is 0 when the flag is active.
        inverted: bool,
    },
    /// An unsigned number of several bits.
    Number,
    /// Named values of an enumeration.
    Enumeration(TypeId),
    /// Reserved bits.
    Reserved {
        /// Value that a client writes to the bits; `None` = the value that was read.
        write: Option<bool>,
    },
}

/// The event at which a bit takes effect.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum Trigger {
    /// The bit takes effect on its rising edge.
    Rising,
    /// The bit takes effect on its falling edge.
    Falling,
    /// The bit takes effect on each edge.
    Toggle,
    /// The bit takes effect while it is set, and the device clears it automatically.
    SelfClearing,
}

/// A value or a range of values of an enumeration.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct EnumValue {
    /// Name of the value.
    pub name: CompactString,
    /// Value, or first value of a range.
    pub value: i128,
    /// Last value of a range.
    pub last: Option<i128>,
    /// Kind of the value or range, if it is reserved or vendor-specific.
    pub zone: Option<Zone>,
    /// Name of the value in other languages.
    pub names: Texts,
    /// Condition on another item, such as the mode of operation, under which the device has this value.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub when: Option<Box<Condition>>,
    /// Models, firmware versions and buses that have the value.
    pub availability: Option<Box<Availability>>,
    /// Description of the value from the source.
    pub documentation: Option<Arc<Documentation>>,
    /// Location of the value in the source.
    #[cfg_attr(feature = "serde", serde(skip))]
    pub at: Mark,
}

impl EnumValue {
    /// Creates a value that has a name and a number and no other facts.
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

    /// Returns the first and the last value of the range.
    pub fn range(&self) -> (i128, i128) {
        (self.value, self.last.unwrap_or(self.value))
    }

    /// Returns whether the value is neither reserved nor vendor-specific.
    pub fn is_named(&self) -> bool {
        self.zone.is_none()
    }

    /// Returns the value or range as text for diagnostics: `3`, `4 to 7`.
    pub(crate) fn numbers(&self) -> String {
        match self.last {
            Some(last) => format!("{} to {last}", self.value),
            None => self.value.to_string(),
        }
    }
}

/// The kind of a reserved or vendor-specific value or range.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum Zone {
    /// The values are reserved and must not be used.
    Reserved,
    /// The values are vendor-specific.
    Vendor,
}

/// The conversion between raw value and physical value.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum Scale {
    /// physical = raw × factor + offset.
    Linear {
        /// Scale factor: physical value of 1 LSB.
        #[cfg_attr(feature = "serde", serde(with = "super::real"))]
        factor: f64,
        /// Physical value of raw value 0.
        #[cfg_attr(feature = "serde", serde(with = "super::real"))]
        offset: f64,
    },
    /// physical = numerator / raw.
    Reciprocal {
        /// Numerator of the quotient.
        #[cfg_attr(feature = "serde", serde(with = "super::real"))]
        numerator: f64,
    },
    /// physical = raw / 2^bits × base.
    Fraction {
        /// Number of fractional bits (15 for Q15).
        bits: u8,
        /// Name of the base value, which is a constant of the model.
        base: CompactString,
    },
    /// physical = raw / 2^fraction × base^exponent. Mantissa and exponent are two items, or two halves of one item.
    Exponent {
        /// Item with the exponent.
        exponent: ItemRef,
        /// Base of the power: 10 or 2.
        base: u8,
        /// Number of fractional bits of the raw value (15 for Q15); 0 for an integer.
        fraction: u8,
    },
    /// physical = raw × factor / value of another item.
    ByItem {
        /// Item whose value is the divisor.
        item: ItemRef,
        /// Constant scale factor.
        #[cfg_attr(feature = "serde", serde(with = "super::real"))]
        factor: f64,
    },
    /// physical = raw × factor × value of another item.
    TimesItem {
        /// Item whose value is a factor.
        item: ItemRef,
        /// Constant scale factor.
        #[cfg_attr(feature = "serde", serde(with = "super::real"))]
        factor: f64,
    },
}

/// A condition: the value of another item is one of the listed values.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Condition {
    /// Item whose value is compared.
    pub item: ItemRef,
    /// Values that meet the condition.
    pub values: Vec<Value>,
    /// Names of all values in `values`, if the condition comes from a profile that names the values; otherwise empty.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Vec::is_empty"))]
    pub names: Vec<CompactString>,
    /// Mask of the bits that are compared with the values; `None` = all bits.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub mask: Option<u64>,
}
