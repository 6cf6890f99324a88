//! What every fuzz target does with a file.

#[path = "../../../cli/tests/exercise/mod.rs"]
mod exercise;

use lexibus_codegen::source::Source;

/// Reads, checks, renders, exports and emits `bytes` as a file called `name`; nothing of it may panic.
pub fn everything(name: &str, bytes: &[u8]) {
    exercise::exercise(name, bytes);
}

/// The same for `description`, corrected by a table of these bytes.
pub fn overlaid(name: &str, description: &str, bytes: &[u8]) {
    exercise::exercise_with(name, description.as_bytes(), vec![Source::new("fuzz.overlay.toml", bytes.to_vec())]);
}
