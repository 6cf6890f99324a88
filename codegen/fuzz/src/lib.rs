//! Common parts of the fuzz targets.

#[path = "../../../cli/tests/exercise/mod.rs"]
mod exercise;

use lexibus_codegen::source::Source;

/// Reads, checks, renders, exports and compiles `bytes` as a file with this name. Nothing may panic.
pub fn everything(name: &str, bytes: &[u8]) {
    exercise::exercise(name, bytes);
}

/// Like the function above, for `description` with an overlay of these bytes.
pub fn overlaid(name: &str, description: &str, bytes: &[u8]) {
    exercise::exercise_with(name, description.as_bytes(), vec![Source::new("fuzz.overlay.toml", bytes.to_vec())]);
}
