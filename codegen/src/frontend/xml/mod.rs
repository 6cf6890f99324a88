//! Reader base of the XML formats ESI, XDD and GSDML.
//!
//! A front end reads a document with a [`Reader`]. Its [`Format`] contains the names and diagnostic codes of the
//! standard, and the state of the front end. An element is read in three steps:
//!
//! - [`Reader::attributes`] reads its attributes.
//! - A loop over [`Reader::child`] matches the names of its children.
//! - [`Reader::unknown`] reads all other children.
//!
//! Facts for which the IR has no field are pushed onto the stack [`Reader::extensions`]. If an element has extensions
//! in the IR, it takes those that were pushed while it was read ([`Reader::extensions_since`]). All other facts go to
//! the enclosing element.
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
