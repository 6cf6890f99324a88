//! What `lexibus explain` prints: a code, or the catalogue of codes; for people, or as Markdown.

pub mod markdown;

use lexibus_codegen::diagnostics::codes::CODES;
use lexibus_codegen::diagnostics::{Class, Code, Level};

/// The width to which [`explain`] wraps.
const COLUMNS: usize = 80;

/// What `lexibus explain` prints about a code, wrapped at 80 columns and ended by a line feed.
pub fn explain(code: &Code) -> String {
    let (class, strictness) = (code.class.name(), strictness(code.class));
    let mut text = wrapped(&format!("{}: {}", code.id, code.summary));
    text += &format!("\nname:   {}\nclass:  {class} ({strictness})\nlevel:  {}\n", code.name, level(code));
    for paragraph in code.explanation.lines().filter(|line| !line.is_empty()) {
        text.push('\n');
        text += &wrapped(paragraph);
    }
    text
}

/// Every code on a line of its own: identifier, name, class, default level, summary.
pub fn catalogue() -> String {
    let width = |column: fn(&Code) -> &str| CODES.iter().map(|code| column(code).len()).max().unwrap_or(0);
    let (ids, names) = (width(|code| code.id), width(|code| code.name));
    let line = |code: &&Code| {
        let (class, level) = (code.class.name(), level(code));
        format!("{:ids$}  {:names$}  {class:6}  {level:5}  {}\n", code.id, code.name, code.summary)
    };
    CODES.iter().map(line).collect()
}

/// When findings of this class are errors.
fn strictness(class: Class) -> &'static str {
    match class {
        Class::Error => "always an error",
        Class::Repair => "an error in strict mode",
        Class::Lint => "an error only where its level says so",
    }
}

/// The default level as a user would set it.
fn level(code: &Code) -> &'static str {
    match code.default {
        Level::Allow => "allow",
        Level::Warn => "warn",
        Level::Deny => "deny",
    }
}

/// `text` in lines of at most [`COLUMNS`] characters, each ended by a line feed; a longer word stays whole.
fn wrapped(text: &str) -> String {
    let (mut lines, mut column) = (String::with_capacity(text.len() + 1), 0);
    for word in text.split_whitespace() {
        let width = word.chars().count();
        if column > 0 && column + 1 + width > COLUMNS {
            lines.push('\n');
            column = 0;
        } else if column > 0 {
            lines.push(' ');
            column += 1;
        }
        lines += word;
        column += width;
    }
    lines.push('\n');
    lines
}

#[cfg(test)]
mod tests {
    use lexibus_codegen::diagnostics::codes;

    use super::*;

    #[test]
    fn a_code_is_explained_in_80_columns() {
        insta::assert_snapshot!(explain(&codes::OCTAL_NUMBER), @r"
        EDS020: a number starts with 0 and so is octal

        name:   octal-number
        class:  repair (an error in strict mode)
        level:  warn

        In CiA 306, as in C, `012` is the octal number 10. Few authors mean that. Write
        the number in decimal or as `0x…`.
        ");
        for code in codes::CODES {
            let text = explain(code);
            assert!(text.lines().all(|line| line.chars().count() <= COLUMNS), "{text}");
        }
    }

    #[test]
    fn the_catalogue_has_a_line_a_code() {
        let catalogue = catalogue();
        assert_eq!(catalogue.lines().count(), codes::CODES.len());
        let columns = |id: &str| {
            let line = catalogue.lines().find(|line| line.starts_with(id)).unwrap();
            line.split_whitespace().take(4).collect::<Vec<_>>().join(" ")
        };
        assert_eq!(columns("EDS020"), "EDS020 octal-number repair warn");
    }
}
