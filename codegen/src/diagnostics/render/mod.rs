//! Rendering of diagnostics as text for a terminal.
//!
//! The functions take [`Diagnostic`](super::Diagnostic)s and the list of [`Source`](crate::source::Source)s to which
//! their spans refer. The functions do not panic on any span. An offset beyond the end of the file is moved to the end.
//! An offset inside a character is moved to a character boundary. A diagnostic for a file that is not in the list is
//! rendered without a position.

pub mod marked;
mod summary;
pub mod terminal;

pub use summary::summary;
