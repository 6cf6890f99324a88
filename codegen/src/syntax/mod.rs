//! Parsers for INI and XML, the two syntaxes of vendor files. The parsers are independent of the bus.
//!
//! - [`ini`]: sections, keys and values of EDS and DCF files, each with its span.
//! - [`xml`]: a cursor over the events of a document, with positions and the path of open elements.

pub mod ini;
pub(crate) mod words;
#[cfg(feature = "xml")]
pub mod xml;
