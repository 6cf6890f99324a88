//! Rust code as a document: text with the positions at which lines may be broken, and the writer that breaks lines as
//! `prettyplease` does.

mod doc;
mod layout;
mod writer;

pub(super) use doc::{call, generic, list, seq, slice, Break, Data, Doc, Stop};
pub(super) use writer::{line, open, Code};
