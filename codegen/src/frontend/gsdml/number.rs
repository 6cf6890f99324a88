//! Reads the numbers, Boolean values and lists in GSDML files.

use smallvec::SmallVec;

use super::reader::Reader;
use crate::diagnostics::codes;
use crate::frontend::xml::Given;
use crate::ir::Numbers;
use crate::number::{self, hex32};
use crate::syntax::xml::Tag;

impl<'a> Reader<'a, '_> {
    /// Reads a decimal number up to `max`. Reports any other text, and returns `None` unless the text is a hexadecimal
    /// number up to `max`.
    pub fn unsigned(&mut self, given: &Given<'_>, max: u32, what: &str) -> Option<u32> {
        if given.is_missing() {
            return None;
        }
        let fits = |value: u64| u32::try_from(value).ok().filter(|&value| value <= max);
        if let Ok(value) = given.text.parse::<u64>() {
            let value = fits(value);
            if value.is_none() {
                self.bad(given, what, format!("left out; expected a number from 0 to {max}"));
            }
            return value;
        }
        let value = hex(&given.text).and_then(fits);
        match value {
            Some(value) => {
                let message = format!("`{}` is hexadecimal, but GSDML requires a decimal number", given.text);
                let found = codes::GSDML_VALUE.at(given.span, message).label(format!("read as {value}"));
                self.diagnostics.push(found.fix(value.to_string()));
            }
            None => self.bad(given, what, format!("left out; expected a number from 0 to {max}")),
        }
        value
    }

    /// Reads a 16-bit number as [`unsigned`](Self::unsigned) does.
    pub fn unsigned16(&mut self, given: &Given<'_>, what: &str) -> Option<u16> {
        self.unsigned(given, u16::MAX.into(), what).and_then(|value| u16::try_from(value).ok())
    }

    /// Reads an ident number such as `0x0000430A`, with any number of digits, up to `max`. Reports a missing prefix, but still
    /// reads the number. Returns `None` and reports the text if it is not such a number.
    pub fn ident(&mut self, given: &Given<'_>, max: u32, what: &str) -> Option<u32> {
        if given.is_missing() {
            return None;
        }
        let fits = |value: u64| u32::try_from(value).ok().filter(|&value| value <= max);
        if let Some(value) = hex(&given.text).and_then(fits) {
            return Some(value);
        }
        let value = digits(&given.text).and_then(fits);
        match value {
            Some(value) => {
                let message = format!("`{}` has no prefix `0x`", given.text);
                let found = codes::GSDML_VALUE.at(given.span, message).label(format!("read as {}", hex32(value)));
                self.diagnostics.push(found.fix(hex32(value)));
            }
            None => self.bad(given, what, format!("left out; expected `0x` and a number up to {}", number::hex(max))),
        }
        value
    }

    /// Reads the required ident number of `tag`. Returns 0 if the ident number is missing or invalid.
    pub fn required_ident(&mut self, tag: &Tag<'_>, given: &Given<'_>, name: &str) -> u32 {
        self.require(tag, given, name, "read as 0");
        self.ident(given, u32::MAX, "ident number").unwrap_or(0)
    }

    /// Reads a list of numbers and ranges such as `1..3 7`. Reports the first invalid part. Descending ranges are read
    /// with their limits swapped, and other invalid parts are left out.
    pub fn numbers(&mut self, given: &Given<'_>) -> Numbers {
        let mut list = SmallVec::new();
        let mut broken = None;
        let range = |part: &str| range(part, |number| number.parse::<u16>().ok());
        for part in given.text.split_ascii_whitespace() {
            match range(part) {
                Some((first, last)) if first <= last => list.push((first, last)),
                Some((last, first)) => {
                    list.push((first, last));
                    broken = broken.or(Some(part));
                }
                None => broken = broken.or(Some(part)),
            }
        }
        if let Some(part) = broken {
            let message = format!("`{part}` is neither a number up to 65535 nor an ascending range `first..last`");
            let label = if range(part).is_some() { "read with the limits swapped" } else { "left out" };
            self.diagnostics.push(codes::GSDML_VALUE.at(given.span, message).label(label));
        }
        Numbers(list)
    }
}

/// Reads a number or a range such as `1..3`. Returns the first and the last number. `number` reads a number.
pub(super) fn range<T: Clone>(text: &str, number: impl Fn(&str) -> Option<T>) -> Option<(T, T)> {
    match text.split_once("..") {
        Some((first, last)) => Some((number(first)?, number(last)?)),
        None => number(text).map(|number| (number.clone(), number)),
    }
}

/// Reads hexadecimal digits after `0x`.
pub(super) fn hex(text: &str) -> Option<u64> {
    digits(text.strip_prefix("0x").or_else(|| text.strip_prefix("0X"))?)
}

fn digits(text: &str) -> Option<u64> {
    // `from_str_radix` also accepts a plus sign.
    (!text.starts_with('+')).then(|| u64::from_str_radix(text, 16).ok()).flatten()
}

/// Returns the parts of a list such as `a;b;c`.
pub(super) fn tokens(text: &str) -> impl Iterator<Item = &str> {
    text.split(';').map(str::trim).filter(|token| !token.is_empty())
}

/// Reads a list of 32-bit numbers and ranges. Returns `None` if a part is neither a number nor a range.
pub(super) fn wide_ranges(text: &str) -> Option<Vec<(i128, i128)>> {
    let number = |text: &str| text.parse::<u32>().ok().map(i128::from);
    text.split_ascii_whitespace().map(|part| range(part, number)).collect()
}
