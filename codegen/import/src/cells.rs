//! Parses single cells: numbers, factors, units, access rights and word order.

use lexibus_codegen::frontend::table::usual_unit;

/// A number in a cell, with its notation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Number {
    Int { value: i128, is_hex: bool },
    Real(f64),
}

impl Number {
    pub fn real(self) -> f64 {
        match self {
            Number::Int { value, .. } => value as f64,
            Number::Real(value) => value,
        }
    }

    pub fn int(self) -> Option<i128> {
        match self {
            Number::Int { value, .. } => Some(value),
            Number::Real(value) => (value.fract() == 0.0 && value.abs() < 1e15).then_some(value as i128),
        }
    }

    /// Returns the number if it is a whole number from 0 to 2³² − 1.
    pub fn unsigned(self) -> Option<u32> {
        u32::try_from(self.int()?).ok()
    }
}

/// Returns whether a cell is empty or contains only a placeholder such as `n/a`.
pub(super) fn is_blank(text: &str) -> bool {
    const NOTHING: [&str; 12] = ["", "-", "--", "---", "–", "—", "/", "n/a", "na", "n.a.", "none", "null"];
    NOTHING.contains(&text.trim().to_lowercase().as_str())
}

/// Parses a hexadecimal integer: `0x1F`, `1Fh`, `#x1F`, `16#1F`, `&H1F` or `$1F`. Digits without a prefix are also
/// accepted if `is_hex` is set.
pub(super) fn hexadecimal(text: &str, is_hex: bool) -> Option<i128> {
    let text = text.trim();
    let marked = ["0x", "0X", "#x", "16#", "$", "&H", "&h"].into_iter().find_map(|mark| text.strip_prefix(mark));
    let digits = match (marked, text.strip_suffix(['h', 'H'])) {
        (Some(digits), _) => digits,
        (None, Some(digits)) => digits,
        (None, None) if is_hex => text,
        _ => return None,
    };
    let digits: String = digits.chars().filter(|&letter| !matches!(letter, '_' | ' ')).collect();
    // Check the digits, because `from_str_radix` would accept a sign.
    let is_number = !digits.is_empty() && digits.chars().all(|digit| digit.is_ascii_hexdigit());
    is_number.then(|| i128::from_str_radix(&digits, 16).ok()).flatten()
}

/// Parses a decimal, hexadecimal or binary number. If `comma` is set, the comma in a number such as `1,234` is the decimal
/// mark; otherwise, it separates thousands.
pub(super) fn number(text: &str, comma: bool) -> Option<Number> {
    let text: String = text.trim().replace(['\u{a0}', '\u{202f}', '\'', '_'], "").replace(['−', '–'], "-");
    let (sign, digits) = match text.strip_prefix('-') {
        Some(rest) => (-1, rest.trim_start()),
        None => (1, text.strip_prefix('+').unwrap_or(&text)),
    };
    if let Some(value) = hexadecimal(digits, false) {
        return Some(Number::Int { value: sign * value, is_hex: true });
    }
    if let Some(bits) = digits.strip_prefix("0b").filter(|bits| bits.starts_with(['0', '1'])) {
        let value = i128::from_str_radix(bits, 2).ok()?;
        return Some(Number::Int { value: sign * value, is_hex: true });
    }
    let digits = point(digits, comma);
    if !digits.starts_with(|letter: char| letter.is_ascii_digit() || letter == '.') {
        return None;
    }
    if let Ok(value) = digits.parse::<u64>() {
        return Some(Number::Int { value: sign * i128::from(value), is_hex: false });
    }
    let value = digits.parse::<f64>().ok().filter(|value| value.is_finite())?;
    Some(Number::Real(sign as f64 * value))
}

/// Converts the decimal mark of a number to a point, and removes the thousands separators.
fn point(digits: &str, comma: bool) -> String {
    let groups = |mark: char| {
        let mut parts = digits.split(mark);
        let first = parts.next().unwrap_or_default();
        (1..=3).contains(&first.len()) && first != "0" && parts.all(|part| part.len() == 3)
    };
    match (digits.rfind('.'), digits.rfind(',')) {
        (Some(point), Some(comma)) if point < comma => digits.replace('.', "").replace(',', "."),
        (Some(_), Some(_)) => digits.replace(',', ""),
        (None, Some(_)) if !comma && groups(',') => digits.replace(',', ""),
        (None, Some(_)) => digits.replace(',', "."),
        (Some(_), None) if digits.matches('.').count() > 1 && groups('.') => digits.replace('.', ""),
        _ => digits.to_owned(),
    }
}

/// Returns whether the decimal mark of a number is a comma. Returns `None` if the number has no decimal mark, or if the
/// meaning of the mark is unclear.
pub(super) fn decimal_mark(text: &str) -> Option<bool> {
    let digits = text.trim().trim_start_matches(['-', '+']);
    let (whole, fraction) = digits.split_once([',', '.'])?;
    let is_number = |text: &str| !text.is_empty() && text.chars().all(|letter| letter.is_ascii_digit());
    let is_clear = fraction.len() != 3 || whole == "0";
    (is_number(whole) && is_number(fraction) && is_clear).then(|| digits.contains(','))
}

/// Parses a number. The unit of the row, or other letters, may follow the number.
pub(super) fn quantity(text: &str, unit: &str, comma: bool) -> Option<Number> {
    let text = text.trim();
    number(text, comma).or_else(|| {
        let bare = text.strip_suffix(unit).filter(|_| !unit.is_empty());
        let letters = || text.trim_end_matches(|letter: char| letter.is_alphabetic() || "°%µΩ/²³".contains(letter));
        number(bare.unwrap_or_else(letters), comma)
    })
}

/// Parses a range of two numbers, such as `0..100`, `0-100`, `-40 to 85` or `[0; 100]`.
pub(super) fn range(text: &str, unit: &str, comma: bool) -> Option<(Number, Number)> {
    let text = text.trim().trim_matches(['[', ']', '(', ')']).trim();
    let words = ["..", "…", "~", "÷", " to ", " bis ", " a ", " - ", ";", "–", "/"];
    let divided = words.into_iter().find_map(|word| text.split_once(word));
    // A `-` at the start of the text is a sign, not a separator.
    let by_dash = || {
        let (at, _) = text.char_indices().skip(1).find(|&(_, letter)| letter == '-')?;
        Some((text.get(..at)?, text.get(at + 1..)?))
    };
    let (low, high) = divided.or_else(by_dash)?;
    let high = high.trim_start_matches(['.', '=']);
    Some((quantity(low, unit, comma)?, quantity(high, unit, comma)?))
}

/// A scale factor. The factor is ambiguous if the list could also mean its inverse.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Factor {
    pub value: f64,
    pub is_ambiguous: bool,
}

/// Parses a scale factor, such as `0.1`, `x0.1`, `x10`, `/100`, `1/10`, `10^-1` or `0.1 V`.
pub(super) fn factor(text: &str, unit: &str, comma: bool) -> Option<Factor> {
    let text = text.trim().trim_start_matches('=');
    let clear = |value: f64| Factor { value, is_ambiguous: false };
    let whole = |text: &str| quantity(text, unit, comma).map(Number::real);
    let found = if let Some(rest) = text.strip_prefix(['/', '÷', ':']) {
        clear(1.0 / whole(rest)?)
    } else if let Some(rest) = text.strip_prefix(['x', 'X', '*', '×', '·']) {
        let value = whole(rest)?;
        // "x10" can also mean that the raw value is ten times the physical value.
        Factor { value, is_ambiguous: value > 1.0 }
    } else if let Some((base, exponent)) = text.split_once('^').or_else(|| text.split_once("**")) {
        let exponent = number(exponent.trim_matches(['(', ')']), comma)?.int()?;
        clear(whole(base)?.powi(i32::try_from(exponent).ok()?))
    } else if let Some(value) = whole(text) {
        clear(value)
    } else {
        let (numerator, denominator) = text.split_once('/')?;
        clear(number(numerator, comma)?.real() / whole(denominator)?)
    };
    (found.value.is_finite() && found.value != 0.0).then_some(found)
}

/// Parses a unit and the factor before it, such as `0.1 °C` or `1/10 V`.
pub(super) fn unit(text: &str, comma: bool) -> (String, Option<f64>) {
    let text = text.trim().trim_matches(['[', ']']).trim();
    let is_number = |letter: char| letter.is_ascii_digit() || matches!(letter, '.' | ',' | '/' | ' ');
    let digits = text.trim_start_matches(is_number);
    let head = text.strip_suffix(digits).unwrap_or_default().trim();
    // `1/min` and `1/h` are units without a factor.
    if head.is_empty() || digits.is_empty() || head.ends_with('/') {
        return (symbol(text), None);
    }
    match factor(head, "", comma) {
        Some(factor) => (symbol(digits), Some(factor.value).filter(|&value| value != 1.0)),
        None => (symbol(text), None),
    }
}

/// Returns the standard symbol of a unit, or the text itself if no symbol is known for it.
fn symbol(text: &str) -> String {
    usual_unit(text).unwrap_or(text).to_owned()
}

/// Parses access rights. Returns the value of the key `access` in a register table: `ro`, `rw`, `wo`, `const`, `rwr` or
/// `rww`.
pub(super) fn access(text: &str) -> Option<&'static str> {
    let lower = text.to_lowercase();
    let letters: String = lower.chars().filter(|letter| letter.is_alphanumeric()).collect();
    let has = |words: &[&str]| words.iter().any(|word| lower.contains(word));
    Some(match letters.as_str() {
        "rwr" => "rwr",
        "rww" => "rww",
        "r" | "ro" | "l" | "lo" | "input" | "in" | "get" => "ro",
        "w" | "wo" | "s" | "so" | "output" | "out" | "set" => "wo",
        "rw" | "wr" | "rdwr" | "ls" | "sl" | "inout" | "getset" | "rwe" | "rwnv" => "rw",
        "const" | "constant" | "c" | "costante" | "konstant" => "const",
        "rd" => "ro",
        _ => {
            let reads = has(&["read", "lett", "les", "lectura", "lecture"]);
            let writes = has(&["writ", "scri", "schreib", "escri"]);
            match (reads, writes) {
                (true, true) => "rw",
                (true, false) => "ro",
                (false, true) => "wo",
                (false, false) => return None,
            }
        }
    })
}

/// The word and byte order, for the keys `order` and `swap` of a register table.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Order {
    pub low_first: Option<bool>,
    pub swap: Option<bool>,
}

/// Parses a word and byte order such as `ABCD`, `little endian` or `MSW first`. `of_words` means that the text describes only
/// the order of words.
pub(super) fn order(text: &str, of_words: bool) -> Option<Order> {
    let lower = text.to_lowercase();
    let letters: String = lower.chars().filter(|letter| letter.is_alphanumeric()).collect();
    let has = |words: &[&str]| words.iter().any(|word| letters.contains(word));
    let order = |low_first, swap| Some(Order { low_first: Some(low_first), swap: Some(swap) });
    match letters.as_str() {
        "abcd" | "abcdefgh" | "ab" | "1234" | "3210" | "no" | "false" | "0" | "normal" | "bigbig" => {
            order(false, false)
        }
        "cdab" | "ghefcdab" | "3412" | "1032" | "wordswap" | "wordswapped" => order(true, false),
        "badc" | "badcfehg" | "2143" | "2301" | "byteswap" | "byteswapped" => order(false, true),
        "dcba" | "hgfedcba" | "ba" | "4321" | "0123" | "wordbyte" => order(true, true),
        "word" | "swap" | "swapped" | "yes" | "true" | "1" | "x" => order(true, false),
        "byte" => order(false, true),
        "be" | "big" | "msb" | "motorola" | "network" => order(false, false),
        "le" | "little" | "lsb" | "intel" => order(true, !of_words),
        _ if has(&["bigendianbyteswap", "bigendianswap", "midbig"]) => order(false, true),
        _ if has(&["littleendianbyteswap", "littleendianswap", "midlittle"]) => order(true, false),
        _ if has(&["mswfirst", "mswlsw", "highwordfirst", "highfirst", "hilo", "highlow", "msbfirst", "hwlw"]) => {
            order(false, false)
        }
        _ if has(&["lswfirst", "lswmsw", "lowwordfirst", "lowfirst", "lohi", "lowhigh", "lsbfirst", "lwhw"]) => {
            order(true, false)
        }
        _ if has(&["bigendian", "bigend"]) => order(false, false),
        _ if has(&["littleendian", "littleend"]) => order(true, !of_words),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn int(value: i128) -> Option<Number> {
        Some(Number::Int { value, is_hex: false })
    }

    #[test]
    fn numbers_in_every_notation() {
        assert_eq!(number("-12", false), int(-12));
        assert_eq!(number("1,000", false), int(1000));
        assert_eq!(number("1,000", true), Some(Number::Real(1.0)));
        assert_eq!(number("0,1", false), Some(Number::Real(0.1)));
        assert_eq!(number("1.234,5", true), Some(Number::Real(1234.5)));
        assert_eq!(number("1,234.5", false), Some(Number::Real(1234.5)));
        assert_eq!(number("1.000.000", true), int(1_000_000));
        assert_eq!(number("10'000", false), int(10_000));
        assert_eq!(number("0x10", false), Some(Number::Int { value: 16, is_hex: true }));
        assert_eq!(number("FFh", false), Some(Number::Int { value: 255, is_hex: true }));
        assert_eq!(number("1e-3", false), Some(Number::Real(0.001)));
        for text in ["", "x", "-", "1-2", "e5", "inf", "nan", "1e999", "0x", "--1", "h"] {
            assert_eq!(number(text, false), None, "{text}");
        }
        assert_eq!((decimal_mark("0,5"), decimal_mark("2.25"), decimal_mark("1,000")), (Some(true), Some(false), None));
        assert_eq!(quantity("100 %", "%", false), int(100));
        assert_eq!(range("-40…85", "", false), int(-40).zip(int(85)));
        assert_eq!(range("0-100", "", false), int(0).zip(int(100)));
        assert_eq!(range("-10--5", "", false), int(-10).zip(int(-5)));
        assert_eq!(range("0 to 100 %", "%", false), int(0).zip(int(100)));
        assert_eq!(range("5", "", false), None);
    }

    #[test]
    fn factors() {
        let cases = [
            ("0.1", 0.1),
            ("0,1", 0.1),
            ("x0.1", 0.1),
            ("/100", 0.01),
            ("1/10", 0.1),
            ("10^-2", 0.01),
            ("0.5 V", 0.5),
            ("1", 1.0),
        ];
        for (text, value) in cases {
            assert_eq!(factor(text, "V", false), Some(Factor { value, is_ambiguous: false }), "{text}");
        }
        assert_eq!(factor("x10", "", false), Some(Factor { value: 10.0, is_ambiguous: true }));
        for text in ["", "0", "/0", "SF_1", "x", "/"] {
            assert_eq!(factor(text, "", false), None, "{text}");
        }
    }

    #[test]
    fn units_with_and_without_a_factor() {
        let cases = [
            ("0.1°C", ("°C", Some(0.1))),
            ("1/10 V", ("V", Some(0.1))),
            ("1/min", ("rpm", None)),
            ("degC", ("°C", None)),
            ("KW", ("kW", None)),
            ("imp/kWh", ("imp/kWh", None)),
            ("1 s", ("s", None)),
        ];
        for (text, (symbol, factor)) in cases {
            assert_eq!(unit(text, false), (symbol.to_owned(), factor), "{text}");
        }
    }

    #[test]
    fn words_for_access_and_order() {
        for (text, word) in [
            ("R", "ro"),
            ("R/W", "rw"),
            ("Read only", "ro"),
            ("Lettura/Scrittura", "rw"),
            ("Lesen", "ro"),
            ("W", "wo"),
            ("RO", "ro"),
            ("sola lettura", "ro"),
        ] {
            assert_eq!(access(text), Some(word), "{text}");
        }
        assert_eq!(access("maybe"), None);
        let is = |text, low_first, swap| {
            assert_eq!(order(text, false), Some(Order { low_first: Some(low_first), swap: Some(swap) }), "{text}")
        };
        is("CDAB", true, false);
        is("Big Endian", false, false);
        is("LSW first", true, false);
        is("little-endian", true, true);
        is("word_byte", true, true);
        assert_eq!(order("Little", true).and_then(|order| order.swap), Some(false));
        assert_eq!(order("sideways", false), None);
    }
}
