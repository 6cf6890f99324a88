//! Comparison of a device with its description.
//!
//! [`verify`] only reads. It reports parameters that the device lacks, objects that the description doesn't declare,
//! differences, parameters that cannot be read, and facts that cannot be verified. Write access isn't verified.
//!
//! ```
//! use lexibus::sim::Device;
//! use lexibus::CanOpen;
//! use lexibus_codegen::compile::Options;
//! use lexibus_codegen::source::Source;
//! use lexibus_device::verify::{verify, Options as VerifyOptions};
//! use lexibus_device::{CanOpenConnection, Description, Network};
//! use lexibus_drives::demo_drive::ENTRIES;
//!
//! let mut drive = Device::new(ENTRIES);
//! let mut connection = CanOpenConnection::new(drive.client::<CanOpen>());
//! let file = Source::read("../dictionaries/demo-drive.eds".as_ref())?;
//! let description = Description::compile(file, Network::CanOpen, &Options::default())?;
//! let report = verify(&description, &mut connection, &VerifyOptions::default())?;
//! assert_eq!(report.deviations().count(), 0);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod extra;
mod finding;
mod html;
mod identity;
mod item;
mod mapping;
mod overlay;
mod report;
mod run;
mod session;

pub use finding::{Finding, FindingKind, Found};
pub use report::Report;
pub use run::verify;
pub use session::Options;
