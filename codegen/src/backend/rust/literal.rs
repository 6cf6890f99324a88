//! Formats values as Rust literals. Texts are escaped, so that a quotation mark in a description cannot end a literal.

use crate::number::hex16;
use std::fmt::Write;

/// Returns a hexadecimal literal of a 32-bit number, with a separator between its two 16-bit halves: `0x6040_0010`.
pub(super) fn word(number: impl Into<i128>) -> String {
    let number = number.into();
    format!("{}_{:04X}", hex16(number >> 16), number & 0xFFFF)
}

/// Returns a string literal. Escapes quotation marks, backslashes, and characters that could mislead a reader or
/// control a terminal.
pub(super) fn string(text: &str) -> String {
    let mut literal = String::with_capacity(text.len() + 2);
    literal.push('"');
    for letter in text.chars() {
        match letter {
            '"' => literal.push_str("\\\""),
            '\\' => literal.push_str("\\\\"),
            '\n' => literal.push_str("\\n"),
            '\r' => literal.push_str("\\r"),
            '\t' => literal.push_str("\\t"),
            ' '..='~' => literal.push(letter),
            _ if is_harmless(letter) => literal.push(letter),
            _ => {
                let _ = write!(literal, "\\u{{{:x}}}", u32::from(letter));
            }
        }
    }
    literal.push('"');
    literal
}

/// Returns a byte string literal in which each byte is an escape sequence.
pub(super) fn bytes(bytes: &[u8]) -> String {
    let mut literal = String::with_capacity(bytes.len() * 4 + 3);
    literal.push_str("b\"");
    for byte in bytes {
        let _ = write!(literal, "\\x{byte:02x}");
    }
    literal.push('"');
    literal
}

/// Returns a byte string literal. It contains the characters of the text if all are printable ASCII characters. Otherwise, it
/// contains an escape sequence for each byte.
pub(super) fn text_bytes(text: &[u8]) -> String {
    match std::str::from_utf8(text) {
        Ok(text) if text.bytes().all(|byte| matches!(byte, b' '..=b'~')) => format!("b{}", string(text)),
        _ => bytes(text),
    }
}

/// Returns whether a character is a letter or digit of any script, a space, or a visible sign. Signs that change how
/// other characters are displayed are left out.
pub(super) fn is_harmless(letter: char) -> bool {
    letter.is_ascii_graphic() || letter == ' ' || letter.is_alphanumeric() || is_sign(letter)
}

/// Returns whether a character is in a Unicode block of punctuation, currency signs, superscripts, arrows, or
/// mathematical or technical symbols. Spaces, soft hyphens, combining marks and characters without a width are left
/// out.
fn is_sign(letter: char) -> bool {
    matches!(letter,
        '\u{a1}'..='\u{ac}' | '\u{ae}'..='\u{bf}' | '×' | '÷'
        | '\u{2010}'..='\u{2027}' | '\u{2030}'..='\u{205e}' | '\u{2070}'..='\u{20cf}' | '\u{2100}'..='\u{2bff}'
        | '\u{3001}'..='\u{3029}' | '\u{3030}'..='\u{303f}' | '\u{ff01}'..='\u{ff65}')
}

/// Returns a REAL32 or REAL64 literal. Returns `None` if the type cannot represent the number.
pub(super) fn real(value: f64, bits: u32) -> Option<String> {
    if bits == 32 {
        let value = value as f32;
        return value.is_finite().then(|| format!("{value:?}"));
    }
    value.is_finite().then(|| format!("{value:?}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn signs_are_harmless_unless_they_are_invisible() {
        assert!("10⁻³ s, Ω, °C, µs, ½, ®, ≥ 5 €, “x”, （１）、√2 → ✓".chars().all(is_harmless));
        let invisible = "\n\t\u{a0}\u{ad}\u{300}\u{200b}\u{200e}\u{2028}\u{202e}\u{2060}\u{2066}\u{20dd}\u{3000}\u{fe0f}\u{feff}\u{fffd}";
        assert!(!invisible.chars().any(is_harmless));
    }

    #[test]
    fn text_cannot_end_a_literal() {
        assert_eq!(string("a\"\\\n\u{202e}\u{7f}ü"), r#""a\"\\\n\u{202e}\u{7f}ü""#);
        assert_eq!(bytes(b"\0\"\xff"), r#"b"\x00\x22\xff""#);
        assert_eq!(text_bytes(b"a\"\\b"), r#"b"a\"\\b""#);
        assert_eq!(text_bytes("µ".as_bytes()), r#"b"\xc2\xb5""#);
        assert_eq!(text_bytes(b"\n"), r#"b"\x0a""#);
        assert_eq!(real(0.1, 32).as_deref(), Some("0.1"));
        assert_eq!(real(3.402823e38, 32).as_deref(), Some("3.402823e38"));
        assert_eq!(real(1e300, 32), None);
        assert_eq!(real(5.0, 64).as_deref(), Some("5.0"));
    }
}
