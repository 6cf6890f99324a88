//! Source files, encodings and spans. All later stages refer to sources and spans.
//!
//! A [`Source`] is one description file, decoded to UTF-8. A [`Span`] is a range of bytes of the decoded text. A
//! diagnostic of any stage can therefore quote the line that caused it.

mod decode;
mod digest;
mod references;
mod replace;
mod span;
mod text;

pub use decode::Encoding;
pub use digest::Digest;
pub use references::{References, Refusal, MAX_REFERENCES};
pub use span::{FileId, Origin, Position, Span};
pub use text::{Source, MAX_INPUT_BYTES};
