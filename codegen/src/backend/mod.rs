//! Back ends: one folder an output. None of them looks at a source format.

pub mod docs;
pub mod eds;
pub mod esi;
pub mod gsdml;
pub mod json;
mod markdown;
mod note;
mod options;
mod registers;
pub mod rust;
pub(crate) mod words;
mod xml;

pub use note::{Export, Note, NoteKind};
pub use options::{MissingFact, Refusal};
