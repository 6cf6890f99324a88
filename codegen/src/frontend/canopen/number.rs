//! Reads the numbers and `$NODEID` formulas of CiA 306, including nonstandard spellings in real files.

/// Result of reading a text as a number or formula.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Number {
    /// Parsed number, formula or text.
    pub parsed: Parsed,
    /// Deviation from the number grammar of CiA 306.
    pub quirk: Option<Quirk>,
}

/// Number, `$NODEID` formula, or any other text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Parsed {
    /// Integer.
    Int {
        /// Value of the number.
        value: i128,
        /// True if the number is hexadecimal and has no minus sign.
        hex: bool,
    },
    /// `$NODEID` plus this offset.
    NodeId(i128),
    /// Invalid formula: a text that contains `$` or a name of `$NODEID`.
    UnknownFormula,
    /// Text that is neither a number nor a formula.
    Text,
}

/// Deviation from the number grammar of CiA 306.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quirk {
    /// Octal number with a leading zero, whose digits have a different value in decimal.
    Octal,
    /// Leading zero, if the digits are not octal or have the same value in octal and decimal.
    LeadingZero,
    /// A hexadecimal suffix (`NNh`).
    HexSuffix,
    /// A C suffix (`U`, `L`, `UL`, `LL`, `ULL`).
    CSuffix,
    /// Formula that does not start with `$NODEID`.
    ReversedNodeId,
}

impl Number {
    fn plain(value: i128) -> Self {
        Number { parsed: Parsed::Int { value, hex: false }, quirk: None }
    }

    fn hex(value: i128) -> Self {
        Number { parsed: Parsed::Int { value, hex: true }, quirk: None }
    }

    fn with(self, quirk: Quirk) -> Self {
        Number { quirk: Some(quirk), ..self }
    }

    const TEXT: Number = Number { parsed: Parsed::Text, quirk: None };

    /// Returns the value of a number, or `None` for a formula or text.
    pub fn int(self) -> Option<i128> {
        match self.parsed {
            Parsed::Int { value, .. } => Some(value),
            _ => None,
        }
    }
}

/// Reads a number or formula. `text` must be trimmed. `aliases` are further names of `$NODEID`.
pub fn parse(text: &str, aliases: &[String]) -> Number {
    if let Some(value) = plain(text).filter(|_| aliases.is_empty()) {
        return Number { parsed: Parsed::Int { value: value.into(), hex: is_plain_hex(text) }, quirk: None };
    }
    if !aliases.is_empty() || text.contains('$') {
        if let Some(formula) = parse_formula(text, aliases) {
            return formula;
        }
    }
    parse_number(text)
}

/// Values of the hexadecimal digits; 16 for all other bytes.
const NIBBLES: [u8; 256] = {
    let (mut nibbles, mut value) = ([16; 256], 0);
    while value < 16 {
        let digit = b"0123456789abcdef"[value];
        nibbles[digit as usize] = value as u8;
        nibbles[digit.to_ascii_uppercase() as usize] = value as u8;
        value += 1;
    }
    nibbles
};

/// Returns the value of a plain number, or `None` for any other text. Plain numbers need no diagnostic. A plain number
/// consists of an optional minus sign and decimal digits without a leading zero, or of `0x` and hexadecimal digits.
/// Plain numbers have at most 15 digits.
#[inline]
pub fn plain(text: &str) -> Option<i64> {
    let decimal = |digits: &[u8]| {
        digits.iter().try_fold(0i64, |value, digit| match digit.wrapping_sub(b'0') {
            digit @ 0..=9 => Some(value * 10 + i64::from(digit)),
            _ => None,
        })
    };
    match text.as_bytes() {
        b"0" => Some(0),
        [b'0', b'x' | b'X', digits @ ..] if (1..=15).contains(&digits.len()) => hexadecimal(digits),
        digits @ [b'1'..=b'9', ..] if digits.len() <= 15 => decimal(digits),
        [b'-', digits @ ..] if digits.len() <= 15 && matches!(digits, [b'1'..=b'9', ..]) => {
            decimal(digits).map(|value| -value)
        }
        _ => None,
    }
}

/// Returns the value of at most 15 hexadecimal digits, or 0 if there are none. Returns `None` if another character occurs.
#[inline]
pub fn hexadecimal(digits: &[u8]) -> Option<i64> {
    debug_assert!(digits.len() <= 15);
    let (value, all) = digits.iter().fold((0, 0), |(value, all), &digit| {
        let nibble = NIBBLES[usize::from(digit)];
        (value << 4 | i64::from(nibble), all | nibble)
    });
    (all < 16).then_some(value)
}

/// Returns whether a plain number is hexadecimal.
#[inline]
pub fn is_plain_hex(text: &str) -> bool {
    text.len() > 1 && text.starts_with('0')
}

/// Returns whether `text` consists of octal digits.
pub fn is_octal(text: &str) -> bool {
    radix(text, 8).is_some()
}

fn parse_number(text: &str) -> Number {
    match text.as_bytes() {
        [b'0'..=b'9', ..] => unsigned(text),
        [b'-', rest @ ..] if !rest.is_empty() => negated(text[1..].trim_start()),
        [b'+', rest @ ..] if !rest.is_empty() => unsigned(text[1..].trim_start()),
        _ => hex_suffix(text),
    }
}

fn negated(text: &str) -> Number {
    let number = unsigned(text);
    match number.parsed {
        Parsed::Int { value, .. } => Number { parsed: Parsed::Int { value: -value, hex: false }, ..number },
        _ => number,
    }
}

fn unsigned(text: &str) -> Number {
    if let Some(digits) = text.strip_prefix("0x").or_else(|| text.strip_prefix("0X")) {
        return radix(digits, 16).map_or_else(|| c_suffix(text), Number::hex);
    }
    let Some(decimal) = radix(text, 10) else {
        let suffixed = hex_suffix(text);
        return if suffixed == Number::TEXT { c_suffix(text) } else { suffixed };
    };
    if text.len() == 1 || !text.starts_with('0') {
        return Number::plain(decimal);
    }
    match radix(text, 8) {
        Some(octal) if octal != decimal => Number::plain(octal).with(Quirk::Octal),
        _ => Number::plain(decimal).with(Quirk::LeadingZero),
    }
}

fn hex_suffix(text: &str) -> Number {
    match text.strip_suffix(['h', 'H']).and_then(|digits| radix(digits, 16)) {
        Some(value) => Number::hex(value).with(Quirk::HexSuffix),
        None => Number::TEXT,
    }
}

fn c_suffix(text: &str) -> Number {
    let digits = text.trim_end_matches(['u', 'U', 'l', 'L']);
    if digits.is_empty() || digits.len() == text.len() || text.len() - digits.len() > 3 {
        return Number::TEXT;
    }
    let number = unsigned(digits);
    if number.parsed == Parsed::Text {
        number
    } else {
        number.with(Quirk::CSuffix)
    }
}

/// Reads digits in the base `radix`, without a sign or separator. Returns `None` if `digits` is empty, has more than 40
/// characters or contains an invalid digit, or if the value needs more than 120 bits.
fn radix(digits: &str, radix: u32) -> Option<i128> {
    let bytes = digits.as_bytes();
    if bytes.is_empty() || bytes.len() > 40 {
        return None;
    }
    // Most numbers have at most 15 digits and do not need 128-bit arithmetic, which is slow.
    if bytes.len() <= 15 {
        let mut value = 0u64;
        for &byte in bytes {
            value = value * u64::from(radix) + u64::from((byte as char).to_digit(radix)?);
        }
        return Some(value.into());
    }
    let mut value: i128 = 0;
    for &byte in bytes {
        let digit = (byte as char).to_digit(radix)?;
        value = value * i128::from(radix) + i128::from(digit);
        if value >> 120 != 0 {
            return None;
        }
    }
    Some(value)
}

/// Reads a sum with one `$NODEID` (or an alias of it) among its terms. Returns `None` if the text contains neither `$`
/// nor an alias.
fn parse_formula(text: &str, aliases: &[String]) -> Option<Number> {
    let is_node_id = |term: &str| {
        term.eq_ignore_ascii_case("$NODEID") || aliases.iter().any(|alias| alias.eq_ignore_ascii_case(term))
    };
    let unknown = Number { parsed: Parsed::UnknownFormula, quirk: None };
    let mentions = text.contains('$') || text.split('+').any(|term| is_node_id(term.trim()));
    if !mentions {
        return None;
    }
    let (mut offset, mut seen) = (0i128, None);
    for (position, term) in text.split('+').map(str::trim).enumerate() {
        if is_node_id(term) {
            if seen.replace(position).is_some() {
                return Some(unknown);
            }
        } else {
            match parse_number(term).parsed {
                Parsed::Int { value, .. } => offset += value,
                _ => return Some(unknown),
            }
        }
    }
    let position = seen?;
    let number = Number { parsed: Parsed::NodeId(offset), quirk: None };
    Some(if position == 0 { number } else { number.with(Quirk::ReversedNodeId) })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn int(text: &str) -> Option<i128> {
        parse(text, &[]).int()
    }

    fn quirk(text: &str) -> Option<Quirk> {
        parse(text, &[]).quirk
    }

    #[test]
    fn numbers_in_every_spelling() {
        assert_eq!((int("0"), quirk("0")), (Some(0), None));
        assert_eq!((int("0X1a"), quirk("0X1a")), (Some(26), None));
        assert_eq!((int("-0x77359400"), quirk("-0x77359400")), (Some(-2_000_000_000), None));
        assert_eq!((int("012"), quirk("012")), (Some(10), Some(Quirk::Octal)));
        assert_eq!((int("018"), quirk("018")), (Some(18), Some(Quirk::LeadingZero)));
        assert_eq!((int("00000005"), quirk("00000005")), (Some(5), Some(Quirk::LeadingZero)));
        assert_eq!((int("1Fh"), quirk("0000h")), (Some(31), Some(Quirk::HexSuffix)));
        assert_eq!((int("FFh"), quirk("FFh")), (Some(255), Some(Quirk::HexSuffix)));
        assert_eq!(int("0x1234567890ABCDEFLL"), Some(0x1234_5678_90AB_CDEF));
        assert_eq!(quirk("10UL"), Some(Quirk::CSuffix));
        assert_eq!(int("18446744073709551615"), Some(u64::MAX.into()));
        assert_eq!(int("+5"), Some(5));
        assert_eq!(int("0xFFFFFFFFFFFFFFF"), Some(0x0FFF_FFFF_FFFF_FFFF));
        assert_eq!(int("0xFFFFFFFFFFFFFFFF"), Some(u64::MAX.into()));
        assert_eq!(int("999999999999999"), Some(999_999_999_999_999));
    }

    #[test]
    fn plain_forms_are_numbers_without_a_quirk() {
        for text in ["0", "7", "-15", "0x1A", "0Xff", "123456789012345", "0x123456789abcdef", "-2147483648"] {
            let value = plain(text).map(i128::from);
            assert!(value.is_some() && value == int(text) && quirk(text).is_none(), "{text}");
        }
        let others = [
            "",
            "-",
            "00",
            "012",
            "+1",
            "-0",
            "-0x1",
            "0x",
            "0x1G",
            "1a",
            "1 ",
            "1234567890123456",
            "0x1234567890abcdef",
        ];
        for text in others {
            assert_eq!(plain(text), None, "{text}");
        }
    }

    #[test]
    fn what_is_no_number() {
        for text in ["", "-", "+", "0x", "x", "1.5", "0x1G", "h", "--5", "1_000", "0x-5", &"9".repeat(99), "L", "²"] {
            assert_eq!(parse(text, &[]).parsed, Parsed::Text, "{text:?}");
        }
    }

    #[test]
    fn formulas_in_every_spelling() {
        for (text, offset) in [
            ("$NODEID+0x180", 0x180),
            ("$NODEID + 0x40000180", 0x4000_0180),
            ("$nodeid+5", 5),
            ("$NodeID", 0),
            ("$NODEID+1+2", 3),
        ] {
            assert_eq!(parse(text, &[]), Number { parsed: Parsed::NodeId(offset), quirk: None }, "{text:?}");
        }
        assert_eq!(parse("0x80+$NODEID", &[]).parsed, Parsed::NodeId(0x80));
        assert_eq!(quirk("0x80+$NODEID"), Some(Quirk::ReversedNodeId));
        for text in ["$MY_NODE_ID+0x200", "$NODEID-1", "$NODEID+", "$NODEID+$NODEID", "$", "$NODEID+x"] {
            assert_eq!(parse(text, &[]).parsed, Parsed::UnknownFormula, "{text:?}");
        }
        let aliases = ["$MY_NODE_ID".to_string(), "Node-ID".to_string()];
        assert_eq!(parse("$MY_NODE_ID+0x200", &aliases).parsed, Parsed::NodeId(0x200));
        assert_eq!(parse("200h + Node-ID", &aliases).parsed, Parsed::NodeId(0x200));
        assert_eq!(parse("12", &aliases).parsed, Parsed::Int { value: 12, hex: false });
    }
}
