//! Escapes texts of a description for the source code of a new crate.

use lexibus_codegen::text::printable;

/// Returns a text for a doc comment. Markdown and HTML in the text are escaped.
pub(super) fn doc(text: &str) -> String {
    let mut escaped = String::new();
    for letter in printable(text).chars() {
        if letter.is_ascii_punctuation() && !",.;:-+/%()=\"'".contains(letter) {
            escaped.push('\\');
        }
        escaped.push(letter);
    }
    escaped
}

/// Returns a string literal, which is valid in Rust and in TOML.
pub(super) fn literal(text: &str) -> String {
    format!("\"{}\"", escaped(text))
}

/// Returns a literal for the macro `println`: `text`, and the variable or number `value`.
pub(super) fn printed(text: &str, value: &str) -> String {
    let text = escaped(&text.replace('{', "{{").replace('}', "}}"));
    format!("\"{text}: {value}\"")
}

fn escaped(text: &str) -> String {
    printable(text).replace('\\', "\\\\").replace('"', "\\\"")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_cannot_leave_their_place() {
        assert_eq!(doc("Drive [a](b) <c>\n*x*"), "Drive \\[a\\](b) \\<c\\> \\*x\\*");
        assert_eq!(literal("a\"b\\c\nd"), "\"a\\\"b\\\\c d\"");
        assert_eq!(printed("a {b} \"c\"", "{value}"), "\"a {{b}} \\\"c\\\": {value}\"");
    }
}
