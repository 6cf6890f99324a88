//! The reader base of the XML formats ESI, XDD and GSDML.
//!
//! A front end walks through a document with a [`Reader`], which has a [`Format`] with the names and codes of its standard and with
//! the front end's state. Reading an element takes three steps: [`Reader::attributes`] for its attributes, a loop over
//! [`Reader::child`] with a `match` on names, and [`Reader::unknown`] for every other child. What the IR has no field for is put on
//! the stack [`Reader::extensions`]; an element with extensions of its own takes those that were added while it was read
//! ([`Reader::extensions_since`]), and the others are left to the element around it.
//!
//! | file | subject |
//! |---|---|
//! | `reader` | attributes and children |
//! | `content` | text |
//! | `unknown` | what the standard or the IR does not have |
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
