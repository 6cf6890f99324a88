//! Simulated devices, to test drivers without hardware (feature `std`).
//!
//! A [`Device`] is created from the static table of the bindings (`ENTRIES`, generated with the option `table`). It
//! starts with its initial values and checks access rights and limits of the description. It refuses other accesses
//! with the abort codes of CiA 301 7.2.4.3.17 or with Modbus exceptions. A driver uses it through [`Device::client`];
//! the test simulates the behavior of the device.
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
//! // The handle would refuse this value, so write it through the client.
//! let target = *objects::TARGET_POSITION.location();
//! let refused = lexibus::Client::write(drive.client(), target.canopen, &i32::MAX.to_le_bytes());
//! assert_eq!(refused, Err(Error::Abort(AbortCode::TOO_HIGH)));
//!
//! // The device's side uses the same handles, without access rights:
//! device.set(objects::POSITION_ACTUAL_VALUE, -2)?;
//! assert_eq!(device.transmit_pdo(0x1A01)?[2..], [0xFE, 0xFF, 0xFF, 0xFF]);
//! # Ok::<(), AbortCode>(())
//! ```
//!
//! - Values: [`Device::get`] and [`Device::set`] for numbers, [`Device::bytes`] and [`Device::set_bytes`] for all
//!   types, [`Device::set_initial`] for initial values after power-on.
//! - Behavior: [`Device::on_write`] reacts to writes. It can also refuse values that the table allows, for example
//!   undefined values of an enumeration. [`Device::fail_next`] simulates faults.
//! - CANopen process data: [`Device::receive_pdo`] and [`Device::transmit_pdo`] use the current mapping, which a master
//!   can change as on a real device.
//! - EtherCAT process data: [`Device::receive_image`] and [`Device::transmit_image`].
//! - Modbus: [`Device::read_words`] and related methods reply to requests, so you can connect a Modbus server.
//! - CAN: with the feature `canopen`, a `CanNode` is a device on a simulated CAN bus. The CANopen clients of this crate
//!   work with it.
//! - Further axes: [`Device::with_axes`].
//! - Parameters are stored (0x1010) and restored (0x1011) if the device has these objects.
//!
//! A simulated device checks only what the table contains. It doesn't check the length of texts, the values of
//! enumerations, and gaps in a range.

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
