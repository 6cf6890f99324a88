//! Reads the names of data types.

use crate::ir::Type;

/// Type that a type name denotes, and the number of elements of an array.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct NamedType {
    pub ty: Type,
    pub elements: Option<u32>,
}

/// Reads a type name: `u16`, `i32`, `f32`, `bool`, `str(25)`, `wstr(10)`, `bytes(6)`, `domain`, `?`, a time type, or an array
/// such as `u16[10]`.
pub(super) fn named(text: &str) -> Option<NamedType> {
    let text = text.trim();
    match text.strip_suffix(']').and_then(|rest| rest.split_once('[')) {
        Some((element, count)) => {
            let elements = count.trim().parse().ok().filter(|&count| count > 0)?;
            Some(NamedType { ty: single(element)?, elements: Some(elements) })
        }
        None => single(text).map(|ty| NamedType { ty, elements: None }),
    }
}

/// Reads the name of a type that is not an array.
pub(super) fn single(text: &str) -> Option<Type> {
    let text = text.trim();
    let (name, length) = match text.strip_suffix(')').and_then(|rest| rest.split_once('(')) {
        Some((name, length)) => (name, Some(length.trim().parse::<u32>().ok()?)),
        None => (text, None),
    };
    Some(match (name, length) {
        ("str", length) => Type::VisibleString(length),
        ("wstr", length) => Type::UnicodeString(length),
        ("bytes", length) => Type::OctetString(length),
        (_, Some(_)) => return None,
        ("bool", _) => Type::Boolean,
        ("f32", _) => Type::Real32,
        ("f64", _) => Type::Real64,
        ("time_of_day", _) => Type::TimeOfDay,
        ("time_difference", _) => Type::TimeDifference,
        ("domain", _) => Type::Domain,
        ("?", _) => Type::Opaque(None),
        (name, _) => {
            let bits = |digits: &str| digits.parse::<u8>().ok().filter(|bits| (1..=64).contains(bits));
            match name.split_at_checked(1)? {
                ("u", digits) => Type::Unsigned(bits(digits)?),
                ("i", digits) => Type::Integer(bits(digits)?),
                _ => return None,
            }
        }
    })
}

/// Returns the type name for another common name of a type, or the most similar type name.
pub(super) fn suggestion(text: &str) -> Option<&'static str> {
    let lower = text.to_lowercase().replace(['_', ' '], "");
    let (letters, digits) = lower.split_at(lower.find(|c: char| c.is_ascii_digit()).unwrap_or(lower.len()));
    let digits = digits.trim_end_matches('t');
    let of = |names: [&'static str; 4]| names.into_iter().find(|name| name[1..] == *digits);
    let usual = match (letters, digits) {
        ("uint" | "unsigned" | "unsignedint", _) => of(["u8", "u16", "u32", "u64"]),
        ("int" | "sint" | "s" | "signed" | "integer", _) => of(["i8", "i16", "i32", "i64"]),
        ("float" | "real" | "single", "" | "32") => Some("f32"),
        ("float" | "real", "64") | ("double" | "lreal", "") => Some("f64"),
        ("word", "") => Some("u16"),
        ("dword", "") => Some("u32"),
        ("boolean" | "bit" | "coil", "") => Some("bool"),
        ("string" | "text" | "ascii" | "char", _) => Some("str"),
        _ => None,
    };
    usual.or_else(|| crate::text::similar(text, NAMES.into_iter()))
}

/// Type names that suggestions and editors offer.
pub(super) const NAMES: [&str; 18] = [
    "bool",
    "u8",
    "u16",
    "u32",
    "u64",
    "i8",
    "i16",
    "i32",
    "i64",
    "f32",
    "f64",
    "str",
    "wstr",
    "bytes",
    "domain",
    "time_of_day",
    "time_difference",
    "?",
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_types() {
        let is = |text: &str, ty: Type| assert_eq!(named(text), Some(NamedType { ty, elements: None }), "{text}");
        is("u16", Type::Unsigned(16));
        is("i24", Type::Integer(24));
        is("str(25)", Type::VisibleString(Some(25)));
        is("bytes", Type::OctetString(None));
        is("?", Type::Opaque(None));
        assert_eq!(named("u16[10]"), Some(NamedType { ty: Type::Unsigned(16), elements: Some(10) }));
        let usual = [("uint16", "u16"), ("INT32", "i32"), ("uint16_t", "u16"), ("float", "f32"), ("boool", "bool")];
        for (text, name) in usual {
            assert_eq!(suggestion(text), Some(name), "{text}");
        }
        for text in ["", "u", "u0", "u65", "i", "u16(2)", "u16[0]", "u16[x]", "int", "é", "str(x)"] {
            assert_eq!(named(text), None, "{text}");
        }
    }
}
