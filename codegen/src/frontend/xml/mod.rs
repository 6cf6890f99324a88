//! Common reader of the XML formats ESI, XDD and GSDML.
//!
//! A front end reads a document with a [`Reader`]. The [`Format`] of the reader contains the names and diagnostic codes
//! of the standard, and the state of the front end. An element is read in three steps:
//!
//! - [`Reader::attributes`] reads the attributes of the element.
//! - A loop over [`Reader::child`] matches the names of the child elements.
//! - [`Reader::unknown`] reads child elements with unknown names.
//!
//! Facts for which the IR has no field are pushed onto the stack [`Reader::extensions`]. An element with extensions in
//! the IR takes the extensions that were pushed while the element was read ([`Reader::extensions_since`]). All other
//! extensions go to the enclosing element.
//!
//! | file | subject |
//! |---|---|
//! | `reader` | attributes and children |
//! | `content` | text |
//! | `unknown` | elements and attributes unknown to the standard or the IR |
//! | `given` | a text with its span |
//! | `names` | a text in several languages |
//! | `order` | order in which data types are converted |

mod content;
mod given;
mod names;
#[cfg(any(feature = "esi", feature = "xdd"))]
mod order;
mod reader;
#[cfg(test)]
mod tests;
mod unknown;

pub use given::Given;
pub use names::{Language, Names};
#[cfg(any(feature = "esi", feature = "xdd"))]
pub use order::Order;
pub use reader::{Attributes, Format, Read, Reader};
