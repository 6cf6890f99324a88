//! References to the texts at the end of a file.
//!
//! Before the text list is read, a name in the IR is a placeholder: the number of a reference. A space and a suffix may
//! follow the number. `resolve` replaces placeholders with texts.

use compact_str::{format_compact, CompactString, ToCompactString};

use crate::frontend::xml::Given;

/// References to texts, in the order in which they were read.
#[derive(Default)]
pub(super) struct TextReferences<'a>(Vec<Given<'a>>);

impl<'a> TextReferences<'a> {
    /// Returns the reference with the number `number`.
    pub fn get(&self, number: usize) -> Option<&Given<'a>> {
        self.0.get(number)
    }

    /// Adds a reference and returns its placeholder.
    pub fn hold(&mut self, given: Given<'a>) -> CompactString {
        let placeholder = self.0.len().to_compact_string();
        self.0.push(given);
        placeholder
    }

    /// Frees the memory that is reserved for further references.
    pub fn shrink_to_fit(&mut self) {
        self.0.shrink_to_fit();
    }
}

/// Returns a placeholder for the text of `placeholder` followed by `suffix`.
pub(super) fn with_suffix(placeholder: &str, suffix: &str) -> CompactString {
    // A placeholder is the number of a reference. Without the space, digits at the start of the suffix would be read as
    // a part of this number.
    format_compact!("{placeholder} {suffix}")
}
