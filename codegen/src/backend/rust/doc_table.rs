//! Tables in doc comments.

use super::docs;
use crate::ir::Documentation;

/// Maximum number of rows in a table. A longer table would hide the text below it. Rustdoc also lists all fields and
/// variants with their documentation.
pub(super) const MAX_ROWS: usize = 64;

/// Maximum number of characters of a description in a cell. The documentation of the element contains the full
/// description.
const MAX_LETTERS: usize = 100;

/// Returns the lines of a table, preceded by an empty line. Returns no lines if the table has no rows or more than
/// [`MAX_ROWS`].
pub(super) fn table<const N: usize>(head: [&str; N], rows: &[[String; N]]) -> Vec<String> {
    if rows.len() > MAX_ROWS {
        Vec::new()
    } else {
        whole(head, rows)
    }
}

/// Returns the lines of a table of any length, or no lines if there are no rows. Use this function for facts that only
/// the table documents. Columns without text are omitted.
pub(super) fn whole<const N: usize>(head: [&str; N], rows: &[[String; N]]) -> Vec<String> {
    if rows.is_empty() {
        return Vec::new();
    }
    let used: Vec<usize> = (0..N).filter(|at| rows.iter().any(|row| !row[*at].is_empty())).collect();
    let line = |cells: &dyn Fn(usize) -> String| {
        let mut line = String::from("|");
        for at in &used {
            line.extend([" ", &cells(*at), " |"]);
        }
        line
    };
    let mut lines = vec![String::new(), line(&|at| head[at].to_owned())];
    lines.push(format!("|{}", "---|".repeat(used.len())));
    lines.extend(rows.iter().map(|row| line(&|at| row[at].clone())));
    lines
}

/// Returns a link from a struct to its field. If a method has the same name as the field, returns only the name,
/// because a link would lead to the method.
pub(super) fn field_link(name: &str, methods: &[&str]) -> String {
    match methods.contains(&name) {
        true => format!("`{name}`"),
        false => format!("[`{0}`](Self::{0})", name.trim_start_matches("r#")),
    }
}

/// Returns the text of an element for a table cell: its name, followed by the start of its documentation. The name is
/// left out if the Rust name `rust` consists of the same words.
pub(super) fn meaning(name: &str, rust: &str, documentation: Option<&Documentation>) -> String {
    let mut parts = Vec::new();
    if !is_same(name, rust) {
        parts.push(docs::sentence(&docs::escape(name)));
    }
    let text = Documentation::text_of(documentation);
    parts.push(start(text));
    parts.retain(|part| !part.trim().is_empty());
    parts.join(" ")
}

/// Returns whether a Rust name consists of the same words as the original name.
fn is_same(name: &str, rust: &str) -> bool {
    let letters = |text: &str| {
        let characters = text.chars().filter(|letter| letter.is_alphanumeric());
        characters.flat_map(char::to_lowercase).collect::<String>()
    };
    let is_plain = |letter: char| letter.is_alphanumeric() || matches!(letter, ' ' | '_' | '-' | '.');
    name.chars().all(is_plain) && letters(name) == letters(rust)
}

/// Returns a text for a table cell: one line, shortened to [`MAX_LETTERS`] characters if necessary.
fn start(text: &str) -> String {
    let text = text.split_whitespace().collect::<Vec<_>>().join(" ");
    match text.char_indices().nth(MAX_LETTERS) {
        None if text.is_empty() => text,
        None => docs::sentence(&docs::escape(&text)),
        Some((cut, _)) => {
            let whole_words = text[..cut].rfind(' ').unwrap_or(cut);
            format!("{} …", docs::escape(&text[..whole_words]))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(first: &str, second: &str) -> [String; 2] {
        [first.to_owned(), second.to_owned()]
    }

    #[test]
    fn columns_without_text_are_left_out() {
        assert_eq!(table(["A", "B"], &[row("1", ""), row("2", "")]), ["", "| A |", "|---|", "| 1 |", "| 2 |"]);
        assert_eq!(
            table(["A", "B"], &[row("1", ""), row("2", "x")])[1..],
            ["| A | B |", "|---|---|", "| 1 |  |", "| 2 | x |"]
        );
    }

    #[test]
    fn long_tables_are_omitted() {
        let rows = vec![row("1", "2"); MAX_ROWS + 1];
        assert!(table(["A", "B"], &rows).is_empty());
        assert_eq!(table(["A", "B"], &rows[1..]).len(), MAX_ROWS + 3);
        assert!(table::<1>(["A"], &[]).is_empty());
    }

    #[test]
    fn links_to_fields() {
        assert_eq!(field_link("r#type", &["pack"]), "[`type`](Self::type)");
        assert_eq!(field_link("pack", &["pack"]), "`pack`");
    }

    #[test]
    fn meanings() {
        let text = |text: &str| Documentation { text: text.into(), ..Documentation::default() };
        assert_eq!(meaning("Operation enabled", "operation_enabled", None), "");
        assert_eq!(meaning("I/O", "io", None), "I/O.");
        assert_eq!(meaning("Op. | enabled", "op_enabled_2", None), r"Op. \| enabled.");
        assert_eq!(meaning("Fault", "fault", Some(&text("a\nb | c"))), r"a b \| c.");
        let long = meaning("", "x", Some(&text(&"word ".repeat(50))));
        assert!(long.ends_with("word …") && long.len() < 110, "{long}");
    }
}
