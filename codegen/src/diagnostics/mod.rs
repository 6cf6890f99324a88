//! Errors and warnings about the input. Each [`Diagnostic`] has a stable [`Code`].
//!
//! The stages of the compiler create diagnostics. [`Levels`] determines their severity (lenient or strict mode, `-A`,
//! `-W`, `-D`), and [`render`] formats them for a terminal.

mod allowed;
pub mod codes;
mod diagnostic;
mod error_spans;
mod levels;
mod list;
pub mod render;

pub use codes::{Class, Code};
pub use diagnostic::{Diagnostic, Note, Severity};
pub(crate) use error_spans::ErrorSpans;
pub use levels::{Level, Levels, UnknownCode};
pub use list::Diagnostics;
