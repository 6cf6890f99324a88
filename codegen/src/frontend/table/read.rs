//! Converts TOML values to the types of `format`.

use std::ops::Range;

use serde_spanned::Spanned;
use toml::de::{DeInteger, DeString, DeTable, DeValue};

use super::at::{At, Entries, FlagOr, Literal, OneOrMany, TextOr};

/// TOML value with its byte range.
pub(super) type Node<'a> = Spanned<DeValue<'a>>;

/// Type that can be read from a TOML value.
pub(super) trait Read: Sized {
    /// Reads a TOML value as this type.
    fn read(node: &Node<'_>) -> Result<Self, Mistake>;
}

/// Error in a TOML value.
#[derive(Debug)]
pub(super) struct Mistake {
    /// Byte range of the error in the file.
    pub span: Range<usize>,
    pub kind: MistakeKind,
}

#[derive(Debug)]
pub(super) enum MistakeKind {
    /// Unknown key, and the keys that the table can have.
    UnknownKey { key: String, known: &'static [&'static str] },
    /// Any other error, as a message.
    Value(String),
}

impl Mistake {
    /// Creates the error for a value of the wrong type.
    pub fn ty(node: &Node<'_>, expected: &str) -> Self {
        let found = match node.get_ref() {
            DeValue::String(text) => format!("string {text:?}"),
            DeValue::Integer(number) => format!("integer `{}`", decimal(number)),
            DeValue::Float(number) => format!("floating point `{}`", number.as_str()),
            DeValue::Boolean(flag) => format!("boolean `{flag}`"),
            DeValue::Datetime(_) => "date or time".to_owned(),
            DeValue::Array(_) => "sequence".to_owned(),
            DeValue::Table(_) => "map".to_owned(),
        };
        Mistake::value(node, format!("invalid type: {found}, expected {expected}"))
    }

    pub fn value(node: &Node<'_>, message: String) -> Self {
        Mistake { span: node.span(), kind: MistakeKind::Value(message) }
    }

    pub fn unknown_key(key: &Spanned<DeString<'_>>, known: &'static [&'static str]) -> Self {
        let span = key.span();
        Mistake { span, kind: MistakeKind::UnknownKey { key: key.get_ref().to_string(), known } }
    }
}

/// Returns the entries of a table, or an error for any other value. `expected` describes the expected table in the
/// error message.
pub(super) fn table<'n, 'a>(node: &'n Node<'a>, expected: &str) -> Result<&'n DeTable<'a>, Mistake> {
    match node.get_ref() {
        DeValue::Table(table) => Ok(table),
        _ => Err(Mistake::ty(node, expected)),
    }
}

/// Returns a key of a table with its span.
pub(super) fn key(key: &Spanned<DeString<'_>>) -> At<String> {
    let span = key.span();
    At { value: key.get_ref().to_string(), start: span.start as u32, end: span.end as u32 }
}

fn integer(number: &DeInteger<'_>) -> Option<i128> {
    i128::from_str_radix(number.as_str(), number.radix()).ok()
}

fn decimal(number: &DeInteger<'_>) -> String {
    integer(number).map_or_else(|| number.to_string(), |number| number.to_string())
}

/// Returns a TOML value as a number, or `None` if it is not a number.
pub(super) fn number(node: &Node<'_>) -> Option<f64> {
    match node.get_ref() {
        DeValue::Integer(number) => integer(number).map(|number| number as f64),
        DeValue::Float(number) => number.as_str().parse().ok(),
        _ => None,
    }
}

macro_rules! integers {
    ($($ty:ident)*) => {$(
        impl Read for $ty {
            fn read(node: &Node<'_>) -> Result<Self, Mistake> {
                let DeValue::Integer(number) = node.get_ref() else { return Err(Mistake::ty(node, stringify!($ty))) };
                integer(number).and_then(|number| number.try_into().ok()).ok_or_else(|| {
                    let message = format!("invalid value: integer `{}`, expected {}", decimal(number), stringify!($ty));
                    Mistake::value(node, message)
                })
            }
        }
    )*};
}
integers!(u8 u16 u32 u64 i64);

impl Read for f64 {
    fn read(node: &Node<'_>) -> Result<Self, Mistake> {
        number(node).ok_or_else(|| Mistake::ty(node, "f64"))
    }
}

impl Read for bool {
    fn read(node: &Node<'_>) -> Result<Self, Mistake> {
        match node.get_ref() {
            DeValue::Boolean(flag) => Ok(*flag),
            _ => Err(Mistake::ty(node, "a boolean")),
        }
    }
}

impl Read for String {
    fn read(node: &Node<'_>) -> Result<Self, Mistake> {
        match node.get_ref() {
            DeValue::String(text) => Ok(text.to_string()),
            _ => Err(Mistake::ty(node, "a string")),
        }
    }
}

impl<T: Read> Read for Option<T> {
    fn read(node: &Node<'_>) -> Result<Self, Mistake> {
        T::read(node).map(Some)
    }
}

impl<T: Read> Read for Vec<T> {
    fn read(node: &Node<'_>) -> Result<Self, Mistake> {
        match node.get_ref() {
            DeValue::Array(list) => list.iter().map(T::read).collect(),
            _ => Err(Mistake::ty(node, "a sequence")),
        }
    }
}

impl<T: Read> Read for At<T> {
    fn read(node: &Node<'_>) -> Result<Self, Mistake> {
        let span = node.span();
        Ok(At { value: T::read(node)?, start: span.start as u32, end: span.end as u32 })
    }
}

impl<T: Read> Read for Entries<T> {
    fn read(node: &Node<'_>) -> Result<Self, Mistake> {
        let entry = |(key, value): (&Spanned<DeString<'_>>, &Node<'_>)| Ok((self::key(key), At::read(value)?));
        let mut list = table(node, "a table")?.iter().map(entry).collect::<Result<Vec<_>, Mistake>>()?;
        // The parser sorts entries by name, so the order of the file must be restored.
        list.sort_by_key(|(key, _)| key.start);
        Ok(Entries(list))
    }
}

impl<T: Read> Read for OneOrMany<T> {
    fn read(node: &Node<'_>) -> Result<Self, Mistake> {
        match node.get_ref() {
            DeValue::Array(list) => list.iter().map(T::read).collect::<Result<_, _>>().map(OneOrMany),
            _ => T::read(node).map(|value| OneOrMany(vec![value])),
        }
    }
}

impl<T: Read> Read for TextOr<T> {
    fn read(node: &Node<'_>) -> Result<Self, Mistake> {
        match node.get_ref() {
            DeValue::String(text) => Ok(TextOr::Text(text.to_string())),
            DeValue::Table(_) => T::read(node).map(|table| TextOr::Table(Box::new(table))),
            _ => Err(Mistake::ty(node, "a text or a table")),
        }
    }
}

impl<T: Read> Read for FlagOr<T> {
    fn read(node: &Node<'_>) -> Result<Self, Mistake> {
        match node.get_ref() {
            DeValue::Boolean(flag) => Ok(FlagOr::Flag(*flag)),
            DeValue::Table(_) => T::read(node).map(|table| FlagOr::Table(Box::new(table))),
            _ => Err(Mistake::ty(node, "true, false or a table")),
        }
    }
}

/// Returns a TOML value as a literal, or `None` if it is a date, a list, a table, or an integer of more than 128 bits.
pub(super) fn literal(node: &Node<'_>) -> Option<Literal> {
    match node.get_ref() {
        DeValue::Boolean(flag) => Some(Literal::Bool(*flag)),
        DeValue::Integer(number) => integer(number).map(Literal::Int),
        DeValue::Float(_) => number(node).map(Literal::Real),
        DeValue::String(text) => Some(Literal::Text(text.to_string())),
        _ => None,
    }
}

impl Read for Literal {
    fn read(node: &Node<'_>) -> Result<Self, Mistake> {
        literal(node).ok_or_else(|| Mistake::ty(node, "a number, a text, true or false"))
    }
}
