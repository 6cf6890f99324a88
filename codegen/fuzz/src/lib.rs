//! Functions that all fuzz targets share.

#[path = "../../../cli/tests/exercise/mod.rs"]
mod exercise;

use lexibus_codegen::source::Source;

/// Compiles `bytes` as a file with this name, generates Rust, exports and documentation, and renders the diagnostics.
/// None of these steps may panic.
pub fn everything(name: &str, bytes: &[u8]) {
    exercise::exercise(name, bytes);
}

/// Runs the steps of `everything` for `description` with `bytes` as an overlay.
pub fn overlaid(name: &str, description: &str, bytes: &[u8]) {
    exercise::exercise_with(name, description.as_bytes(), vec![Source::new("fuzz.overlay.toml", bytes.to_vec())]);
}
