//! Saves the parameters of a device, and compares saved parameters.
//!
//! A backup contains the values of parameters that the description declares as readable and writable. By default, it leaves
//! out:
//!
//! - volatile values
//! - values that the device clears automatically
//! - parameters that refuse reads on a scan (ObjFlags)
//! - parameters with the [protection](crate::Protection) `Command`, `Control` or `Output`
//!
//! The caller can include each of these parameters by its address ([`Options::include`]).
//!
//! CANopen values that depend on the node-ID, such as COB-IDs, are saved as formulas with `$NODEID` if the node-ID is known.
//! Such a backup can be restored to a device with another node-ID.
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
