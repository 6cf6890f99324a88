//! Texts of descriptions in doc comments.

use super::literal;
use crate::facts::markdown;
use crate::facts::words::{Words, NO_LINK};

/// Sentences for doc comments.
pub(super) const WORDS: Words<'static> = Words { escape, link: NO_LINK };

/// Text as one line of Markdown without any markup.
pub(super) fn escape(text: &str) -> String {
    markdown::escape(text, literal::is_harmless)
}
