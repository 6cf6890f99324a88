//! Simulated devices, so that a driver can be tested with no hardware (feature `std`).
//!
//! A [`Device`] is made from the static table of the bindings (`ENTRIES`, generated with the option `table`). It has the
//! values of power-on, takes what the description allows, and refuses the rest with the abort codes of CiA 301 7.2.4.3.17,
//! or the exceptions of Modbus. A driver talks to it through [`Device::client`]; the test plays the rest of the device.
//!
//! ```
//! use lexibus::sim::Device;
//! use lexibus::{AbortCode, CanOpen, Error};
//! use lexibus_drives::demo_drive::types::{Controlword, Statusword};
//! use lexibus_drives::demo_drive::{objects, DemoDrive, ENTRIES};
//!
//! let mut device = Device::new(ENTRIES);
//! // The statusword follows the controlword.
//! device.on_write(objects::CONTROLWORD, |device, controlword| {
//!     let is_enabled = controlword.raw() & 0x0F == 0x0F;
//!     device.set(objects::STATUSWORD, Statusword::from_raw(if is_enabled { 0x27 } else { 0x21 }))
//! })?;
//!
//! // The driver:
//! let mut drive = DemoDrive::new(device.client::<CanOpen>());
//! drive.controlword().write(Controlword::from_raw(0x0F)).unwrap();
//! assert!(drive.statusword().read().unwrap().operation_enabled());
//! // The handle would refuse this before it is sent.
//! let target = *objects::TARGET_POSITION.location();
//! let refused = lexibus::Client::write(drive.client(), target.canopen, &i32::MAX.to_le_bytes());
//! assert_eq!(refused, Err(Error::Abort(AbortCode::TOO_HIGH)));
//!
//! // The device's side, with the same handles and no access rights:
//! device.set(objects::POSITION_ACTUAL_VALUE, -2)?;
//! assert_eq!(device.transmit_pdo(0x1A01)?[2..], [0xFE, 0xFF, 0xFF, 0xFF]);
//! # Ok::<(), AbortCode>(())
//! ```
//!
//! - Values: [`Device::get`] and [`Device::set`] of numbers, [`Device::bytes`] and [`Device::set_bytes`] of everything;
//!   [`Device::set_initial`] for what is there after power-on.
//! - Behaviour: [`Device::on_write`], which also refuses what the table can't know, such as a value that an enumeration
//!   doesn't have; [`Device::fail_next`] for faults.
//! - Process data: [`Device::receive_pdo`] and [`Device::transmit_pdo`] by the present mapping, which a master changes as
//!   that of a real device; [`Device::receive_image`] and [`Device::transmit_image`] of EtherCAT.
//! - Modbus: [`Device::read_words`] and its like answer requests, so that a server can stand in front of it.
//! - CAN: with the feature `canopen`, a `CanNode` is a device as a node on a bus, frame by frame, on which the real clients of
//!   CANopen run.
//! - Further axes: [`Device::with_axes`].
//! - Parameters are stored (0x1010) and restored (0x1011) as far as the device has these objects.
//!
//! What a table doesn't have, a simulated device doesn't know: the length of texts, values of enumerations, gaps in a range.

#[cfg(feature = "canopen")]
mod can;
mod cells;
mod client;
mod device;
mod emergency;
mod fault;
mod item_address;
mod limits;
mod modbus;
mod parameters;
mod process;
mod slots;
mod store;
mod values;

#[cfg(feature = "canopen")]
pub use can::CanNode;
pub use client::Connection;
pub use device::{Device, DeviceAxis};
pub use fault::{Exception, Fault};
pub use item_address::ItemAddress;
