//! Texts on documentation pages. The templates escape these texts.

pub(super) use lexibus_codegen::facts::words::{one_line, PLAIN};
use lexibus_codegen::ir::{Documentation, Texts};

/// Returns the name of a state or command in words: `switch on disabled` for the identifier `switch_on_disabled`. Names that are no
/// identifiers in lower case stay.
pub(super) fn readable(name: &str) -> String {
    let is_identifier = name.chars().all(|letter| letter.is_lowercase() || letter.is_ascii_digit() || letter == '_');
    if is_identifier {
        name.replace('_', " ").trim().to_owned()
    } else {
        name.to_owned()
    }
}

/// Returns the language and text of each translated name.
pub(super) fn names(names: &Texts) -> Vec<(String, String)> {
    names.iter().map(|name| (name.language.to_string(), name.text.to_string())).collect()
}

/// Returns the language and text of each translated description.
pub(super) fn translations(documentation: Option<&Documentation>) -> Vec<(String, String)> {
    documentation.map(|documentation| names(&documentation.translations)).unwrap_or_default()
}
