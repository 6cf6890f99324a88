//! Converts TOML values to the types of `format`.

use super::at::{At, Entries, FlagOr, Literal, OneOrMany, TextOr};
pub(super) use super::document::Node;
use super::document::{Key, Table, Value};
use crate::text::brief;

/// Type that can be read from a TOML value.
pub(super) trait Read: Sized {
    /// Reads a TOML value as this type.
    fn read(node: &Node<'_>) -> Result<Self, Mistake>;
}

/// Error in a TOML value.
#[derive(Debug)]
pub(super) struct Mistake {
    /// Byte range of the error in the file.
    pub range: (u32, u32),
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
    /// Creates the error for a value that is not `expected`.
    pub fn expected(node: &Node<'_>, expected: &str) -> Self {
        let found = match &node.value {
            Value::Text(text) => format!("the text `{}`", brief(text)),
            Value::Integer(digits, radix) => format!("the number {}", decimal(digits, *radix)),
            Value::Float(number) => format!("the number {number}"),
            Value::Boolean(flag) => format!("`{flag}`"),
            Value::Date => "a date or time".to_owned(),
            Value::List(_) => "a list".to_owned(),
            Value::Table(_) => "a table".to_owned(),
        };
        Mistake::value(node, format!("expected {expected}, but found {found}"))
    }

    pub fn value(node: &Node<'_>, message: String) -> Self {
        Mistake { range: (node.start, node.end), kind: MistakeKind::Value(message) }
    }

    pub fn unknown_key(key: &Key<'_>, known: &'static [&'static str]) -> Self {
        Mistake { range: (key.start, key.end), kind: MistakeKind::UnknownKey { key: key.value.to_string(), known } }
    }
}

/// Returns the entries of a table, or an error for any other value.
pub(super) fn table<'n, 'a>(node: &'n Node<'a>) -> Result<&'n Table<'a>, Mistake> {
    match &node.value {
        Value::Table(table) => Ok(table),
        _ => Err(Mistake::expected(node, "a table")),
    }
}

/// Returns a key of a table with its span.
pub(super) fn key(key: &Key<'_>) -> At<String> {
    At { value: key.value.to_string(), start: key.start, end: key.end }
}

fn integer(digits: &str, radix: u32) -> Option<i128> {
    i128::from_str_radix(digits, radix).ok()
}

/// Returns an integer in decimal notation, or its digits if it has more than 128 bits.
fn decimal(digits: &str, radix: u32) -> String {
    integer(digits, radix).map_or_else(|| digits.to_owned(), |number| number.to_string())
}

/// Returns a TOML value as a number, or `None` if it is not a number.
pub(super) fn number(node: &Node<'_>) -> Option<f64> {
    match &node.value {
        Value::Integer(digits, radix) => integer(digits, *radix).map(|number| number as f64),
        Value::Float(number) => number.parse().ok(),
        _ => None,
    }
}

macro_rules! integers {
    ($($ty:ident)*) => {$(
        impl Read for $ty {
            fn read(node: &Node<'_>) -> Result<Self, Mistake> {
                let value = match &node.value {
                    Value::Integer(digits, radix) => integer(digits, *radix).and_then(|number| number.try_into().ok()),
                    _ => None,
                };
                value.ok_or_else(|| Mistake::expected(node, &format!("an integer from {} to {}", $ty::MIN, $ty::MAX)))
            }
        }
    )*};
}
integers!(u8 u16 u32 u64 i64);

impl Read for f64 {
    fn read(node: &Node<'_>) -> Result<Self, Mistake> {
        number(node).ok_or_else(|| Mistake::expected(node, "a number"))
    }
}

impl Read for bool {
    fn read(node: &Node<'_>) -> Result<Self, Mistake> {
        match &node.value {
            Value::Boolean(flag) => Ok(*flag),
            _ => Err(Mistake::expected(node, "true or false")),
        }
    }
}

impl Read for String {
    fn read(node: &Node<'_>) -> Result<Self, Mistake> {
        match &node.value {
            Value::Text(text) => Ok(text.to_string()),
            _ => Err(Mistake::expected(node, "a text")),
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
        match &node.value {
            Value::List(list) => list.iter().map(T::read).collect(),
            _ => Err(Mistake::expected(node, "a list")),
        }
    }
}

impl<T: Read> Read for At<T> {
    fn read(node: &Node<'_>) -> Result<Self, Mistake> {
        Ok(At { value: T::read(node)?, start: node.start, end: node.end })
    }
}

impl<T: Read> Read for Entries<T> {
    fn read(node: &Node<'_>) -> Result<Self, Mistake> {
        let entries = table(node)?.iter().map(|(key, value)| Ok((self::key(key), At::read(value)?)));
        entries.collect::<Result<_, Mistake>>().map(Entries)
    }
}

impl<T: Read> Read for OneOrMany<T> {
    fn read(node: &Node<'_>) -> Result<Self, Mistake> {
        match &node.value {
            Value::List(list) => list.iter().map(T::read).collect::<Result<_, _>>().map(OneOrMany),
            _ => T::read(node).map(|value| OneOrMany(vec![value])),
        }
    }
}

impl<T: Read> Read for TextOr<T> {
    fn read(node: &Node<'_>) -> Result<Self, Mistake> {
        match &node.value {
            Value::Text(text) => Ok(TextOr::Text(text.to_string())),
            Value::Table(_) => T::read(node).map(|table| TextOr::Table(Box::new(table))),
            _ => Err(Mistake::expected(node, "a text or a table")),
        }
    }
}

impl<T: Read> Read for FlagOr<T> {
    fn read(node: &Node<'_>) -> Result<Self, Mistake> {
        match &node.value {
            Value::Boolean(flag) => Ok(FlagOr::Flag(*flag)),
            Value::Table(_) => T::read(node).map(|table| FlagOr::Table(Box::new(table))),
            _ => Err(Mistake::expected(node, "true, false or a table")),
        }
    }
}

/// Returns a TOML value as a literal, or `None` if it is a date, a list, a table, or an integer of more than 128 bits.
pub(super) fn literal(node: &Node<'_>) -> Option<Literal> {
    match &node.value {
        Value::Boolean(flag) => Some(Literal::Bool(*flag)),
        Value::Integer(digits, radix) => integer(digits, *radix).map(Literal::Int),
        Value::Float(_) => number(node).map(Literal::Real),
        Value::Text(text) => Some(Literal::Text(text.to_string())),
        _ => None,
    }
}

impl Read for Literal {
    fn read(node: &Node<'_>) -> Result<Self, Mistake> {
        literal(node).ok_or_else(|| Mistake::expected(node, "a number, a text, true or false"))
    }
}
