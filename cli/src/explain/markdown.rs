//! Writes the catalog of diagnostic codes as Markdown.

use lexibus_codegen::diagnostics::codes::CODES;
use lexibus_codegen::diagnostics::Code;

use super::example::example;
use super::{level, strictness};

/// Families of codes: the letters that start their codes, and their headings.
const FAMILIES: [(&str, &str); 12] = [
    ("IO", "Input files and selection"),
    ("EDS", "EDS and DCF"),
    ("XML", "XML files of any format"),
    ("ESI", "ESI"),
    ("XDD", "XDD and XDC"),
    ("GSD", "GSDML"),
    ("PDO", "PDOs"),
    ("TAB", "Register tables, and checks for all formats"),
    ("MSG", "Command protocols"),
    ("MOD", "Modules of a CANopen device"),
    ("NET", "CANopen networks"),
    ("CSV", "Register lists (CSV)"),
];

/// Returns the catalog. The catalog has one chapter per family and one section per code. The code is the anchor of the
/// section.
pub fn catalog() -> String {
    let mut text = String::from(
        "# The catalog of codes\n\nThis page is the output of `lexibus explain --format markdown`. \
         [Diagnostics](diagnostics.md) explains classes and levels, and how to set a level. \
         Each family lists errors first, then repairs, then lints.\n\n\
         | codes | subject |\n|---|---|\n",
    );
    for (family, about) in FAMILIES {
        text += &format!("| [{family}](#{family}) | {about} |\n");
    }
    for (family, about) in FAMILIES {
        text += &format!("\n<a id=\"{family}\"></a>\n\n## {about}\n");
        let mut codes: Vec<&Code> = CODES.iter().copied().filter(|code| self::family(code) == family).collect();
        codes.sort_by_key(|code| code.class);
        for code in codes {
            text.push('\n');
            text += &explain(code);
        }
    }
    text
}

/// Returns the section of the catalog that describes a code. The code is the anchor of the section.
pub fn explain(code: &Code) -> String {
    let (class, summary) = (code.class.name(), escaped(code.summary));
    let mut text = format!("<a id=\"{}\"></a>\n\n### {}: {}\n\n", code.id, code.id, code.name);
    text += &format!("**{summary}**\n\nClass: {class} ({}). Level: {}.\n", strictness(code.class), level(code));
    for paragraph in code.explanation.lines().filter(|line| !line.is_empty()) {
        text += &format!("\n{}\n", escaped(paragraph));
    }
    if let Some(example) = example(code) {
        text += &format!("\n```text\n{example}\n```\n");
    }
    text
}

/// Returns the family of a code: the letters before its number.
fn family(code: &Code) -> &'static str {
    code.id.trim_end_matches(|letter: char| letter.is_ascii_digit())
}

/// Escapes the markup in a text, except in code between pairs of backticks.
fn escaped(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len() + 8);
    let is_paired = text.matches('`').count().is_multiple_of(2);
    let mut in_code = false;
    for letter in text.chars() {
        match letter {
            '`' if is_paired => in_code = !in_code,
            '\\' | '`' | '*' | '_' | '[' | ']' | '<' | '>' | '|' | '#' | '&' | '~' if !in_code => escaped.push('\\'),
            _ => {}
        }
        escaped.push(letter);
    }
    escaped
}

#[cfg(test)]
mod tests {
    use lexibus_codegen::diagnostics::codes;

    use super::*;

    #[test]
    fn a_code_is_a_section() {
        let text = explain(&codes::OCTAL_NUMBER);
        let (text, example) = text.split_once("\n```text\n").expect("an example");
        assert!(example.starts_with("warning[EDS020]: ") && example.ends_with("\n```\n"), "{example}");
        insta::assert_snapshot!(text, @r#"
        <a id="EDS020"></a>

        ### EDS020: octal-number

        **a number with a leading zero is octal**

        Class: repair (an error in strict mode). Level: warn.

        In CiA 306, as in C, `012` is the octal number 10. Few authors intend an octal number. Lexibus follows the standard and reads the number as octal. Write the number in decimal or as `0x…`.
        "#);
    }

    #[test]
    fn every_code_is_in_the_catalog() {
        let text = catalog();
        for code in CODES {
            assert_eq!(text.matches(&format!("<a id=\"{}\"></a>", code.id)).count(), 1, "{}", code.id);
        }
        for (family, _) in FAMILIES {
            assert!(CODES.iter().any(|code| self::family(code) == family), "{family} has no code");
        }
    }

    #[test]
    fn words_are_not_markup() {
        assert_eq!(escaped("[1000] and `<index>sub<n>`"), "\\[1000\\] and `<index>sub<n>`");
        assert_eq!(escaped("a ` alone"), "a \\` alone");
    }
}
