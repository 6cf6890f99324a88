//! Exports the slave information interface (SII) of an EtherCAT slave: the content of its EEPROM (ETG.1000.6 5.4, ETG.2010).
//!
//! The image consists of a configuration area, categories, and bytes 0xFF up to the size of the EEPROM. If an ESI contains
//! the whole content of the EEPROM, the export returns this content unchanged.
//!
//! | file | subject |
//! |---|---|
//! | `image` | the whole image, and its size |
//! | `area` | the configuration area and its checksum |
//! | `texts` | category "strings" |
//! | `general` | category "general" |
//! | `process_data` | categories "FMMU", "SyncM", "TxPDO" and "RxPDO" |
//! | `clocks` | category "DC" |
//! | `context`, `options` | data for all categories; facts that the caller gives |

mod area;
mod clocks;
mod context;
mod general;
mod image;
mod options;
mod process_data;
mod texts;

pub use super::{MissingFact, Note, NoteKind, Refusal};
use context::Context;
pub use image::{export, Image};
pub use options::{EepromSize, Octets, Options};
