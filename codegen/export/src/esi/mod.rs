//! Exports EtherCAT slave information (ESI, ETG.2000): the EtherCAT slaves of a catalog, and its other devices with
//! objects, except PROFINET devices.
//!
//! If the source is an ESI, the export has all its facts that the schema allows, in the order that the schema requires.
//! If the source has another format, the export has the facts that ETG.2000 can express. [`Export::notes`] lists the
//! facts that were left out or changed. The [`Options`] supply facts that the schema requires and the source does not
//! have.
//!
//! | file | subject |
//! |---|---|
//! | `context`, `file` | data for all writers; the file: vendor, groups, devices and modules |
//! | `options` | facts that the caller gives |
//! | `text` | numbers, texts in several languages |
//! | `device`, `module` | devices and modules |
//! | `sync` | FMMUs, sync managers, sync units |
//! | `pdo`, `mailbox`, `clocks`, `slots`, `eeprom` | the parts of a device |
//! | `dictionary`, `types`, `record`, `object`, `value` | data types and objects |
//! | `objects` | the objects of a device on EtherCAT |
//! | `diagnosis` | diagnosis messages |
//! | `extras` | extension attributes that the file can hold |
//! | `losses` | facts that ETG.2000 cannot hold |

mod clocks;
mod context;
mod device;
mod diagnosis;
mod dictionary;
mod eeprom;
mod extras;
mod file;
mod losses;
mod mailbox;
mod module;
mod object;
mod objects;
mod options;
mod pdo;
mod record;
mod slots;
mod sync;
mod text;
mod types;
mod value;

pub use super::{Export, MissingFact, Note, NoteKind, Refusal};
use context::Context;
pub use file::export;
pub use options::{Area, Options};
