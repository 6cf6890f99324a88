//! Names and numbers of the basic types in ETG.1000.6, and other names in real files.

use crate::ir::Type;

/// Meaning of a basic type name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Basic {
    /// A basic type of the IR.
    Type(Type),
    /// An array of this number of single bits (BITARR8).
    Bits(u8),
    /// An array `ARRAY [l..u] OF T`: lower bound, number of elements, and element type.
    Array(i32, u32, Type),
}

/// The relation of a name to the tables of ETG.1000.6.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Spelling {
    /// The name of the type in ETG.1000.6.
    Standard,
    /// A common name that is not in ETG.1000.6, such as `UINT16` for UINT.
    Alias,
    /// A name that begins with the name of a type or with an alias (`UINT_hex`, `Uint16_hex`).
    Prefix,
}

/// Returns the basic type with this name, and the spelling of the name.
pub fn basic(name: &str) -> Option<(Basic, Spelling)> {
    if let Some(ty) = standard(name) {
        return Some((Basic::Type(ty), Spelling::Standard));
    }
    if let Some(known) = with_parameter(name) {
        return Some((known, Spelling::Standard));
    }
    if let Some(ty) = alias(name) {
        return Some((Basic::Type(ty), Spelling::Alias));
    }
    let (start, _) = name.split_once('_')?;
    standard(start).or_else(|| alias(start)).map(|ty| (Basic::Type(ty), Spelling::Prefix))
}

fn standard(name: &str) -> Option<Type> {
    Some(match name {
        "BOOL" | "BIT" => Type::Boolean,
        "SINT" => Type::Integer(8),
        "INT" => Type::Integer(16),
        "DINT" => Type::Integer(32),
        "LINT" => Type::Integer(64),
        "USINT" | "BYTE" => Type::Unsigned(8),
        "UINT" | "WORD" => Type::Unsigned(16),
        "UDINT" | "DWORD" => Type::Unsigned(32),
        "ULINT" | "LWORD" => Type::Unsigned(64),
        "REAL" => Type::Real32,
        "LREAL" => Type::Real64,
        "STRING" => Type::VisibleString(None),
        "OCTET_STRING" => Type::OctetString(None),
        "UNICODE_STRING" | "WSTRING" => Type::UnicodeString(None),
        "TIME_OF_DAY" => Type::TimeOfDay,
        "TIME_DIFFERENCE" => Type::TimeDifference,
        "DOMAIN" => Type::Domain,
        "GUID" => Type::OctetString(Some(16)),
        _ => return None,
    })
}

/// Returns the name of a type in ETG.1000.6, or in CiA 301 if ETG.1000.6 has none.
pub fn name_of(ty: Type) -> String {
    const NAMES: [&str; 16] = [
        "BOOL",
        "SINT",
        "INT",
        "DINT",
        "LINT",
        "USINT",
        "UINT",
        "UDINT",
        "ULINT",
        "REAL",
        "LREAL",
        "STRING",
        "OCTET_STRING",
        "UNICODE_STRING",
        "TIME_OF_DAY",
        "TIME_DIFFERENCE",
    ];
    NAMES.into_iter().find(|name| standard(name) == Some(ty)).map_or_else(|| ty.to_string(), str::to_owned)
}

/// Reads names that contain a number, such as BITn, BITARRn, INT24, STRING(n) and ARRAY [l..u] OF T.
fn with_parameter(name: &str) -> Option<Basic> {
    if let Some(bits) = name.strip_prefix("BITARR") {
        return width(bits).map(Basic::Bits);
    }
    if let Some(bits) = name.strip_prefix("BIT") {
        return width(bits).map(|bits| Basic::Type(Type::Unsigned(bits)));
    }
    if let Some(length) = name.strip_prefix("STRING") {
        return length_of(length).map(|length| Basic::Type(Type::VisibleString(Some(length))));
    }
    if let Some(length) = name.strip_prefix("OCTET_STRING") {
        return length_of(length).map(|length| Basic::Type(Type::OctetString(Some(length))));
    }
    let wide = name.strip_prefix("WSTRING").or_else(|| name.strip_prefix("UNICODE_STRING"));
    if let Some(length) = wide {
        return length_of(length).map(|length| Basic::Type(Type::UnicodeString(Some(length))));
    }
    // The names of ETG.1000.6 for 8, 16, 32 and 64 bits contain no number (`USINT`, `UINT`), so only the other widths are read
    // here.
    if let Some(bits @ (24 | 40 | 48 | 56)) = name.strip_prefix("UINT").and_then(width) {
        return Some(Basic::Type(Type::Unsigned(bits)));
    }
    if let Some(bits @ (24 | 40 | 48 | 56)) = name.strip_prefix("INT").and_then(width) {
        return Some(Basic::Type(Type::Integer(bits)));
    }
    array(name)
}

fn width(digits: &str) -> Option<u8> {
    let plain = digits.bytes().all(|byte| byte.is_ascii_digit());
    digits.parse().ok().filter(|bits| plain && (1..=64).contains(bits))
}

/// Returns the number in a text such as `(12)`.
fn length_of(text: &str) -> Option<u32> {
    text.trim().strip_prefix('(')?.strip_suffix(')')?.trim().parse().ok()
}

fn array(name: &str) -> Option<Basic> {
    let (bounds, element) = name.strip_prefix("ARRAY")?.trim_start().strip_prefix('[')?.split_once(']')?;
    let (low, high) = bounds.split_once("..")?;
    let (low, high): (i32, i32) = (low.trim().parse().ok()?, high.trim().parse().ok()?);
    let count = u32::try_from(i64::from(high) - i64::from(low) + 1).ok().filter(|&count| count > 0)?;
    let element = element.trim();
    let element = element.strip_prefix("OF").or_else(|| element.strip_prefix("of"))?.trim();
    Some(match (element, standard(element).or_else(|| alias(element))?) {
        // ETG.1000.6 writes an octet string as an array of BYTE.
        ("BYTE", _) => Basic::Type(Type::OctetString(Some(count))),
        (_, ty) => Basic::Array(low, count, ty),
    })
}

/// Returns the type with a common name of CiA 301 or C. Ignores case.
fn alias(name: &str) -> Option<Type> {
    let upper = name.to_ascii_uppercase();
    let plain = upper.strip_suffix("_T").unwrap_or(&upper);
    if let Some(bits) = plain.strip_prefix("UINT").or_else(|| plain.strip_prefix("UNSIGNED")).and_then(width) {
        return Some(Type::Unsigned(bits));
    }
    if let Some(bits) = plain.strip_prefix("INT").or_else(|| plain.strip_prefix("INTEGER")).and_then(width) {
        return Some(Type::Integer(bits));
    }
    Some(match plain {
        "BOOLEAN" => Type::Boolean,
        "REAL32" | "FLOAT" | "FLOAT32" => Type::Real32,
        "REAL64" | "DOUBLE" | "FLOAT64" => Type::Real64,
        "VISIBLE_STRING" => Type::VisibleString(None),
        _ => return standard(plain).filter(|_| plain != name),
    })
}

/// Returns the basic type with this number in ETG.1000.6. Numbers up to 0x1B have the same meaning in CiA 301; greater
/// numbers have another meaning or none.
pub fn by_code(code: u32) -> Option<Basic> {
    Some(match code {
        0x1D => Basic::Type(Type::OctetString(Some(16))),
        0x1E => Basic::Type(Type::Unsigned(8)),
        0x1F => Basic::Type(Type::Unsigned(16)),
        0x20 => Basic::Type(Type::Unsigned(32)),
        0x2D => Basic::Bits(8),
        0x2E => Basic::Bits(16),
        0x2F => Basic::Bits(32),
        0x30..=0x3F => Basic::Type(Type::Unsigned((code - 0x2F) as u8)),
        0x01..=0x1B => return Type::from_cia301(code).map(Basic::Type),
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ty(name: &str) -> Option<Type> {
        match basic(name)? {
            (Basic::Type(ty), _) => Some(ty),
            _ => None,
        }
    }

    #[test]
    fn names_of_the_tables_and_others() {
        assert_eq!(ty("BOOL"), Some(Type::Boolean));
        assert_eq!(ty("BIT3"), Some(Type::Unsigned(3)));
        assert_eq!(ty("STRING(16)"), Some(Type::VisibleString(Some(16))));
        assert_eq!(ty("INT24"), Some(Type::Integer(24)));
        assert_eq!(ty("ARRAY [0..29] OF BYTE"), Some(Type::OctetString(Some(30))));
        assert_eq!(basic("BITARR8"), Some((Basic::Bits(8), Spelling::Standard)));
        assert_eq!(basic("ARRAY [1..4] OF UINT"), Some((Basic::Array(1, 4, Type::Unsigned(16)), Spelling::Standard)));
        for (name, expected) in
            [("UINT16", Type::Unsigned(16)), ("uint8_t", Type::Unsigned(8)), ("Boolean", Type::Boolean)]
        {
            assert_eq!(basic(name), Some((Basic::Type(expected), Spelling::Alias)), "{name}");
        }
        assert_eq!(basic("UINT_hex"), Some((Basic::Type(Type::Unsigned(16)), Spelling::Prefix)));
        for name in ["", "UIN", "DT1018", "BIT0", "BIT65", "BITARR+8", "STRING(x)", "ARRAY [3..1] OF BYTE", "ARRAY ["] {
            assert_eq!(basic(name), None, "{name}");
        }
    }

    #[test]
    fn numbers_are_those_of_ethercat() {
        assert_eq!(by_code(0x07), Some(Basic::Type(Type::Unsigned(32))));
        assert_eq!(by_code(0x1E), Some(Basic::Type(Type::Unsigned(8))));
        assert_eq!(by_code(0x20), Some(Basic::Type(Type::Unsigned(32))));
        assert_eq!(by_code(0x30), Some(Basic::Type(Type::Unsigned(1))));
        assert_eq!(by_code(0x3F), Some(Basic::Type(Type::Unsigned(16))));
        assert_eq!(by_code(0x2E), Some(Basic::Bits(16)));
        assert_eq!(by_code(0x23), None);
    }
}
