//! The lexer for EDS and DCF files.
//!
//! A [`Document`] holds the list of sections, the comments above the first section, and the violations of the grammar. All parts of
//! the document are spans of the text. The lines of a section are split on request, without an allocation per line. Each violation
//! of the grammar is recorded as an [`Oddity`]. A line with a violation is still read if its meaning is clear. The front end
//! interprets the keys and values.

mod document;
mod lines;

pub use document::{Document, Entries, Entry, Oddity, Section};
