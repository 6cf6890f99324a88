//! Rust code as documents, which are texts with marked positions for line breaks. The writer breaks lines as
//! `prettyplease` does.

mod declaration;
mod doc;
mod layout;
mod writer;

pub(super) use declaration::Declaration;
pub(super) use doc::{call, generic, list, seq, slice, Break, Data, Doc, Piece, Stop};
pub(super) use layout::MARGIN;
pub(super) use writer::{line, open, Code, Sink};
