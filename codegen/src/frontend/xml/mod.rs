//! The reader base of the XML formats ESI, XDD and GSDML.
//!
//! A front end reads a document with a [`Reader`]. Its [`Format`] has the names and codes of the standard and the
//! state of the front end. An element is read in three steps:
//!
//! - [`Reader::attributes`] reads its attributes.
//! - A loop over [`Reader::child`] matches the names of its children.
//! - [`Reader::unknown`] reads every other child.
//!
//! Facts without a field in the IR are put on the stack [`Reader::extensions`]. An element with extensions in the IR
//! takes those that were added while it was read ([`Reader::extensions_since`]). The enclosing element takes the
//! others.
//!
//! | file | subject |
//! |---|---|
//! | `reader` | attributes and children |
//! | `content` | text |
//! | `unknown` | elements and attributes unknown to the standard or the IR |
//! | `given` | a text with its span |
//! | `names` | a text in several languages |

mod content;
mod given;
mod names;
mod reader;
#[cfg(test)]
mod tests;
mod unknown;

pub use given::Given;
pub use names::{Language, Names};
pub use reader::{Attributes, Format, Read, Reader};
