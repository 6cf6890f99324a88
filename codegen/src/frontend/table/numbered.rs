//! Register numbers that manuals print in texts, or in place of item names, such as "replaced by register 10015".

use std::collections::BTreeSet;

use compact_str::CompactString;

use super::notation;
use super::tree::Reader;
use crate::diagnostics::codes;
use crate::ir::{texts, Device};
use crate::source::Span;
use crate::text::brief;

/// Maximum number of items that a diagnostic message lists by name.
const MAX_LISTED: usize = 4;

/// Item with its first and last register number.
pub(super) struct Numbered {
    pub first: u32,
    pub last: u32,
    pub name: CompactString,
}

/// Reports a register number or a range of register numbers in place of an item name. Returns `false` for any other text,
/// and if `list` is empty.
pub(super) fn report(reader: &mut Reader<'_, '_>, list: &[Numbered], text: &str, span: Span) -> bool {
    let Some((first, last)) = notation::registers(text).filter(|_| !list.is_empty() && !text.starts_with("0x")) else {
        return false;
    };
    let found: Vec<&str> =
        list.iter().filter(|item| item.first <= last && first <= item.last).map(|item| brief(&item.name)).collect();
    let text = brief(text);
    let (message, help) = match found.as_slice() {
        [] => (format!("the table has no register {text}"), "write the name of an item".to_owned()),
        [one] => {
            (format!("`{text}` is a register number, but the name of an item is expected"), format!("write `{one}`"))
        }
        several => {
            let names: Vec<String> = several.iter().take(MAX_LISTED).map(|name| format!("`{name}`")).collect();
            let rest = several.len().saturating_sub(MAX_LISTED);
            let more = if rest > 0 { format!(" and {rest} more") } else { String::new() };
            let message = format!("several items have the registers {text}: {}{more}", names.join(", "));
            (message, "write the name of the correct item, and a `doubt`".to_owned())
        }
    };
    reader.diagnostics.push(codes::UNRESOLVED_NAME.at(span, message).help(help));
    true
}

/// Reports register numbers that a text mentions, but that no row of the table has.
pub(super) fn mentioned(reader: &mut Reader<'_, '_>, list: &[Numbered], device: &Device) {
    if list.is_empty() {
        return;
    }
    // The ranges are sorted by their first number. The end of each range is raised to the maximum of all ends before it. A number
    // then exists if the last range that starts at or below the number includes it.
    let mut ranges: Vec<(u32, u32)> = list.iter().map(|item| (item.first, item.last)).collect();
    ranges.sort_unstable();
    let mut last = 0;
    for range in &mut ranges {
        last = range.1.max(last);
        range.1 = last;
    }
    let mut reported = BTreeSet::new();
    for text in texts::all(device) {
        for number in mentions(text.words) {
            let below = ranges.partition_point(|(first, _)| *first <= number);
            let exists = ranges.get(..below).and_then(<[_]>::last).is_some_and(|(_, last)| *last >= number);
            if !exists && reported.insert((text.span, number)) {
                let message = format!("a text mentions register {number}, which the table does not have");
                reader.report(&codes::MENTIONED_OBJECT, text.span, message);
            }
        }
    }
}

/// Returns the register numbers in a text, and the first number of each range. A word such as `register` precedes each
/// number or range: `register 10015`, `registro 10086-87`. Numbers with only one digit are ignored.
fn mentions(text: &str) -> impl Iterator<Item = u32> + '_ {
    const WORDS: [&str; 4] = ["register", "registers", "registro", "registri"];
    let words = text.split(|c: char| c.is_whitespace() || matches!(c, '(' | ')' | '<' | '>'));
    let pairs = words.clone().zip(words.skip(1));
    pairs.filter(|(word, _)| WORDS.contains(&word.to_lowercase().as_str())).filter_map(|(_, number)| {
        let number = number.trim_end_matches(['.', ',', ';', ':']);
        let is_number = number.chars().all(|c| c.is_ascii_digit() || c == '-') && number.len() >= 2;
        notation::registers(number).filter(|_| is_number).map(|(first, _)| first)
    })
}

#[cfg(test)]
mod tests {
    use super::mentions;

    #[test]
    fn only_numbers_after_the_word_are_registers() {
        let found = |text| mentions(text).collect::<Vec<_>>();
        assert_eq!(found("Da firmware 6 sostituito da registro 10015"), [10015]);
        assert_eq!(found("see registers 10086-87, and Register 63."), [10086, 63]);
        assert_eq!(found("register 5, register 0x20, register 12V, registered 100, 100 registers, register"), [0; 0]);
    }
}
