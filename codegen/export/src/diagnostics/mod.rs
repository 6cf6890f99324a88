//! Diagnostics for other programs: JSON lines and SARIF.
//!
//! The functions do not panic if a span of a diagnostic is outside its file.

pub mod json;
pub mod sarif;

use lexibus_codegen::text::steers;

/// Escapes control characters in a JSON text. JSON allows some control characters in strings, but a terminal would
/// interpret them.
///
/// Control characters occur only in strings, where the escape sequence has the same meaning.
pub(crate) fn escaped(json: String) -> String {
    if !json.contains(steers) {
        return json;
    }
    let mut text = String::with_capacity(json.len() + 16);
    for c in json.chars() {
        if steers(c) {
            text += &format!("\\u{:04x}", u32::from(c));
        } else {
            text.push(c);
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use lexibus_codegen::diagnostics::{codes, Diagnostic};
    use lexibus_codegen::source::{FileId, Source, Span};

    use super::{json, sarif};

    #[test]
    fn no_span_panics() {
        let text = "a=\r\n\u{e9}\t\u{20ac}\u{6f22}\u{1f469}\u{200d}\u{1f680}\r\u{1b}[;\n\u{fdd0}";
        let sources = [Source::new("a.eds", text.into())];
        let length = text.len() as u32 + 3;
        for (start, end) in (0..length).flat_map(|start| (0..length).map(move |end| (start, end))) {
            let span = Span::new(FileId(0), start, end);
            let diagnostic = Diagnostic::new(&codes::OCTAL_NUMBER, span, "message").note_at(span, "note").fix("10");
            assert!(!json::line(&diagnostic, &sources).contains('\n'));
            assert!(serde_json::from_str::<serde_json::Value>(&sarif::document(&[diagnostic], &sources, "")).is_ok());
        }
    }
}
