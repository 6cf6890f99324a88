//! Parses CiA 306 numbers, formulas and octets without the code under test.

/// A number, or a number to be added to `$NODEID`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Number {
    Plain(i128),
    NodeId(i128),
}

/// Parses a number or a formula. Ignores the case of `$NODEID` and accepts the terms in any order (E13 to E17).
pub fn number(text: &str) -> Option<Number> {
    if !text.contains('$') {
        return plain(text).map(Number::Plain);
    }
    let is_node_id = |term: &&str| term.trim().eq_ignore_ascii_case("$NODEID");
    let (node_ids, others): (Vec<&str>, Vec<&str>) = text.split('+').partition(is_node_id);
    let offsets: Option<Vec<i128>> = others.into_iter().map(|term| plain(term.trim())).collect();
    (node_ids.len() == 1).then_some(Number::NodeId(offsets?.into_iter().sum()))
}

/// Parses a decimal number, a hexadecimal number with `0x`, or an octal number with a leading zero (E02). Digits that
/// are not octal make the number decimal (E03).
pub fn plain(text: &str) -> Option<i128> {
    if let Some(rest) = text.strip_prefix('-') {
        return unsigned(rest).map(|value| -value);
    }
    unsigned(text)
}

fn unsigned(text: &str) -> Option<i128> {
    if let Some(digits) = hex_digits(text) {
        return in_base(digits, 16);
    }
    if text.len() > 1 && text.starts_with('0') {
        return in_base(text, 8).or_else(|| in_base(text, 10));
    }
    in_base(text, 10)
}

/// Returns the text after the prefix `0x` or `0X`, or `None` if this prefix is missing.
pub fn hex_digits(text: &str) -> Option<&str> {
    text.strip_prefix("0x").or_else(|| text.strip_prefix("0X"))
}

fn in_base(digits: &str, base: u32) -> Option<i128> {
    let only_digits = !digits.is_empty() && digits.chars().all(|digit| digit.is_digit(base));
    only_digits.then(|| i128::from_str_radix(digits, base).ok()).flatten()
}

/// Parses pairs of hexadecimal digits. `0x` and spaces are allowed but not required (E53).
pub fn octets(text: &str) -> Option<Vec<u8>> {
    let digits: String = hex_digits(text).unwrap_or(text).split_ascii_whitespace().collect();
    if !digits.len().is_multiple_of(2) || !digits.bytes().all(|digit| digit.is_ascii_hexdigit()) {
        return None;
    }
    (0..digits.len()).step_by(2).map(|at| u8::from_str_radix(&digits[at..at + 2], 16).ok()).collect()
}

/// Parses a real number: in decimal notation, or as a bit pattern with the exact number of hexadecimal digits (E51).
pub fn real(text: &str, bits: usize) -> Option<f64> {
    let Some(digits) = hex_digits(text) else { return text.parse().ok() };
    let pattern = u64::from_str_radix(digits, 16).ok().filter(|_| digits.len() == bits / 4)?;
    Some(if bits == 32 { f64::from(f32::from_bits(pattern as u32)) } else { f64::from_bits(pattern) })
}
