//! Escapes texts for doc comments.

use super::literal;
use crate::facts::markdown;
use crate::facts::words::{Words, NO_LINK};

/// Builder of sentences for doc comments. The sentences have no links.
pub(super) const WORDS: Words<'static> = Words { escape, link: NO_LINK };

/// Converts a text to one line of Markdown without markup.
pub(super) fn escape(text: &str) -> String {
    markdown::escape(text, literal::is_harmless)
}
