//! Doc comments of PROFINET bindings.

pub(super) use super::super::docs::sentence;

use super::super::docs;
use crate::ir::{Documentation, Value};

/// Text as one line of Markdown without any markup; empty where nothing of it can be shown.
pub(super) fn escape(text: &str) -> String {
    docs::escape(text).trim().to_owned()
}

/// What the source says of `name` in words, a paragraph a line. Many sources only repeat the name.
pub(super) fn paragraphs(name: &str, documentation: Option<&Documentation>, lines: &mut Vec<String>) {
    let Some(documentation) = documentation.filter(|documentation| documentation.text.trim() != name.trim()) else {
        return;
    };
    for paragraph in documentation.text.lines().map(escape).filter(|line| !line.is_empty()) {
        lines.push(String::new());
        lines.push(paragraph);
    }
}

/// `title` with `facts` behind it, as one sentence.
pub(super) fn titled(title: &str, facts: &str) -> String {
    let title = escape(title);
    match title.trim_end_matches(['.', ':']) {
        "" => sentence(facts),
        title => sentence(&format!("{title}: {facts}")),
    }
}

/// `1 byte`, `2 bytes`.
pub(super) fn bytes(count: u32) -> String {
    format!("{count} byte{}", if count == 1 { "" } else { "s" })
}

/// A value as text.
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
