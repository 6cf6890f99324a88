//! Functions that shorten, sanitize, format and compare texts, mainly for diagnostics.

use std::borrow::Cow;
use std::fmt::Display;

/// Returns the first 64 characters of a text, for diagnostics and keys. Without this limit, long names in deeply nested elements
/// would take too much memory.
pub fn brief(text: &str) -> &str {
    const LETTERS: usize = 64;
    if text.len() <= LETTERS {
        return text;
    }
    let end = text.char_indices().nth(LETTERS).map_or(text.len(), |(at, _)| at);
    &text[..end]
}

/// Returns whether a character can control a terminal, end a line or change the direction of text.
pub fn steers(c: char) -> bool {
    matches!(c,
        '\0'..='\u{1f}' | '\u{7f}'..='\u{9f}' | '\u{61c}' | '\u{200e}' | '\u{200f}'
        | '\u{2028}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
}

/// Returns a text as one line that is safe to print. Characters that control a terminal, end a line or change the direction of text
/// become spaces.
pub fn printable(text: &str) -> Cow<'_, str> {
    match text.contains(steers) {
        true => text.chars().map(|c| if steers(c) { ' ' } else { c }).collect(),
        false => text.into(),
    }
}

/// Returns the last part of a path, with the separators of any system.
pub fn file_name(path: &str) -> &str {
    path.rsplit(['/', '\\']).next().unwrap_or(path)
}

/// Returns the Levenshtein distance: the number of characters to insert, delete or replace to get from `a` to `b`.
pub fn edit_distance(a: &str, b: &str) -> usize {
    // One row of the usual table: `row[j]` is the distance between the first `i` characters of `a` and the first `j` of `b`.
    let mut row: Vec<usize> = (0..=b.chars().count()).collect();
    for (i, from) in a.chars().enumerate() {
        let mut diagonal = row[0];
        row[0] = i + 1;
        for (j, to) in b.chars().enumerate() {
            let replaced = diagonal + usize::from(from != to);
            diagonal = row[j + 1];
            row[j + 1] = replaced.min(row[j] + 1).min(diagonal + 1);
        }
    }
    row[row.len() - 1]
}

/// Returns the most similar known name, or `None` if no name is similar.
pub fn similar<'n>(name: &str, known: impl Iterator<Item = &'n str>) -> Option<&'n str> {
    let lower = brief(name).to_lowercase();
    let best = known.map(|other| (edit_distance(&lower, &other.to_lowercase()), other)).min()?;
    (best.0 * 3 <= lower.chars().count().max(3)).then_some(best.1)
}

/// Returns a count with its noun, in the plural unless the count is 1: `1 byte`, `2 bytes`.
pub fn count_of<N: Display + PartialEq + From<u8>>(count: N, noun: &str) -> String {
    let ending = if count == N::from(1) { "" } else { "s" };
    format!("{count} {noun}{ending}")
}

/// Returns a noun with its numbers or ranges, in the plural unless there is only one number: `bit 7`, `bits 2, 4 to 6`.
pub(crate) fn numbered(noun: &str, numbers: &[String]) -> String {
    let is_one = matches!(numbers, [only] if !only.contains(' '));
    format!("{noun}{} {}", if is_one { "" } else { "s" }, numbers.join(", "))
}

/// Returns the result of the function `text` for `count`, the number of further elements. Returns an empty text if `count` is 0.
pub(crate) fn more(count: usize, text: impl FnOnce(usize) -> String) -> String {
    match count {
        0 => String::new(),
        count => text(count),
    }
}

/// Returns a standard with its clause, if any: `CiA 402, 17.3.7`.
#[cfg(feature = "table")]
pub(crate) fn standard_and_clause(standard: &str, clause: &str) -> String {
    match clause {
        "" => standard.to_owned(),
        clause => format!("{standard}, {clause}"),
    }
}

/// Returns whether `text` matches `pattern`, in which `*` matches any characters.
pub(crate) fn glob(pattern: &str, text: &str) -> bool {
    let Some((head, rest)) = pattern.split_once('*') else { return pattern == text };
    let Some(mut text) = text.strip_prefix(head) else { return false };
    let mut parts = rest.split('*').peekable();
    while let Some(part) = parts.next() {
        if parts.peek().is_none() {
            return text.ends_with(part);
        }
        let Some(at) = text.find(part) else { return false };
        text = &text[at + part.len()..];
    }
    true
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nouns_are_plural_unless_the_count_is_one() {
        assert_eq!([count_of(0u8, "byte"), count_of(1u64, "PDO")], ["0 bytes", "1 PDO"]);
        let numbers = ["7", "2 to 3"].map(str::to_owned);
        assert_eq!(numbered("bit", &numbers[..1]), "bit 7");
        assert_eq!(numbered("bit", &numbers[1..]), "bits 2 to 3");
        assert_eq!(numbered("value", &numbers), "values 7, 2 to 3");
    }

    #[test]
    fn patterns() {
        for (pattern, text) in
            [("a*", "abc"), ("*c", "abc"), ("a*c", "abc"), ("*", ""), ("a**b", "axb"), ("*b*", "abc")]
        {
            assert!(glob(pattern, text), "{pattern} {text}");
        }
        for (pattern, text) in [("a*", "bc"), ("*b", "abc"), ("a*b*c", "acb"), ("ab", "abc"), ("ab*ba", "aba")] {
            assert!(!glob(pattern, text), "{pattern} {text}");
        }
    }

    #[test]
    fn insertions_deletions_and_replacements_count_one_each() {
        assert_eq!(edit_distance("", ""), 0);
        assert_eq!(edit_distance("", "abc"), 3);
        assert_eq!(edit_distance("abc", ""), 3);
        assert_eq!(edit_distance("abc", "abc"), 0);
        assert_eq!(edit_distance("octal-numer", "octal-number"), 1);
        assert_eq!(edit_distance("kitten", "sitting"), 3);
        assert_eq!(edit_distance("ab", "ba"), 2);
    }

    #[test]
    fn characters_count_not_bytes() {
        assert_eq!(edit_distance("Gerät", "Gerat"), 1);
        assert_eq!(edit_distance("€", "µ"), 1);
    }

    #[test]
    fn the_distance_is_symmetric() {
        for (a, b) in [("saturday", "sunday"), ("a", "abcd"), ("xyz", "")] {
            assert_eq!(edit_distance(a, b), edit_distance(b, a));
        }
    }
}
