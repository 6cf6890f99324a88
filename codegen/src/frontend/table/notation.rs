//! Notation of numbers, ranges and addresses in register tables: integers, register numbers, objects, bits.

/// Help text for a key or value that is not an object.
pub(super) const OBJECT_HELP: &str =
    "write an index such as `0x6040`, a sub-index such as `\"0x1018:1\"`, or a range such as `\"0x1400..0x1403:1\"`";

/// Reads an integer: `16`, `0x10`, `0o20`, `0b10000`, with an optional sign and `_` between digits.
pub(super) fn integer(text: &str) -> Option<i128> {
    let text = text.trim();
    let (negative, digits) = match text.strip_prefix('-') {
        Some(rest) => (true, rest),
        None => (false, text.strip_prefix('+').unwrap_or(text)),
    };
    let (radix, digits) = match digits.get(..2) {
        Some("0x" | "0X") => (16, &digits[2..]),
        Some("0b" | "0B") => (2, &digits[2..]),
        Some("0o" | "0O") => (8, &digits[2..]),
        _ => (10, digits),
    };
    let digits: String = digits.chars().filter(|&c| c != '_').collect();
    // `from_str_radix` would accept a second sign.
    if !digits.starts_with(|c: char| c.is_digit(radix)) {
        return None;
    }
    let value = i128::from_str_radix(&digits, radix).ok()?;
    Some(if negative { -value } else { value })
}

/// Reads a range such as `3..7`, or a single integer. Returns the first and the last value.
pub(super) fn range(text: &str) -> Option<(i128, i128)> {
    match text.split_once("..") {
        Some((first, last)) => Some((integer(first)?, integer(last.trim_start_matches('='))?)),
        None => integer(text).map(|value| (value, value)),
    }
}

/// Reads the first and the last register number as manuals print them: `63`, `63-64`, or `10099-100`. The end of a range may omit
/// the leading digits of the start.
pub(super) fn registers(text: &str) -> Option<(u32, u32)> {
    let Some((first, last)) = text.split_once(['-', '–']) else {
        let number = u32::try_from(integer(text)?).ok()?;
        return Some((number, number));
    };
    let (first, last) = (first.trim(), last.trim());
    let start = u32::try_from(integer(first)?).ok()?;
    let end = u32::try_from(integer(last)?).ok()?;
    if end >= start {
        return Some((start, end));
    }
    // An abbreviated end has the leading digits of the start. These digits are increased by 1 if the end would be below
    // the start.
    let modulus = 10u32.checked_pow(u32::try_from(last.len()).ok()?)?;
    let end = (start / modulus * modulus).checked_add(end)?;
    Some((start, if end < start { end.checked_add(modulus)? } else { end }))
}

/// Objects and sub-indices that a key of `[chapters.objects]` names.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Objects {
    /// First and last index.
    pub indices: (u16, u16),
    /// First and last sub-index; `None` if the key names whole objects.
    pub subs: Option<(u8, u8)>,
}

/// Reads objects: `0x6040`, `0x1018:1`, `0x1400..0x1403:1`, `0x1600..0x1603:1..8`.
pub(super) fn objects(text: &str) -> Option<Objects> {
    let (indices, subs) = match text.split_once(':') {
        Some((indices, subs)) => (indices, Some(subs)),
        None => (text, None),
    };
    let (first, last) = range(indices)?;
    let indices = (u16::try_from(first).ok()?, u16::try_from(last).ok()?);
    let subs = match subs {
        Some(subs) => {
            let (first, last) = range(subs)?;
            Some((u8::try_from(first).ok()?, u8::try_from(last).ok()?))
        }
        None => None,
    };
    let in_order = indices.0 <= indices.1 && subs.is_none_or(|(first, last)| first <= last);
    in_order.then_some(Objects { indices, subs })
}

/// Reads a range of bits: `7`, `3-2`, `2..3`, `[2..3]`. Returns the first bit and the number of bits.
pub(super) fn bits(text: &str) -> Option<(u8, u8)> {
    let text = text.trim().trim_start_matches('[').trim_end_matches(']');
    let (one, other) = match text.split_once("..").or_else(|| text.split_once('-')) {
        Some((one, other)) => (integer(one)?, integer(other)?),
        None => (integer(text)?, integer(text)?),
    };
    let (low, high) = (u8::try_from(one.min(other)).ok()?, u8::try_from(one.max(other)).ok()?);
    (high < 64).then_some((low, high - low + 1))
}

/// Returns `text` with values in place of the placeholders `{n}`, `{n+1}` and `{sub}`.
pub(super) fn filled(text: &str, number: u32, sub: Option<u8>) -> String {
    let mut filled = String::with_capacity(text.len());
    let mut pieces = text.split('{');
    filled.push_str(pieces.next().unwrap_or_default());
    for piece in pieces {
        let (word, rest) = piece.split_once('}').unwrap_or((piece, ""));
        let number = match (word, word.strip_prefix("n+")) {
            ("n", _) => Some(number),
            ("sub", _) => sub.map(u32::from),
            (_, Some(more)) => more.trim().parse().ok().map(|more| number.saturating_add(more)),
            _ => None,
        };
        match number.filter(|_| word.len() < piece.len()) {
            Some(number) => {
                filled.push_str(&number.to_string());
                filled.push_str(rest);
            }
            None => {
                filled.push('{');
                filled.push_str(piece);
            }
        }
    }
    filled
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn integers_in_every_notation() {
        let cases = [("16", 16), ("0x10", 16), ("-0x10", -16), ("+5", 5), ("0b101", 5), ("1_000", 1000), (" 7 ", 7)];
        for (text, value) in cases {
            assert_eq!(integer(text), Some(value), "{text}");
        }
        for text in ["", "-", "--5", "0x", "1.5", "x", "0x-1", "+-1"] {
            assert_eq!(integer(text), None, "{text}");
        }
    }

    #[test]
    fn numbers_in_names() {
        let cases = [
            ("a{n}b{n+1}", "a4b5"),
            ("{sub} {n + 1} {n+ 2 }{", "7 {n + 1} 6{"),
            ("{n+x} {n+1 {n}", "{n+x} {n+1 4"),
            ("{}{n", "{}{n"),
            ("", ""),
            ("{n}}", "4}"),
        ];
        for (text, expected) in cases {
            assert_eq!(filled(text, 4, Some(7)), expected, "{text}");
        }
        assert_eq!(filled("{sub}{n}", 1, None), "{sub}1");
        assert_eq!(filled(&"{n+1}".repeat(200_000), 1, None).len(), 200_000);
    }

    #[test]
    fn the_end_of_a_range_may_be_short() {
        let cases = [
            ("63", (63, 63)),
            ("0063-64", (63, 64)),
            ("10007-8", (10007, 10008)),
            ("10099-100", (10099, 10100)),
            ("0399-400", (399, 400)),
            ("0401-02", (401, 402)),
            ("2011-6998", (2011, 6998)),
        ];
        for (text, numbers) in cases {
            assert_eq!(registers(text), Some(numbers), "{text}");
        }
        assert_eq!(registers("x-1"), None);
    }

    #[test]
    fn objects_and_bits() {
        assert_eq!(objects("0x6040"), Some(Objects { indices: (0x6040, 0x6040), subs: None }));
        let many = Objects { indices: (0x1600, 0x1603), subs: Some((1, 8)) };
        assert_eq!(objects("0x1600..0x1603:1..8"), Some(many));
        for text in ["", "0x6040:", "0x10000", "0x6040:256", "0x1603..0x1600", "0x6040:2..1"] {
            assert_eq!(objects(text), None, "{text}");
        }
        for text in ["3-2", "2..3", "[2..3]", "2-3"] {
            assert_eq!(bits(text), Some((2, 2)), "{text}");
        }
        assert_eq!((bits("63"), bits("64"), bits("x")), (Some((63, 1)), None, None));
    }

    #[test]
    fn templates_are_filled() {
        assert_eq!(filled("RPDO {n+1}, entry {sub} of {n}", 3, Some(2)), "RPDO 4, entry 2 of 3");
        assert_eq!(filled("{n+x} {", 3, None), "{n+x} {");
    }
}
