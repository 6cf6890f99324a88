//! Writes saved parameters to a device.
//!
//! A [`Plan`] lists all writes in their order, and the values that are not written. [`Plan::execute`] performs the
//! writes and returns an [`Outcome`], which lists the state of every write, even if the restore fails or is
//! interrupted.
//!
//! ```
//! use lexibus::sim::Device;
//! use lexibus::CanOpen;
//! use lexibus_codegen::compile::Options;
//! use lexibus_codegen::source::Source;
//! use lexibus_device::backup::{backup, Options as BackupOptions};
//! use lexibus_device::restore::Plan;
//! use lexibus_device::{CanOpenConnection, Description, Network, Write};
//! use lexibus_drives::demo_drive::ENTRIES;
//!
//! let mut drive = Device::new(ENTRIES);
//! let mut connection = CanOpenConnection::new(drive.client::<CanOpen>());
//! let file = Source::read("../dictionaries/demo-drive.eds".as_ref())?;
//! let description = Description::compile(file, Network::CanOpen, &Options::default())?;
//!
//! let saved = backup(&description, &mut connection, &BackupOptions { node_id: Some(1), ..BackupOptions::default() })?;
//! let velocity = description.find("Profile velocity")?;
//! Write::parse(velocity, "77", None)?.execute(&mut connection)?;
//!
//! let plan = Plan::new(&description, &saved, Some(1), &[]);
//! let outcome = plan.execute(&mut connection, &mut |_| true);
//! assert!(outcome.is_complete());
//! assert_ne!(velocity.read(&mut connection)?.to_string(), "77");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod execute;
mod order;
mod plan;

pub use execute::{Outcome, Status};
pub use plan::Plan;
