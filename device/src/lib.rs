//! Compares a device on a bus with its description, and reads, writes, saves and restores its values by name.
//!
//! The description is an EDS, DCF, XDD or XDC file, or a register table. No Rust code is generated for it: a
//! [`Description`] lists the [`Parameter`]s that the device has on a bus, and a [`Connection`] transfers the bytes of their
//! values.
//!
//! ```
//! use lexibus::sim::Device;
//! use lexibus::CanOpen;
//! use lexibus_codegen::compile::Options;
//! use lexibus_codegen::source::Source;
//! use lexibus_device::{CanOpenConnection, Description, Network, Write};
//! use lexibus_drives::demo_drive::ENTRIES;
//!
//! // A simulated drive replaces the bus here.
//! let mut drive = Device::new(ENTRIES);
//! let mut connection = CanOpenConnection::new(drive.client::<CanOpen>());
//!
//! let file = Source::read("../dictionaries/demo-drive.eds".as_ref())?;
//! let description = Description::compile(file, Network::CanOpen, &Options::default())?;
//! let velocity = description.find("Profile velocity")?;
//!
//! let write = Write::parse(velocity, "20000", None)?;
//! write.execute(&mut connection)?;
//! assert_eq!(velocity.read(&mut connection)?.to_string(), "20000");
//!
//! // 600,000 is above the maximum that the description declares, so nothing is sent.
//! assert!(Write::parse(velocity, "600000", None).is_err());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! | subject | items |
//! |---|---|
//! | the description of a device on a bus | [`Description`], [`Parameter`], [`Address`] |
//! | buses | [`Connection`], [`CanOpenConnection`], [`ModbusConnection`], [`BusAddress`] |
//! | read and write by name | [`Parameter::read`], [`Write`] |
//! | comparison with the description | [`verify`] |
//! | save and restore | [`backup`], [`restore`] |
//! | nodes of a bus | [`scan`] |
//! | traffic by name, recorded traces | [`monitor`], [`trace`] |
//!
//! # Safety of the machine
//!
//! - Only [`Write::execute`], [`restore::Plan::execute`] and [`Connection::write`] write values to a device. The caller can
//!   also write with the client of a connection, and send frames over an [`AnyPort`].
//! - No function sends an NMT command. No function writes object 0x1010 (store parameters) or 0x1011 (restore default
//!   parameters) unless the caller names it.
//! - A restore writes a [protected](Protection) parameter, such as a controlword, only if the caller names it.
//! - The [outcome](restore::Outcome) of a restore lists the state of every write, even after an error.
//!
//! # Features
//!
//! All features are on by default.
//!
//! | feature | buses |
//! |---|---|
//! | `socketcan` | CAN interfaces of Linux |
//! | `slcan` | CAN adapters on a serial line |
//! | `modbus` | Modbus RTU and TCP |

#![forbid(unsafe_code)]

mod address;
pub mod backup;
mod bus;
mod connection;
mod description;
mod failure;
pub mod monitor;
mod parameter;
mod parse;
mod port;
mod protection;
mod quote;
pub mod restore;
pub mod scan;
pub mod slcan;
#[cfg(test)]
mod testing;
pub mod trace;
pub mod verify;
mod write;

pub use address::{Address, Network};
pub use bus::{BusAddress, BusAddressError};
pub use connection::{CanOpenConnection, Connection, ModbusConnection};
pub use description::{Description, DescriptionError, FindError};
pub use failure::Failure;
pub use parameter::{Parameter, Reading};
pub use parse::ParseError;
pub use port::{AnyPort, NodeConnection};
pub use protection::{Protection, ReadRefusal};
pub use write::{Write, WriteError};
