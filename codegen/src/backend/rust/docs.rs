//! Doc comments: what the source says, so that Markdown shows it as it is.

use std::fmt::Write;

use super::literal;
use super::scope::Scope;
use super::value_type;
use crate::ir::{Item, Limits, Type, Value};

/// Text as one line of Markdown without any markup.
pub(super) fn escape(text: &str) -> String {
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
            // `1.` and `1)` would begin a list, `http://` a link.
            '.' | ')' if escaped.bytes().all(|byte| byte.is_ascii_digit()) && !escaped.is_empty() => {
                escaped.push('\\');
                escaped.push(letter);
            }
            ':' if letters.peek() == Some(&'/') => escaped.push_str("\\:"),
            _ if literal::is_harmless(letter) => escaped.push(letter),
            _ => escaped.push(' '),
        }
        start = false;
    }
    escaped
}

/// The lines about an item: its name, then its address, type, access and values.
pub(super) fn item(item: &Item, name: &str, scope: &Scope<'_>) -> Vec<String> {
    let mut lines = Vec::with_capacity(4);
    if !name.trim().is_empty() {
        lines.push(sentence(&escape(name)));
        lines.push(String::new());
    }
    lines.push(facts(item, scope));
    documentation(item, &mut lines);
    lines
}

fn facts(item: &Item, scope: &Scope<'_>) -> String {
    let base = scope.base(item.ty);
    let mut line = String::with_capacity(64);
    if let Some((index, sub)) = item.object() {
        let _ = write!(line, "0x{index:04X}:{sub:02X}, ");
    }
    let _ = write!(line, "{base}, {}", item.access.name());
    match (item.mappable.rpdo, item.mappable.tpdo) {
        (true, true) => line.push_str(", mappable into any PDO"),
        (true, false) => line.push_str(", mappable into RPDOs"),
        (false, true) => line.push_str(", mappable into TPDOs"),
        (false, false) => {}
    }
    if let Some(default) = &item.default {
        let _ = write!(line, ", default {}", typed(default, base));
    }
    if let Some(range) = limits(&item.limits) {
        let _ = write!(line, ", {range}");
    }
    if let Some(quantity) = item.quantity.as_ref().filter(|quantity| !quantity.unit.is_empty()) {
        let _ = write!(line, ", in {}", escape(&quantity.unit));
    }
    if let Some(configured) = item.configured.as_ref().and_then(|configured| configured.value.as_ref()) {
        let _ = write!(line, ", configured to {}", typed(configured, base));
    }
    line.push('.');
    line
}

fn typed(shown: &Value, ty: Type) -> String {
    match shown {
        Value::Int(number) => value_type::number(*number, matches!(ty, Type::Unsigned(_))),
        other => value(other),
    }
}

fn value(value: &Value) -> String {
    const SHOWN: usize = 60;
    let text = value.to_string();
    match text.char_indices().nth(SHOWN) {
        Some((cut, _)) => format!("{} …", escape(&text[..cut])),
        None => escape(&text),
    }
}

fn limits(limits: &Limits) -> Option<String> {
    let depends = [&limits.low, &limits.high].into_iter().any(|limit| matches!(limit, Some(Value::NodeId(_))));
    let text = match (&limits.low, &limits.high) {
        (Some(low), Some(high)) => Some(format!("range {} to {}", value(low), value(high))),
        (Some(low), None) => Some(format!("at least {}", value(low))),
        (None, Some(high)) => Some(format!("at most {}", value(high))),
        (None, None) => None,
    };
    // What depends on the node-ID is known only at run time.
    text.map(|text| if depends { text + " (not checked)" } else { text })
}

fn documentation(item: &Item, lines: &mut Vec<String>) {
    let denotation = item.configured.as_ref().and_then(|configured| configured.denotation.as_ref());
    if let Some(denotation) = denotation {
        lines.push(String::new());
        lines.push(format!("Denotation: {}", sentence(&escape(denotation))));
    }
    let Some(documentation) = &item.documentation else { return };
    for paragraph in documentation.text.lines().filter(|line| !line.trim().is_empty()) {
        lines.push(String::new());
        lines.push(escape(paragraph));
    }
}

/// `text` with a full stop, where it has none.
pub(super) fn sentence(text: &str) -> String {
    match text.ends_with(['.', '!', '?', ':']) {
        true => text.to_owned(),
        false => format!("{text}."),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn markup_is_shown_not_obeyed() {
        assert_eq!(escape("a[b] <i> `x` *y*"), r"a\[b\] \<i\> \`x\` \*y\*");
        assert_eq!(escape("- 1"), r"\- 1");
        assert_eq!(escape("1. x"), r"1\. x");
        assert_eq!(escape("see https://x"), r"see https\://x");
        assert_eq!(escape("a\u{202e}b\nc"), "a b c");
    }
}
