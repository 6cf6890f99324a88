//! Parses lists of values or bits in a cell, such as `0=Off, 1=On` or `Bit 0: running; Bit 1: fault`.

use super::cells;

/// An entry in a list of named values or bits.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Entry {
    pub first: i128,
    /// Last number, if the entry describes a range.
    pub last: Option<i128>,
    pub is_hex: bool,
    pub name: String,
}

/// A list of named values or named bits.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct List {
    pub entries: Vec<Entry>,
    /// True if all entries of the cell are marked as bits.
    pub is_bits: bool,
}

/// The start of an entry: its numbers, and the length of this part of the text.
struct Head {
    first: i128,
    last: Option<i128>,
    is_hex: bool,
    is_bit: bool,
    length: usize,
}

/// Parses a list that starts at the beginning of the cell.
pub(super) fn read(text: &str) -> Option<List> {
    let text = text.trim().trim_matches(['{', '}', '[', ']']).trim();
    let mut heads: Vec<(usize, Head)> = Vec::new();
    let mut before = '\n';
    for (at, letter) in text.char_indices() {
        let within = heads.last().is_some_and(|(start, head)| at < start + head.length);
        let is_start = matches!(before, ',' | ';' | '|' | '/' | '\n' | '\r' | '(') || before.is_whitespace();
        if is_start && !within {
            let strict = !(at == 0 || matches!(before, '\n' | '\r') || after_mark(text, at));
            heads.extend(head(text.get(at..)?, strict).map(|head| (at, head)));
        }
        before = letter;
    }
    if heads.first().is_none_or(|(at, _)| *at != 0) {
        return None;
    }
    let mut entries = Vec::new();
    for (position, (at, head)) in heads.iter().enumerate() {
        let end = heads.get(position + 1).map_or(text.len(), |(next, _)| *next);
        let name = text.get(at + head.length..end)?;
        let marks =
            |letter: char| letter.is_whitespace() || matches!(letter, ',' | ';' | '|' | '/' | '"' | '(' | '=' | ':');
        let name = name.trim_matches(marks).split_whitespace().collect::<Vec<_>>().join(" ");
        entries.push(Entry { first: head.first, last: head.last, is_hex: head.is_hex, name });
    }
    let is_bits = heads.iter().all(|(_, head)| head.is_bit);
    entries.iter().any(|entry| !entry.name.is_empty()).then_some(List { entries, is_bits })
}

/// Returns whether the text before `at` ends with a separator between entries.
fn after_mark(text: &str, at: usize) -> bool {
    text.get(..at).is_some_and(|before| before.trim_end().ends_with([',', ';', '|', '/', '\n', '\r', '(']))
}

/// Parses the start of an entry: `0 =`, `Bit 3:`, `0x10 -`, `3..7 =`. If `strict` is set, a start that could be part of
/// a name is rejected.
fn head(text: &str, strict: bool) -> Option<Head> {
    let lower = text.get(..text.len().min(8)).unwrap_or(text).to_ascii_lowercase();
    let word = ["bits", "bit", "b", "d"].into_iter().find(|word| {
        let rest = lower.strip_prefix(word).map(|rest| rest.trim_start_matches([' ', '_', '-', '.']));
        rest.is_some_and(|rest| rest.starts_with(|digit: char| digit.is_ascii_digit()))
    });
    let rest = text.get(word.map_or(0, str::len)..)?;
    let rest = if word.is_some() { rest.trim_start_matches([' ', '_', '-', '.']) } else { rest };
    let (first, is_hex, rest) = integer(rest)?;
    let (last, rest) = match until(rest) {
        Some((last, rest)) => (Some(last), rest),
        None => (None, rest),
    };
    let blanks = rest.len() - rest.trim_start_matches(' ').len();
    let mark = rest.trim_start_matches(' ');
    let clear = ["=>", "->", "=", ":", "→", ")", "\t"].into_iter().find(|sign| mark.starts_with(sign));
    let weak = ["– ", "- "].into_iter().find(|sign| mark.starts_with(sign) && !strict);
    // In "Bit 3 running", the word "Bit" makes a separator unnecessary.
    let bare = || (word.is_some() && !strict && blanks > 0).then_some("");
    let sign = clear.or(weak).or_else(bare)?;
    let after = mark.get(sign.len()..)?;
    let (first, last) = match last {
        Some(last) => (first.min(last), Some(first.max(last)).filter(|_| first != last)),
        None => (first, None),
    };
    Some(Head { first, last, is_hex, is_bit: word.is_some(), length: text.len() - after.len() })
}

/// Parses an integer at the start of a text. Returns the integer, whether its notation is hexadecimal, and the remaining text.
fn integer(text: &str) -> Option<(i128, bool, &str)> {
    let sign = usize::from(text.starts_with('-'));
    let digits = text.get(sign..)?;
    let is_hex = digits.starts_with("0x") || digits.starts_with("0X");
    let body = if is_hex { digits.get(2..)? } else { digits };
    let is_digit = |letter: char| if is_hex { letter.is_ascii_hexdigit() } else { letter.is_ascii_digit() };
    let end = body.find(|letter: char| !is_digit(letter)).unwrap_or(body.len());
    let (number, rest) = body.split_at(end);
    // Accept `10h`, but not `10 hours`.
    let (is_hex, rest) = match rest.strip_prefix(['h', 'H']) {
        Some(after) if !after.starts_with(|letter: char| letter.is_alphanumeric()) => (true, after),
        _ => (is_hex, rest),
    };
    let value = i128::from_str_radix(number, if is_hex { 16 } else { 10 }).ok().filter(|_| number.len() <= 20)?;
    Some((if sign == 1 { -value } else { value }, is_hex, rest))
}

/// Parses the end of a range: `..7`, `-7` or ` to 7`.
fn until(text: &str) -> Option<(i128, &str)> {
    let marks = ["...", "..", "…", "~", "–", "-", " to ", " - ", " – "];
    let rest = marks.into_iter().find_map(|mark| text.strip_prefix(mark))?;
    let (last, _, rest) = integer(rest.trim_start())?;
    Some((last, rest))
}

/// Returns whether a name means that a value or bit is reserved or unused.
pub(super) fn is_reserved(name: &str) -> bool {
    const WORDS: [&str; 12] = [
        "reserved",
        "unused",
        "not used",
        "reserve",
        "res",
        "res.",
        "riservato",
        "non usato",
        "reserviert",
        "unbenutzt",
        "spare",
        "rsvd",
    ];
    cells::is_blank(name) || WORDS.contains(&name.to_lowercase().as_str())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn list(text: &str) -> Option<(bool, Vec<(i128, String)>)> {
        let list = read(text)?;
        Some((list.is_bits, list.entries.into_iter().map(|entry| (entry.first, entry.name)).collect()))
    }

    #[test]
    fn values_with_every_separator() {
        let both = Some((false, vec![(0, "Off".to_owned()), (1, "On".to_owned())]));
        for text in [
            "0=Off, 1=On",
            "0: Off; 1: On",
            "0 = Off\n1 = On",
            "0:Off|1:On",
            "0 - Off / 1 - On",
            "0=Off 1=On",
            "{0: Off, 1: On}",
            "0->Off; 1->On",
            "0x00=Off,0x01=On",
            "0) Off, 1) On",
            "0 = \"Off\", 1 = \"On\"",
        ] {
            assert_eq!(list(text), both, "{text}");
        }
        let names = list("1=Mode 2 - fast, 2=Phase L1/L2").map(|(_, names)| names);
        assert_eq!(names, Some(vec![(1, "Mode 2 - fast".to_owned()), (2, "Phase L1/L2".to_owned())]));
        assert_eq!(list("-1=error").map(|(_, names)| names), Some(vec![(-1, "error".to_owned())]));
        let range = read("3-7: reserved")
            .and_then(|list| list.entries.into_iter().next())
            .map(|entry| (entry.first, entry.last));
        assert_eq!(range, Some((3, Some(7))));
        for text in ["", "Off/On", "0..100", "speed 1=slow", "5", "é=1", "1="] {
            assert_eq!(list(text), None, "{text}");
        }
    }

    #[test]
    fn bits_with_every_prefix() {
        let both = Some((true, vec![(0, "running".to_owned()), (1, "fault".to_owned())]));
        for text in [
            "Bit 0: running; Bit 1: fault",
            "b0=running, b1=fault",
            "Bit0 running\nBit1 fault",
            "bit 0 - running, bit 1 - fault",
            "D0: running; D1: fault",
        ] {
            assert_eq!(list(text), both, "{text}");
        }
        let range = read("Bits 15-8: reserved").and_then(|list| list.entries.into_iter().next());
        assert_eq!(range.map(|entry| (entry.first, entry.last)), Some((8, Some(15))));
    }
}
