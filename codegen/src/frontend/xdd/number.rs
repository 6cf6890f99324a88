//! Reads the numbers in CiA 311 files.

use super::reader::Reader;
use crate::diagnostics::codes;
use crate::frontend::canopen::number;
use crate::frontend::xml::Given;
use crate::number::hex16;

impl Reader<'_, '_> {
    /// Reads a number up to `max`. Reports any other text.
    pub fn unsigned(&mut self, given: &Given<'_>, max: u32, what: &str) -> Option<u32> {
        if given.is_missing() {
            return None;
        }
        let value = integer(&given.text).and_then(|value| u32::try_from(value).ok()).filter(|&value| value <= max);
        if value.is_none() {
            self.bad(given, what, format!("left out; expected a number from 0 to {max}"));
        }
        value
    }

    /// Reads hexadecimal digits without a prefix (`hexBinary` of XML Schema). Reports a prefix, but still reads the
    /// digits.
    pub fn hex(&mut self, given: &Given<'_>, max: u32, what: &str) -> Option<u32> {
        if given.is_missing() {
            return None;
        }
        let text = given.text.as_ref();
        let digits = text.strip_prefix("0x").or_else(|| text.strip_prefix("0X")).unwrap_or(text);
        let value = if digits.starts_with('+') { None } else { u64::from_str_radix(digits, 16).ok() };
        let value = value.and_then(|value| u32::try_from(value).ok()).filter(|&value| value <= max);
        match value {
            None => self.bad(given, what, "left out; expected hexadecimal digits"),
            Some(value) if digits.len() != text.len() => {
                let message = format!("{text} has a prefix, but CiA 311 requires hexadecimal digits without a prefix");
                let found = codes::XDD_VALUE.at(given.span, message).label(format!("read as {}", hex16(value)));
                self.diagnostics.push(found.fix(digits));
            }
            Some(_) => {}
        }
        value
    }

    /// Reads a finite real number. Reports any other text.
    pub fn real(&mut self, given: &Given<'_>, what: &str) -> Option<f64> {
        let value = given.text.parse::<f64>().ok().filter(|value| value.is_finite());
        if value.is_none() {
            self.bad(given, what, "left out");
        }
        value
    }
}

/// Reads an integer as XML Schema defines it: leading zeros do not mark octal numbers. Also accepts the prefix `0x`.
pub(super) fn integer(text: &str) -> Option<i128> {
    let digits = text.strip_prefix(['-', '+']).unwrap_or(text);
    match !digits.is_empty() && digits.bytes().all(|byte| byte.is_ascii_digit()) {
        true => text.parse().ok(),
        false => number::parse(text, &[]).int(),
    }
}
