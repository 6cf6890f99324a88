//! Reads the manuals from which tables were transcribed.

#[allow(clippy::duplicate_mod, reason = "a program may load several modules that look for the repository")]
#[path = "../../../tests/support/root.rs"]
mod root;

/// Returns the text of a manual; `None`, with a message, if it is not next to the repository.
pub fn text(name: &str) -> Option<String> {
    let path = root::root().join("../shared/manuals").join(name);
    let text = std::fs::read_to_string(path).ok();
    if text.is_none() {
        eprintln!("skipped: the manual is not next to the repository");
    }
    text
}
