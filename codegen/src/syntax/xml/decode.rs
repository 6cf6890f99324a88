//! Resolves references and normalizes white space in attribute values and text.

use std::borrow::Cow;

use memchr::{memchr, memchr2};

use crate::diagnostics::{codes, Diagnostics};
use crate::source::Span;

/// The rule by which white space is normalized, including line ends.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Blanks {
    /// In text, line ends become LF.
    Text,
    /// In CDATA, line ends become LF and references are not resolved.
    Cdata,
    /// In attribute values, each white-space character and each line end becomes a space.
    Attribute,
}

pub(super) fn decode<'a>(raw: &'a str, span: Span, blanks: Blanks, diagnostics: &mut Diagnostics) -> Cow<'a, str> {
    let bytes = raw.as_bytes();
    let first = match blanks {
        Blanks::Attribute => bytes.iter().position(|byte| matches!(byte, b'&' | b'\n' | b'\t' | b'\r')),
        Blanks::Text => memchr2(b'&', b'\r', bytes),
        Blanks::Cdata => memchr(b'\r', bytes),
    };
    let Some(first) = first else { return Cow::Borrowed(raw) };
    let mut value = String::with_capacity(raw.len());
    value.push_str(&raw[..first]);
    let mut rest = &raw[first..];
    while let Some(c) = rest.chars().next() {
        let mut length = c.len_utf8();
        match c {
            '&' if blanks != Blanks::Cdata => {
                let (text, consumed) = reference_at(rest);
                length = consumed;
                match text {
                    Some(c) => value.push(c),
                    None => {
                        unknown_reference(&rest[..consumed], span, raw.len() - rest.len(), diagnostics);
                        value.push_str(&rest[..consumed]);
                    }
                }
            }
            '\r' => {
                length += usize::from(rest[1..].starts_with('\n'));
                value.push(if blanks == Blanks::Attribute { ' ' } else { '\n' });
            }
            '\n' | '\t' if blanks == Blanks::Attribute => value.push(' '),
            other => value.push(other),
        }
        rest = &rest[length..];
    }
    Cow::Owned(value)
}

/// Maximum number of bytes after an `&` in which `reference_at` searches for the end of an entity name.
const MAX_ENTITY_NAME: usize = 64;

/// Returns the character of the reference at the start of `text`, and the length of the reference. The character is `None` if the
/// reference is invalid or unknown. The length is 1 if the `&` does not start a reference.
fn reference_at(text: &str) -> (Option<char>, usize) {
    let name = text[1..].bytes().take(MAX_ENTITY_NAME).position(|byte| !byte.is_ascii_alphanumeric() && byte != b'#');
    let Some(length) = name.filter(|&length| length > 0 && text.as_bytes()[1 + length] == b';') else {
        return (None, 1);
    };
    let name = &text[1..1 + length];
    let number = |digits: &str, radix| {
        let code = if digits.starts_with('+') { None } else { u32::from_str_radix(digits, radix).ok() };
        code.and_then(char::from_u32).filter(|&c| c >= ' ' || matches!(c, '\t' | '\n' | '\r'))
    };
    let c = match name {
        "amp" => Some('&'),
        "lt" => Some('<'),
        "gt" => Some('>'),
        "quot" => Some('"'),
        "apos" => Some('\''),
        _ => match name.strip_prefix("#x") {
            Some(digits) => number(digits, 16),
            None => name.strip_prefix('#').and_then(|digits| number(digits, 10)),
        },
    };
    (c, length + 2)
}

fn unknown_reference(reference: &str, span: Span, offset: usize, diagnostics: &mut Diagnostics) {
    let start = span.start + offset as u32;
    let span = Span::new(span.file, start, start + reference.len() as u32);
    let (message, help) = match reference {
        "&" => ("this `&` does not start a reference".to_owned(), "write `&amp;` for the character `&`"),
        _ => (
            format!("`{reference}` is neither a predefined XML entity nor a valid character reference"),
            "write the character itself, or `&amp;` if the text contains `&`",
        ),
    };
    diagnostics.push(codes::ENTITY_REFERENCE.at(span, message).label("kept as text").help(help));
}
