//! Parses addresses: numbers, ranges, bits, Modbus tables and objects.

use super::cells::{self, hexadecimal};

/// A Modbus table.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(super) enum Table {
    Holding,
    Input,
    Coil,
    Discrete,
}

impl Table {
    /// Returns the name of this Modbus table in the register-table format.
    pub fn name(self) -> &'static str {
        match self {
            Table::Holding => "holding",
            Table::Input => "input",
            Table::Coil => "coil",
            Table::Discrete => "discrete",
        }
    }

    /// Returns whether this Modbus table consists of bits.
    pub fn is_bits(self) -> bool {
        matches!(self, Table::Coil | Table::Discrete)
    }

    /// Returns whether this Modbus table is read-only.
    pub fn is_read_only(self) -> bool {
        matches!(self, Table::Input | Table::Discrete)
    }

    /// Returns the Modbus table of a printed address whose first digit identifies the table, such as 40001. Also returns the
    /// first address of that table.
    pub fn of_number(number: u32) -> Option<(Table, u32)> {
        let found = match number {
            1..=9_999 => (Table::Coil, 1),
            10_001..=19_999 => (Table::Discrete, 10_001),
            30_001..=39_999 => (Table::Input, 30_001),
            40_001..=49_999 => (Table::Holding, 40_001),
            100_001..=165_536 => (Table::Discrete, 100_001),
            300_001..=365_536 => (Table::Input, 300_001),
            400_001..=465_536 => (Table::Holding, 400_001),
            _ => return None,
        };
        Some(found)
    }

    fn of_digit(digit: char) -> Option<Table> {
        Some(match digit {
            '0' => Table::Coil,
            '1' => Table::Discrete,
            '3' => Table::Input,
            '4' => Table::Holding,
            _ => return None,
        })
    }
}

/// The address in a cell.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Address {
    pub first: u32,
    /// Last address, if the cell contains a range.
    pub last: Option<u32>,
    /// Modbus table, if the cell contains it.
    pub table: Option<Table>,
    /// Lowest and highest bit, if the cell addresses a part of a register.
    pub bits: Option<(u8, u8)>,
    pub is_hex: bool,
}

/// The notation of the addresses in a column.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Style {
    /// True if digits without a prefix are hexadecimal.
    pub is_hex: bool,
    /// True if addresses have the form `4x0001`. In this notation, `0x0001` is the address of a coil and not a
    /// hexadecimal number.
    pub is_x: bool,
    /// True if all addresses end in `.0`, which some spreadsheets add.
    pub is_fraction: bool,
}

impl Style {
    /// Detects the address notation of a column.
    pub fn of<'c>(cells: impl Iterator<Item = &'c str> + Clone, is_hex: bool) -> Style {
        let mut filled = cells.filter(|text| !cells::is_blank(text));
        let is_x = filled.clone().any(|text| x_notation(text).is_some_and(|(digit, _)| digit != '0'));
        let is_fraction = filled.clone().next().is_some() && filled.clone().all(|text| text.ends_with(".0"));
        // If an address contains both hexadecimal letters and digits, all addresses of the column are hexadecimal.
        let letters = |text: &str| {
            let is_plain = !text.is_empty() && text.chars().all(|digit| digit.is_ascii_hexdigit());
            is_plain
                && text.contains(|digit: char| digit.is_ascii_alphabetic())
                && text.contains(|c: char| c.is_ascii_digit())
        };
        Style { is_hex: is_hex || filled.any(letters), is_x, is_fraction }
    }
}

/// Parses an address such as `4x0012`. Returns the digit that identifies the Modbus table, and the number after `x`.
fn x_notation(text: &str) -> Option<(char, u32)> {
    let mut letters = text.chars();
    let digit = letters.next().filter(|digit| matches!(digit, '0' | '1' | '3' | '4'))?;
    letters.next().filter(|mark| matches!(mark, 'x' | 'X'))?;
    let digits = letters.as_str();
    let is_number = !digits.is_empty() && digits.chars().all(|digit| digit.is_ascii_digit());
    is_number.then(|| Some((digit, digits.parse().ok()?))).flatten()
}

/// Parses the address in a cell.
pub(super) fn read(text: &str, style: Style) -> Option<Address> {
    let text = text.trim();
    let text = if style.is_fraction { text.strip_suffix(".0").unwrap_or(text) } else { text };
    let (registers, bits) = part_of(text);
    let (first, last) = ends(registers);
    let start = single(first, style)?;
    let last = match last {
        Some(last) => Some(end_of(start.first, last, Style { is_hex: is_hexadecimal(first, style), ..style })?),
        None => None,
    };
    let last = last.filter(|&last| last > start.first);
    Some(Address { last, bits, ..start })
}

/// Separates the register address from the bits after it: `40010.3`, `40010 bit 3`, `40010:0-3`.
fn part_of(text: &str) -> (&str, Option<(u8, u8)>) {
    let lower = text.to_ascii_lowercase();
    let by_word = lower.find("bit").map(|at| (at, at + 3));
    let by_mark = || {
        let at = text.find(['.', ':'])?;
        // In `40001..40002`, the dots mark a range and not a bit.
        let is_range = text.get(at + 1..).is_some_and(|rest| rest.starts_with('.'));
        (!is_range).then_some((at, at + 1))
    };
    let divided = by_word.or_else(by_mark).and_then(|(end, start)| Some((text.get(..end)?, text.get(start..)?)));
    let marks = |letter: char| letter.is_whitespace() || matches!(letter, '.' | ':' | '/' | '_' | '-' | 's');
    match divided.and_then(|(register, rest)| {
        Some((register.trim_end_matches(marks), bit_range(rest.trim_start_matches(marks))?))
    }) {
        Some((register, bits)) => (register, Some(bits)),
        None => (text, None),
    }
}

/// Parses bit numbers such as `3`, `0-3` or `15..8`. Returns the lowest and the highest bit.
pub(super) fn bit_range(text: &str) -> Option<(u8, u8)> {
    let text = text.trim().trim_start_matches(['b', 'B']).trim_matches(['[', ']', ' ']);
    let (one, other) = text.split_once("..").or_else(|| text.split_once(['-', '–', ':', '~'])).unwrap_or((text, text));
    let (one, other): (u8, u8) = (one.trim().parse().ok()?, other.trim().parse().ok()?);
    let (low, high) = (one.min(other), one.max(other));
    (high < 64).then_some((low, high))
}

/// Returns the lowest and the highest bit of a mask of adjacent bits: `0x00F0` is `(4, 7)`.
pub(super) fn mask(text: &str) -> Option<(u8, u8)> {
    let value = u64::try_from(hexadecimal(text, false)?).ok().filter(|&value| value > 0)?;
    let low = value.trailing_zeros();
    let bits = (value >> low).trailing_ones();
    let is_whole = bits == value.count_ones();
    is_whole.then_some((low as u8, (low + bits - 1) as u8))
}

/// Splits a range or list into the first and the last address. If the text is a single address, returns the text and
/// `None`.
fn ends(text: &str) -> (&str, Option<&str>) {
    let words = ["..", "…", "~", " to ", " bis ", "–", "-", "/", "&", "+"];
    let divided = words.into_iter().find_map(|word| text.split_once(word));
    let list = || {
        // `40,001` is one address with a thousands separator. `40001, 40002` are two addresses.
        let (first, rest) = text.split_once(',')?;
        let is_number = rest.len() == 3 && rest.chars().all(|digit| digit.is_ascii_digit());
        (!is_number || first.len() > 3).then(|| (first, rest.rsplit(',').next().unwrap_or(rest)))
    };
    match divided.or_else(list) {
        Some((first, last)) if !first.trim().is_empty() => (first.trim(), Some(last.trim_start_matches('.').trim())),
        _ => (text, None),
    }
}

/// Returns the last address of a range that starts at `first`. The text may omit the leading digits that both addresses have in
/// common.
fn end_of(first: u32, last: &str, style: Style) -> Option<u32> {
    let end = single(last, style)?.first;
    if end >= first {
        return Some(end);
    }
    let base: u32 = if is_hexadecimal(last, style) { 16 } else { 10 };
    let digits = last.chars().filter(char::is_ascii_hexdigit).count();
    let modulus = base.checked_pow(u32::try_from(digits).ok()?)?;
    let end = (first / modulus * modulus).checked_add(end)?;
    if end >= first {
        Some(end)
    } else {
        end.checked_add(modulus)
    }
}

/// Returns whether a text is a hexadecimal number in the notation `style`.
fn is_hexadecimal(text: &str, style: Style) -> bool {
    hexadecimal(text, style.is_hex).is_some() && !(style.is_x && x_notation(text.trim()).is_some())
}

fn single(text: &str, style: Style) -> Option<Address> {
    let text = text.trim().trim_start_matches('%');
    if let Some((digit, number)) = x_notation(text).filter(|&(digit, _)| digit != '0' || style.is_x) {
        let table = Table::of_digit(digit)?;
        return Some(Address { first: number, table: Some(table), ..Address::default() });
    }
    let upper = text.to_ascii_uppercase();
    const MARKS: [(&str, Option<Table>); 9] = [
        ("HREG", Some(Table::Holding)),
        ("HR", Some(Table::Holding)),
        ("IREG", Some(Table::Input)),
        ("IR", Some(Table::Input)),
        ("DI", Some(Table::Discrete)),
        ("CO", Some(Table::Coil)),
        ("MW", Some(Table::Holding)),
        ("REG", None),
        ("R", None),
    ];
    let marked = MARKS.iter().find_map(|&(mark, table)| Some((upper.strip_prefix(mark)?, table)));
    let marked = marked.filter(|(rest, _)| rest.trim().starts_with(|digit: char| digit.is_ascii_digit()));
    let (digits, table) = marked.unwrap_or((text, None));
    if let Some(value) = hexadecimal(digits, style.is_hex) {
        return Some(Address { first: u32::try_from(value).ok()?, table, is_hex: true, ..Address::default() });
    }
    let digits: String = digits.chars().filter(|letter| !matches!(letter, ' ' | ',' | '\'' | '\u{a0}' | '_')).collect();
    let is_number = !digits.is_empty() && digits.chars().all(|digit| digit.is_ascii_digit());
    is_number.then(|| Some(Address { first: digits.parse().ok()?, table, ..Address::default() })).flatten()
}

/// Parses the name of a Modbus table or a list of function codes. Function codes also determine the access rights.
pub(super) fn table(text: &str) -> Option<(Table, Option<&'static str>)> {
    let lower = text.to_lowercase();
    let names = [
        ("holding", Table::Holding),
        ("discrete", Table::Discrete),
        ("coil", Table::Coil),
        ("input status", Table::Discrete),
        ("input bit", Table::Discrete),
        ("digital input", Table::Discrete),
        ("input", Table::Input),
    ];
    if let Some((_, table)) = names.iter().find(|(name, _)| lower.contains(name)) {
        return Some((*table, None));
    }
    let letters: String = lower.chars().filter(|letter| letter.is_alphanumeric()).collect();
    let table = match letters.as_str() {
        "hr" | "hreg" | "4x" | "4xxxx" | "rw" => Table::Holding,
        "ir" | "ireg" | "3x" | "3xxxx" => Table::Input,
        "di" | "1x" | "1xxxx" => Table::Discrete,
        "co" | "0x" | "do" => Table::Coil,
        _ => return by_function(&lower),
    };
    Some((table, None))
}

fn by_function(text: &str) -> Option<(Table, Option<&'static str>)> {
    let codes = text.split(|letter: char| !letter.is_ascii_alphanumeric()).filter_map(|word| {
        let digits = word.trim_start_matches(|letter: char| letter.is_ascii_alphabetic());
        match word.strip_prefix("0x") {
            Some(digits) => u8::from_str_radix(digits, 16).ok(),
            None => digits.trim_end_matches('h').parse::<u8>().ok(),
        }
    });
    let codes: Vec<u8> = codes.collect();
    let has = |list: &[u8]| codes.iter().any(|code| list.contains(code));
    let table = if has(&[3, 6, 16, 22, 23]) {
        Table::Holding
    } else if has(&[4]) {
        Table::Input
    } else if has(&[1, 5, 15]) {
        Table::Coil
    } else if has(&[2]) {
        Table::Discrete
    } else {
        return None;
    };
    let access = match (has(&[1, 2, 3, 4]), has(&[5, 6, 15, 16, 22, 23])) {
        (true, true) => "rw",
        (false, _) => "wo",
        (true, false) => "ro",
    };
    Some((table, Some(access)))
}

/// Parses the index and sub-index of an object.
pub(super) fn object(index: &str, sub: &str) -> Option<(u16, Option<u8>)> {
    let (index, inner) = match index.split_once([':', '/', '.']) {
        Some((index, inner)) => (index.trim(), inner.trim()),
        None => (index.trim(), ""),
    };
    let sub = if cells::is_blank(sub) { inner } else { sub.trim() };
    let sub = match sub {
        "" => None,
        text => Some(u8::try_from(hexadecimal(text, false).or_else(|| text.parse().ok())?).ok()?),
    };
    Some((u16::try_from(hexadecimal(index, true)?).ok()?, sub))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn number(first: u32) -> Address {
        Address { first, ..Address::default() }
    }

    #[test]
    fn addresses_in_every_notation() {
        let plain = Style::default();
        let hex = Address { is_hex: true, ..number(0x1000) };
        assert_eq!(read("40001", plain), Some(number(40001)));
        assert_eq!(read("40,001", plain), Some(number(40001)));
        assert_eq!((read("0x1000", plain), read("1000h", plain)), (Some(hex), Some(hex)));
        assert_eq!(read("1000", Style { is_hex: true, ..plain }), Some(hex));
        for text in ["63-64", "63..64", "63 - 64", "63/64", "63, 64", "63 to 64", "63–64"] {
            assert_eq!(read(text, plain), Some(Address { last: Some(64), ..number(63) }), "{text}");
        }
        assert_eq!(read("10099-100", plain), Some(Address { last: Some(10100), ..number(10099) }));
        // If the end of a range has no prefix, it uses the notation of the start.
        let range = |first, last| Some(Address { last: Some(last), is_hex: true, ..number(first) });
        assert_eq!(read("0x0010-11", plain), range(0x10, 0x11));
        assert_eq!(read("0x0010-17", plain), range(0x10, 0x17));
        assert_eq!(read("0x10F0-0x10FF", plain), range(0x10F0, 0x10FF));
        assert_eq!(read("10F0-FF", Style { is_hex: true, ..plain }), range(0x10F0, 0x10FF));
        assert_eq!(read("FFFFFFFFh-FFFFFFF0h", plain), None);
        for text in ["40010.3", "40010:3", "40010 bit 3", "40010/bit3", "40010.b3"] {
            assert_eq!(read(text, plain), Some(Address { bits: Some((3, 3)), ..number(40010) }), "{text}");
        }
        assert_eq!(read("40010.0-3", plain).and_then(|address| address.bits), Some((0, 3)));
        assert_eq!(read("4x0012", plain), Some(Address { table: Some(Table::Holding), ..number(12) }));
        assert_eq!(read("HR100", plain), Some(Address { table: Some(Table::Holding), ..number(100) }));
        assert_eq!(read("40001.0", Style { is_fraction: true, ..plain }), Some(number(40001)));
        for text in ["", "x", "-1", "TBD", "99999999999", "1.x", "é-é"] {
            assert_eq!(read(text, plain), None, "{text}");
        }
        assert_eq!(Style::of(["10", "1A"].into_iter(), false), Style { is_hex: true, ..plain });
        assert!(Style::of(["0x0001", "4x0001"].into_iter(), false).is_x);
    }

    #[test]
    fn tables_masks_and_objects() {
        assert_eq!(table("Holding register"), Some((Table::Holding, None)));
        assert_eq!(table("03/06/16"), Some((Table::Holding, Some("rw"))));
        assert_eq!(table("FC04"), Some((Table::Input, Some("ro"))));
        assert_eq!(table("0x03"), Some((Table::Holding, Some("ro"))));
        assert_eq!(table("Coil"), Some((Table::Coil, None)));
        assert_eq!(table("motor"), None);
        assert_eq!((mask("0x00F0"), mask("0x0101"), mask("0x0")), (Some((4, 7)), None, None));
        assert_eq!(object("2000h", "1"), Some((0x2000, Some(1))));
        assert_eq!(object("0x6040", "-"), Some((0x6040, None)));
        assert_eq!(object("1018:02", ""), Some((0x1018, Some(2))));
        assert_eq!((object("motor", ""), object("20000", "")), (None, None));
    }
}
