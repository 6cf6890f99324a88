//! Rust code as a document: text with the places at which a line may be broken, and the writer that breaks lines where and how
//! `prettyplease` would.

mod doc;
mod layout;
mod writer;

pub(super) use doc::{call, generic, list, seq, slice, Break, Data, Doc, Stop};
pub(super) use writer::{line, open, Code};
