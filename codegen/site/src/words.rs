//! Texts of documentation pages. The templates escape them.

pub(super) use lexibus_codegen::facts::words::{one_line, PLAIN};
use lexibus_codegen::ir::{Documentation, Texts};

/// Returns a name in other languages.
pub(super) fn names(names: &Texts) -> Vec<(String, String)> {
    names.iter().map(|name| (name.language.to_string(), name.text.to_string())).collect()
}

/// Returns a description in other languages.
pub(super) fn translations(documentation: Option<&Documentation>) -> Vec<(String, String)> {
    documentation.map(|documentation| names(&documentation.translations)).unwrap_or_default()
}

/// Returns at most `letters` letters of a text. `…` is the last one of a longer text.
pub(super) fn cut(text: &str, letters: usize) -> String {
    match text.chars().count() {
        count if count <= letters => text.to_owned(),
        _ => text.chars().take(letters.saturating_sub(1)).chain(['…']).collect(),
    }
}
