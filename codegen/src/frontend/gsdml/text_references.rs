//! References to texts, which are at the end of a file.
//!
//! Until the text list is read, a name in the IR is a placeholder: the number of a reference, perhaps with a suffix after a blank.
//! `resolve` replaces placeholders by texts.

use compact_str::{format_compact, CompactString, ToCompactString};

use crate::frontend::xml::Given;

/// References to texts, in the order in which they were read.
#[derive(Default)]
pub(super) struct TextReferences<'a>(Vec<Given<'a>>);

impl<'a> TextReferences<'a> {
    /// The reference with this number.
    pub fn get(&self, number: usize) -> Option<&Given<'a>> {
        self.0.get(number)
    }

    /// The placeholder of the text with this identifier.
    pub fn hold(&mut self, given: Given<'a>) -> CompactString {
        let placeholder = self.0.len().to_compact_string();
        self.0.push(given);
        placeholder
    }
}

/// The placeholder of the same text as `placeholder`, followed by `suffix`.
pub(super) fn with_suffix(placeholder: &str, suffix: &str) -> CompactString {
    // Without a text, the blank in front tells the suffix from a number.
    format_compact!("{placeholder} {suffix}")
}
