//! The manuals that tables were transcribed from.

use std::path::Path;

/// The text of a manual; `None`, and a message, where it isn't beside the repository.
pub fn text(name: &str) -> Option<String> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../shared/manuals").join(name);
    let text = std::fs::read_to_string(path).ok();
    if text.is_none() {
        eprintln!("skipped: the manual isn't beside the repository");
    }
    text
}
