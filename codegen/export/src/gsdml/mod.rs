//! Exports PROFINET device descriptions (GSDML). The export has all device access points of a catalog. For another
//! format, the export has a new device access point for each device with fixed process images.
//!
//! If the source is a GSDML, the export has all its facts that the schema allows, in the order that the schema
//! requires. The export keeps attributes of later schema versions. If the source has another format, one submodule of
//! each device access point contains the process images as its cyclic data. [`Export::notes`] lists the facts that were
//! left out or changed. The [`Options`] supply facts that the schema requires and the source does not have.
//!
//! | file | subject |
//! |---|---|
//! | `context`, `file` | data for all writers; the file: header, identity and lists |
//! | `options` | facts that the caller gives |
//! | `elements` | elements whose attributes the IR stores unchanged |
//! | `device`, `module`, `submodule` | device access points, modules, submodules |
//! | `image` | a device access point for fixed process images |
//! | `io_data`, `types` | cyclic data and its types |
//! | `record` | parameter records, including those of PROFIsafe |
//! | `values` | named values |
//! | `diagnosis` | diagnosis, alarms and log book |

mod context;
mod device;
mod diagnosis;
mod elements;
mod file;
mod image;
mod io_data;
mod module;
mod options;
mod record;
mod submodule;
mod texts;
mod types;
mod values;

pub use super::{Export, MissingFact, Note, NoteKind, Refusal};
use context::Context;
pub use file::{export, file_name};
pub use options::Options;
