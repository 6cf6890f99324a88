//! Reads the numbers of ETG.2000 (HexDecValue), including nonstandard spellings in real files.

use super::reader::Reader;
use crate::diagnostics::codes;
use crate::frontend::xml::{Given, Read};
use crate::number::hex;
use crate::syntax::xml::Tag;
use crate::text::brief;

/// Value of a number, and facts about its notation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Number {
    pub value: i128,
    /// True if the number is hexadecimal and has no sign.
    pub hex: bool,
    /// Deviation of the notation from ETG.2000.
    pub fault: Option<Fault>,
}

/// A nonstandard notation that occurs in real files.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Fault {
    /// Hexadecimal digits without `#x`.
    Bare,
    /// Two prefixes: `#x0x6041`.
    TwoPrefixes,
}

/// Reads decimal digits, or hexadecimal digits after `#x`, `0x` or both. Digits without a prefix are hexadecimal if one
/// of them is a letter. A sign may precede decimal digits, or hexadecimal digits with one prefix.
pub(super) fn parse(text: &str) -> Option<Number> {
    let bytes = text.as_bytes();
    if let Some(value) = decimal(bytes) {
        return Some(Number { value: i128::from(value), hex: false, fault: None });
    }
    let (digits, fault) = match bytes {
        [b'-', rest @ ..] => return signed(rest).map(|value| Number { value: -value, hex: false, fault: None }),
        [b'+', rest @ ..] => return signed(rest).map(|value| Number { value, hex: false, fault: None }),
        _ => match prefixed(bytes).map(|rest| (rest, prefixed(rest))) {
            Some((_, Some(digits))) => (digits, Some(Fault::TwoPrefixes)),
            Some((digits, None)) => (digits, None),
            None => (bytes, Some(Fault::Bare)),
        },
    };
    hexadecimal(digits).map(|value| Number { value, hex: true, fault })
}

/// Reads the text after the sign of a number: decimal digits, or hexadecimal digits with a prefix.
fn signed(bytes: &[u8]) -> Option<i128> {
    match prefixed(bytes) {
        Some(digits) => hexadecimal(digits),
        None => decimal(bytes).map(i128::from),
    }
}

fn prefixed(bytes: &[u8]) -> Option<&[u8]> {
    match bytes {
        [b'#' | b'0', b'x' | b'X', digits @ ..] => Some(digits),
        _ => None,
    }
}

/// Reads an unsigned decimal number. Returns `None` for any other text, and for a number with more than 64 bits, which
/// no field can contain.
fn decimal(digits: &[u8]) -> Option<u64> {
    if digits.is_empty() {
        return None;
    }
    digits.iter().try_fold(0u64, |value, &digit| {
        let digit = digit.wrapping_sub(b'0');
        if digit > 9 {
            return None;
        }
        value.checked_mul(10)?.checked_add(u64::from(digit))
    })
}

fn hexadecimal(digits: &[u8]) -> Option<i128> {
    // Leading zeros do not count toward the maximum of 16 digits.
    let zeros = digits.iter().take_while(|&&digit| digit == b'0').count();
    if digits.is_empty() || digits.len() - zeros > 16 {
        return None;
    }
    let value = digits.iter().try_fold(0u64, |value, &digit| Some(value << 4 | u64::from(nibble(digit)?)))?;
    Some(i128::from(value))
}

/// Returns the value of a hexadecimal digit.
pub(super) fn nibble(digit: u8) -> Option<u8> {
    match digit {
        b'0'..=b'9' => Some(digit - b'0'),
        b'a'..=b'f' => Some(digit - b'a' + 10),
        b'A'..=b'F' => Some(digit - b'A' + 10),
        _ => None,
    }
}

impl<'a> Reader<'a, '_> {
    /// Reads a number in any notation, and reports nonstandard notations. Returns `None` for a text that is not a
    /// number, which the caller reports.
    pub fn parse(&mut self, given: &Given<'_>) -> Option<Number> {
        let number = parse(&given.text)?;
        if let Some(fault) = number.fault {
            let text = brief(&given.text);
            let (code, message, fix) = match fault {
                Fault::Bare => (
                    &codes::BARE_HEX,
                    format!("`{text}` has hexadecimal digits, but no prefix `#x`"),
                    format!("#x{}", given.text),
                ),
                Fault::TwoPrefixes => {
                    (&codes::ESI_VALUE, format!("`{text}` has two prefixes"), format!("#x{}", &given.text[4..]))
                }
            };
            let found = code.at(given.span, message).label(format!("read as {}", hex(number.value)));
            self.diagnostics.push(found.fix(fix));
        }
        Some(number)
    }

    /// Reads a number of type `T`. Returns `None` for an empty text. Also returns `None` and reports the text if it is not a
    /// number, or if the number does not fit `T`.
    pub fn int<T: TryFrom<i128>>(&mut self, given: &Given<'_>, what: &str) -> Option<T> {
        if given.is_empty() {
            return None;
        }
        let Some(number) = self.parse(given) else {
            self.bad(given, what, "left out; expected a decimal number or `#x` and hexadecimal digits");
            return None;
        };
        let value = T::try_from(number.value).ok();
        if value.is_none() {
            self.bad(given, what, "left out; the number is too large or negative");
        }
        value
    }

    /// Reads an element that contains a number. Errors are handled as in [`int`](Self::int).
    pub fn number<T: TryFrom<i128>>(&mut self, tag: &Tag<'a>, what: &str) -> Read<Option<T>> {
        let given = self.text(tag)?;
        Ok(self.int(&given, what))
    }

    /// Reads an element that contains a Boolean value. Returns `None` if the element is empty.
    pub fn flag_of(&mut self, tag: &Tag<'a>) -> Read<Option<bool>> {
        let given = self.text(tag)?;
        Ok(self.optional_flag(&given))
    }

    /// Reads bytes in hexadecimal notation, ignoring white space. Returns `None` and reports the text if it contains any other
    /// character. Reports an odd number of digits, and reads the first byte from one digit.
    pub fn octets(&mut self, given: &Given<'_>) -> Option<Vec<u8>> {
        let digits = given.text.bytes().filter(|byte| !byte.is_ascii_whitespace());
        let count = digits.clone().count();
        let mut octets = Vec::with_capacity(count / 2 + 1);
        let mut high = None;
        // The first byte has only one digit if the number of digits is odd.
        if count % 2 == 1 {
            high = Some(0);
        }
        for digit in digits {
            let Some(digit) = nibble(digit) else {
                self.bad(given, "string of hexadecimal digits", "left out");
                return None;
            };
            match high.take() {
                Some(high) => octets.push(high << 4 | digit),
                None => high = Some(digit),
            }
        }
        if count % 2 == 1 {
            let found = codes::ODD_HEX.at(given.span, "the number of hexadecimal digits is odd");
            self.diagnostics.push(found.label("read with a leading zero").fix(format!("0{}", given.text)));
        }
        Some(octets)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_spelling() {
        let int = |text| parse(text).map(|number| number.value);
        for (text, value) in [("#x1A", 26), ("0x1a", 26), ("26", 26), ("01", 1), ("-9999", -9999), ("+7", 7)] {
            assert_eq!(int(text), Some(value), "{text}");
        }
        assert_eq!(int("18446744073709551615"), Some(u64::MAX.into()));
        assert_eq!(int("#x0000000000FFFFFFFFFFFFFFFF"), Some(u64::MAX.into()));
        for text in [
            "",
            "#x",
            "-",
            "2.5",
            "#x1G",
            "1 2",
            "18446744073709551616",
            "#x1FFFFFFFFFFFFFFFF",
            "--1",
            "µ",
            "#x0x",
            "#x#x#x1",
        ] {
            assert_eq!(int(text), None, "{text}");
        }
        for (text, fault) in [("2E", Some(Fault::Bare)), ("#x2E", None), ("#x0x2E", Some(Fault::TwoPrefixes))] {
            assert_eq!(parse(text), Some(Number { value: 0x2E, hex: true, fault }), "{text}");
        }
    }
}
