//! Reads TOML.

use std::ops::Range;

use lexibus_codegen::source::{FileId, Source, Span};
use toml::de::{DeTable, DeValue};
use toml::Spanned;

use super::tree::{At, Content, Entry, Node, Scalar, SyntaxError};

/// Parses a TOML file.
///
/// # Errors
///
/// Returns the first syntax error.
pub fn parse(source: &Source, file: FileId) -> Result<Node, SyntaxError> {
    let span = |range: Range<usize>| Span::new(file, range.start as u32, range.end as u32);
    match DeTable::parse(source.text()) {
        Ok(table) => {
            let whole = span(table.span());
            Ok(Node { span: whole, content: entries(table.get_ref(), &span) })
        }
        Err(error) => {
            let message = error.message().lines().next().unwrap_or("invalid TOML").to_owned();
            Err(SyntaxError { span: error.span().map_or(span(0..0), span), message })
        }
    }
}

fn node(value: &Spanned<DeValue<'_>>, span: &dyn Fn(Range<usize>) -> Span) -> Node {
    let content = match value.get_ref() {
        DeValue::Array(list) => Content::List(list.iter().map(|element| node(element, span)).collect()),
        DeValue::Table(table) => entries(table, span),
        scalar => Content::Scalar(self::scalar(scalar)),
    };
    Node { span: span(value.span()), content }
}

fn entries(table: &DeTable<'_>, span: &dyn Fn(Range<usize>) -> Span) -> Content {
    let entry = |(key, value): (&Spanned<std::borrow::Cow<'_, str>>, &Spanned<DeValue<'_>>)| Entry {
        key: At::new(key.get_ref().to_string(), span(key.span())),
        value: node(value, span),
    };
    let mut list: Vec<Entry> = table.iter().map(entry).collect();
    // The parser sorts entries by name, so the order of the file must be restored.
    list.sort_by_key(|entry| entry.key.span.start);
    Content::Table(list)
}

fn scalar(value: &DeValue<'_>) -> Scalar {
    match value {
        DeValue::Boolean(flag) => Scalar::Bool(*flag),
        DeValue::Integer(number) => match i128::from_str_radix(number.as_str(), number.radix()) {
            Ok(number) => Scalar::Integer(number),
            Err(_) => Scalar::Text(number.to_string()),
        },
        DeValue::Float(number) => number.as_str().parse().map_or(Scalar::Null, Scalar::Real),
        DeValue::String(text) => Scalar::Text(text.to_string()),
        DeValue::Datetime(time) => Scalar::Text(time.to_string()),
        DeValue::Array(_) | DeValue::Table(_) => Scalar::Null,
    }
}
