//! Escaping of texts in doc comments.

use super::literal;
use crate::facts::markdown;
use crate::facts::words::{Words, NO_LINK};

/// Sentences for doc comments, without links.
pub(super) const WORDS: Words<'static> = Words { escape, link: NO_LINK };

/// Returns text as one line of Markdown without markup.
pub(super) fn escape(text: &str) -> String {
    markdown::escape(text, literal::is_harmless)
}
