//! Prints the explanation of a code, or the catalog of all codes.

use lexibus_codegen::diagnostics::codes::CODES;
use lexibus_codegen::diagnostics::{Class, Code, Level};

use super::example;

/// Maximum line width of wrapped text.
const COLUMNS: usize = 80;

/// Returns the explanation of a code, wrapped at 80 columns, with an example if there is one.
pub fn explain(code: &Code) -> String {
    let (class, strictness) = (code.class.name(), strictness(code.class));
    let mut text = wrapped(&format!("{}: {}", code.id, code.summary));
    text += &format!("\nname:   {}\nclass:  {class} ({strictness})\nlevel:  {}\n", code.name, level(code));
    for paragraph in code.explanation.lines().filter(|line| !line.is_empty()) {
        text.push('\n');
        text += &wrapped(paragraph);
    }
    if let Some(example) = example::example(code) {
        text += &format!("\nexample:\n\n{example}\n");
    }
    text
}

/// Returns one line per code: identifier, name, class, default level and summary.
pub fn catalog() -> String {
    let width = |column: fn(&Code) -> &str| CODES.iter().map(|code| column(code).len()).max().unwrap_or(0);
    let (ids, names) = (width(|code| code.id), width(|code| code.name));
    let line = |code: &&Code| {
        let (class, level) = (code.class.name(), level(code));
        format!("{:ids$}  {:names$}  {class:6}  {level:5}  {}\n", code.id, code.name, code.summary)
    };
    CODES.iter().map(line).collect()
}

/// Returns a phrase that states when diagnostics of a class are errors.
pub(super) fn strictness(class: Class) -> &'static str {
    match class {
        Class::Error => "always an error",
        Class::Repair => "an error in strict mode",
        Class::Lint => "an error only if its level is deny",
    }
}

/// Returns the default level of a code in the notation of the command line.
pub(super) fn level(code: &Code) -> &'static str {
    match code.default {
        Level::Allow => "allow",
        Level::Warn => "warn",
        Level::Deny => "deny",
    }
}

/// Wraps a text at [`COLUMNS`] characters. Each line ends with a line feed. Words that are longer than a line are not split.
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
        let text = explain(&codes::OCTAL_NUMBER);
        let (text, example) = text.split_once("\nexample:\n\n").expect("an example");
        assert!(example.starts_with("warning[EDS020]: "), "{example}");
        insta::assert_snapshot!(text, @r"
        EDS020: a number with a leading zero is octal

        name:   octal-number
        class:  repair (an error in strict mode)
        level:  warn

        In CiA 306, as in C, `012` is the octal number 10. Few authors intend an octal
        number. Lexibus follows the standard and reads the number as octal. Write the
        number in decimal or as `0x…`.
        ");
        for code in codes::CODES {
            let text = explain(code);
            let (text, _) = text.split_once("\nexample:").unwrap_or((&text, ""));
            assert!(text.lines().all(|line| line.chars().count() <= COLUMNS), "{text}");
        }
    }

    #[test]
    fn the_catalog_has_a_line_per_code() {
        let catalog = catalog();
        assert_eq!(catalog.lines().count(), codes::CODES.len());
        let columns = |id: &str| {
            let line = catalog.lines().find(|line| line.starts_with(id)).unwrap();
            line.split_whitespace().take(4).collect::<Vec<_>>().join(" ")
        };
        assert_eq!(columns("EDS020"), "EDS020 octal-number repair warn");
    }
}
