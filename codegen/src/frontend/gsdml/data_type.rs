//! Data types of GSDML and their lengths.

use crate::ir::{TimeFormat, Type};

/// Data type that GSDML defines by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum DataType {
    /// Type that also exists in the IR.
    Basic(Type),
    /// String whose length in bytes the file declares.
    String(StringType),
    /// Number with a defined meaning, such as a normalized value of PROFIdrive.
    Number(&'static NumberType),
    /// Value with its status, or two values.
    Pair(&'static PairType),
    /// Octet string whose length in bytes the file declares. The last octet is a status.
    OctetsWithStatus,
    /// Trailer of a PROFIsafe message, with its length in bytes. The trailer contains no user data.
    Trailer(u32),
    /// Single bit.
    Bit,
    /// Range of bits.
    BitArea,
}

/// String type of GSDML.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum StringType {
    Visible,
    Octet,
    /// String in another encoding or with a header, with the name of its type in the IR. The string is read as octets.
    Named(&'static str),
}

/// Numeric type with a name.
#[derive(Debug, PartialEq)]
pub(super) struct NumberType {
    pub name: &'static str,
    pub base: Type,
    /// Physical value of 1 LSB, if the type defines this value.
    pub factor: Option<f64>,
}

impl Eq for NumberType {}

/// Type that consists of two values.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct PairType {
    pub name: &'static str,
    pub first: Type,
    pub second: Type,
    /// Suffix for the name of the second value.
    pub suffix: &'static str,
}

const fn number(name: &'static str, base: Type, factor: Option<f64>) -> NumberType {
    NumberType { name, base, factor }
}

/// Numbers with a defined meaning, such as normalized values of PROFIdrive and fixed-point numbers of IEC 61158-6-10. A
/// value of 100 % is 2^14 for N2 and 2^30 for N4.
static NUMBERS: [NumberType; 13] = [
    number("N2", Type::Integer(16), Some(100.0 / 16_384.0)),
    number("N4", Type::Integer(32), Some(100.0 / 1_073_741_824.0)),
    number("E2", Type::Integer(16), Some(1.0 / 128.0)),
    number("C4", Type::Integer(32), Some(1e-4)),
    number("X2", Type::Integer(16), None),
    number("X4", Type::Integer(32), None),
    number("T2", Type::Unsigned(16), None),
    number("T4", Type::Unsigned(32), None),
    number("D2", Type::Unsigned(16), None),
    number("R2", Type::Unsigned(16), None),
    number("Unipolar2.16", Type::Unsigned(16), None),
    // The bit sequences V2 and L2 are read as plain integers.
    number("V2", Type::Unsigned(16), None),
    number("L2", Type::Unsigned(16), None),
];

const fn pair(name: &'static str, first: Type, suffix: &'static str) -> PairType {
    PairType { name, first, second: Type::Unsigned(8), suffix }
}

static PAIRS: [PairType; 7] = [
    pair("Float32+Unsigned8", Type::Real32, "status"),
    pair("Float32+Status8", Type::Real32, "status"),
    pair("Unsigned8+Unsigned8", Type::Unsigned(8), "2"),
    pair("OctetString2+Unsigned8", Type::OctetString(Some(2)), "status"),
    pair("Unsigned16_S", Type::Unsigned(16), "status"),
    pair("Integer16_S", Type::Integer(16), "status"),
    pair("Unsigned8_S", Type::Unsigned(8), "status"),
];

/// Data types of IEC 61158-6-10 and IEC 61131, which most GSDML files use.
static BASIC: [(&str, DataType); 31] = [
    ("Unsigned8", DataType::Basic(Type::Unsigned(8))),
    ("Unsigned16", DataType::Basic(Type::Unsigned(16))),
    ("Unsigned32", DataType::Basic(Type::Unsigned(32))),
    ("Unsigned64", DataType::Basic(Type::Unsigned(64))),
    ("Integer8", DataType::Basic(Type::Integer(8))),
    ("Integer16", DataType::Basic(Type::Integer(16))),
    ("Integer32", DataType::Basic(Type::Integer(32))),
    ("Integer64", DataType::Basic(Type::Integer(64))),
    ("Float32", DataType::Basic(Type::Real32)),
    ("Float64", DataType::Basic(Type::Real64)),
    // A Boolean value is one byte, whose bit 0 is the value.
    ("Boolean", DataType::Basic(Type::Boolean)),
    ("Bit", DataType::Bit),
    ("BitArea", DataType::BitArea),
    ("VisibleString", DataType::String(StringType::Visible)),
    ("OctetString", DataType::String(StringType::Octet)),
    ("UnicodeString8", DataType::String(StringType::Named("UnicodeString8"))),
    ("61131_STRING", DataType::String(StringType::Named("61131_STRING"))),
    ("61131_WSTRING", DataType::String(StringType::Named("61131_WSTRING"))),
    ("OctetString_S", DataType::OctetsWithStatus),
    ("F_MessageTrailer4Byte", DataType::Trailer(4)),
    ("F_MessageTrailer5Byte", DataType::Trailer(5)),
    ("Date", DataType::Basic(Type::Time(TimeFormat::Date))),
    ("TimeOfDay with date indication", DataType::Basic(Type::TimeOfDay)),
    ("TimeDifference with date indication", DataType::Basic(Type::TimeDifference)),
    ("TimeOfDay without date indication", DataType::Basic(Type::Time(TimeFormat::TimeOfDay))),
    ("TimeDifference without date indication", DataType::Basic(Type::Time(TimeFormat::TimeDifference))),
    ("NetworkTime", DataType::Basic(Type::Time(TimeFormat::NetworkTime))),
    ("NetworkTimeDifference", DataType::Basic(Type::Time(TimeFormat::NetworkTimeDifference))),
    ("TimeStamp", DataType::Basic(Type::Time(TimeFormat::TimeStamp))),
    ("TimeStampDifference", DataType::Basic(Type::Time(TimeFormat::TimeStampDifference))),
    ("TimeStampDifferenceShort", DataType::Basic(Type::Time(TimeFormat::TimeStampDifferenceShort))),
];

impl DataType {
    /// Returns the data type called `name`.
    pub fn find(name: &str) -> Option<Self> {
        Self::all().find(|(other, _)| *other == name).map(|(_, ty)| ty)
    }

    /// Returns the data type called `name`, ignoring case, and its correct spelling.
    pub fn find_in_any_case(name: &str) -> Option<(&'static str, Self)> {
        Self::all().find(|(other, _)| other.eq_ignore_ascii_case(name))
    }

    fn all() -> impl Iterator<Item = (&'static str, Self)> {
        let numbers = NUMBERS.iter().map(|number| match number.name {
            "V2" | "L2" => (number.name, DataType::Basic(number.base)),
            name => (name, DataType::Number(number)),
        });
        BASIC.iter().copied().chain(numbers).chain(PAIRS.iter().map(|pair| (pair.name, DataType::Pair(pair))))
    }

    /// Returns the length of the data type in bytes, or `None` if the data type does not define a length.
    pub fn bytes(self) -> Option<u32> {
        match self {
            DataType::Basic(Type::Boolean) => Some(1),
            DataType::Basic(ty) => ty.bits().map(|bits| bits / 8),
            DataType::Number(number) => number.base.bits().map(|bits| bits / 8),
            DataType::Pair(pair) => Some(pair.first_bits() / 8 + 1),
            DataType::Trailer(bytes) => Some(bytes),
            DataType::String(_) | DataType::OctetsWithStatus | DataType::Bit | DataType::BitArea => None,
        }
    }
}

impl PairType {
    /// Returns the length of the first value in bits.
    pub fn first_bits(&self) -> u32 {
        match self.first {
            Type::OctetString(Some(bytes)) => 8 * bytes,
            ty => ty.bits().unwrap_or(0),
        }
    }
}
