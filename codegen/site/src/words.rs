//! Words of documentation pages. Templates escape them.

pub(super) use lexibus_codegen::facts::words::{one_line, PLAIN};
use lexibus_codegen::ir::{Documentation, Texts};

/// A name in other languages.
pub(super) fn names(names: &Texts) -> Vec<(String, String)> {
    names.iter().map(|name| (name.language.to_string(), name.text.to_string())).collect()
}

/// A description in other languages.
pub(super) fn translations(documentation: Option<&Documentation>) -> Vec<(String, String)> {
    documentation.map(|documentation| names(&documentation.translations)).unwrap_or_default()
}

/// So many letters of a text, the last one being `…` where there are more.
pub(super) fn cut(text: &str, letters: usize) -> String {
    match text.chars().count() {
        count if count <= letters => text.to_owned(),
        _ => text.chars().take(letters.saturating_sub(1)).chain(['…']).collect(),
    }
}
