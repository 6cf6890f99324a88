//! The manuals that tables were transcribed from.

#[allow(clippy::duplicate_mod, reason = "a program may load several modules that look for the repository")]
#[path = "../../../tests/support/root.rs"]
mod root;

/// The text of a manual; `None`, and a message, where it isn't beside the repository.
pub fn text(name: &str) -> Option<String> {
    let path = root::root().join("../shared/manuals").join(name);
    let text = std::fs::read_to_string(path).ok();
    if text.is_none() {
        eprintln!("skipped: the manual isn't beside the repository");
    }
    text
}
