//! The two surface syntaxes of description files, without any knowledge of a bus.
//!
//! - [`ini`]: sections, keys and values of EDS and DCF files, each with its span.
//! - [`xml`]: a cursor over `quick-xml`'s events with positions and the breadcrumb of open elements.

pub mod ini;
#[cfg(feature = "xml")]
pub mod xml;
