//! Documentation of PROFINET bindings.

pub(super) use super::super::docs::sentence;

use super::super::docs;
use crate::ir::{Documentation, Value};

/// Escapes a text of one line so that Markdown shows it literally. The result is empty if no character can be shown.
pub(super) fn escape(text: &str) -> String {
    docs::escape(text).trim().to_owned()
}

/// Returns the lines of a doc comment: `first`, and the documentation of `name` with one line per paragraph. Omits a text
/// that only repeats the name.
pub(super) fn documented(first: String, name: &str, documentation: Option<&Documentation>) -> Vec<String> {
    let documentation = documentation.filter(|documentation| documentation.text.trim() != name.trim());
    let lines = documentation.into_iter().flat_map(|documentation| documentation.text.lines());
    docs::paragraphs([first].into_iter().chain(lines.map(escape).filter(|line| !line.is_empty())))
}

/// Returns a sentence that consists of `title` and `facts`.
pub(super) fn titled(title: &str, facts: &str) -> String {
    let title = escape(title);
    match title.trim_end_matches(['.', ':']) {
        "" => sentence(facts),
        title => sentence(&format!("{title}: {facts}")),
    }
}

/// Returns a value as text for documentation.
pub(super) fn value(value: &Value) -> String {
    const SHOWN: usize = 60;
    let text = value.to_string();
    if matches!(value, Value::Int(_) | Value::Real(_) | Value::Bool(_)) {
        return text;
    }
    match text.char_indices().nth(SHOWN) {
        Some((cut, _)) => format!("{} …", escape(&text[..cut])),
        None => escape(&text),
    }
}
