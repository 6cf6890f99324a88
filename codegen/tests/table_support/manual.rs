//! Reads the manuals from which dictionaries were transcribed.

#[allow(clippy::duplicate_mod, reason = "a program may load several modules that look for the repository")]
#[path = "../../../tests/support/root.rs"]
mod root;

/// Returns the text of a manual. The manuals are outside the repository. If the manual is missing, prints a message and
/// returns `None`.
pub fn text(name: &str) -> Option<String> {
    let path = root::root().join("../shared/manuals").join(name);
    let text = std::fs::read_to_string(path).ok();
    if text.is_none() {
        eprintln!("skipped: the manual is not next to the repository");
    }
    text
}
