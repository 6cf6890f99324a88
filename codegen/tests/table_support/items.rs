//! What the overviews of a manual's odd passages share: the lines that a doubt names.

use std::collections::BTreeSet;

/// The lines that a text names: `L12`, `L12-15`, and behind a first one also `L12, L15`.
pub fn named(text: &str, lines: &mut BTreeSet<usize>) {
    for (at, _) in text.match_indices('L') {
        let rest = &text[at + 1..];
        let end = rest.find(|c: char| !c.is_ascii_digit() && c != '-').unwrap_or(rest.len());
        let mut ends = rest[..end].split('-').map(|number| number.parse::<usize>().ok());
        if let Some(Some(first)) = ends.next() {
            let last = ends.next().flatten().filter(|&last| last >= first && last < first + 400).unwrap_or(first);
            lines.extend(first..=last);
        }
    }
}

/// The lines that the doubts of a table name in what the manual says.
pub fn doubted(table: &str) -> BTreeSet<usize> {
    let mut lines = BTreeSet::new();
    for (at, mark) in table.match_indices("says = ") {
        let rest = &table[at + mark.len()..];
        let quote = &rest[..1];
        named(rest[1..].split(quote).next().unwrap_or_default(), &mut lines);
    }
    lines
}
