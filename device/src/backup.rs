//! Saves the parameters of a device to a file, and compares saved parameters.
//!
//! A backup contains the parameters that a client can read and write. It leaves out volatile values, commands, control
//! words, modes, targets, outputs, parameters that refuse reads on a scan (ObjFlags), and values that the device
//! clears automatically. The caller can include each of them by its address ([`Options::include`]). The values of COB-IDs that depend
//! on the node-ID are saved relative to `$NODEID`, so a backup can be restored to a device with another node-ID.
//! [`restore`](crate::restore) writes a backup to a device.

mod dcf;
mod difference;
mod entry;
mod relative;
mod run;
mod table;

pub use dcf::{DcfError, DcfFile};
pub use difference::{difference, Difference};
pub use entry::{Backup, Entry, Skipped};
pub use run::{backup, Options};
pub use table::TableError;
