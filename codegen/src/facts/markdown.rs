//! Escapes texts for the Markdown of doc comments and pages.

/// Escapes a text so that Markdown shows it literally. Characters for which `keep` is false become spaces.
pub fn escape(text: &str, keep: fn(char) -> bool) -> String {
    let mut escaped = String::with_capacity(text.len() + 8);
    let mut start = true;
    let mut letters = text.trim().chars().peekable();
    while let Some(letter) = letters.next() {
        match letter {
            '\\' | '`' | '*' | '_' | '[' | ']' | '<' | '>' | '&' | '~' | '|' | '$' | '#' | '{' | '}' => {
                escaped.push('\\');
                escaped.push(letter);
            }
            '-' | '+' | '=' | ':' if start => {
                escaped.push('\\');
                escaped.push(letter);
            }
            // In Markdown, `1.` and `1)` start a list, and `http://` starts a link.
            '.' | ')' if escaped.bytes().all(|byte| byte.is_ascii_digit()) && !escaped.is_empty() => {
                escaped.push('\\');
                escaped.push(letter);
            }
            ':' if letters.peek() == Some(&'/') => escaped.push_str("\\:"),
            _ if keep(letter) => escaped.push(letter),
            _ => escaped.push(' '),
        }
        start = false;
    }
    escaped
}
