//! Front ends: each format has a folder with a reader that converts files of the format to IR.

#[cfg(any(feature = "eds", feature = "xdd"))]
pub mod canopen;
pub mod declared_encoding;
pub mod detect;
#[cfg(feature = "eds")]
pub mod eds;
#[cfg(feature = "esi")]
pub mod esi;
#[cfg(feature = "gsdml")]
pub mod gsdml;
mod read;
#[cfg(feature = "table")]
pub mod table;
#[cfg(feature = "xdd")]
pub mod xdd;
// Each format uses only a part of the common XML reader, so some items are unused if a format is disabled.
#[cfg(feature = "xml")]
#[cfg_attr(not(all(feature = "esi", feature = "gsdml", feature = "xdd")), allow(dead_code, unused_imports))]
mod xml;

#[cfg(all(feature = "table", not(feature = "messages")))]
pub(crate) use read::without_feature;
pub use read::{format, Overlay};
pub(crate) use read::{read, read_overlay, Description};
