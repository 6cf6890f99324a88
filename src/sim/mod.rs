//! Simulated devices for tests of drivers without hardware (feature `std`).
//!
//! A [`Device`] is created from the static table `ENTRIES` of the bindings. The table is generated if the option
//! `table` is set. The device starts with its initial values and checks the access rights and limits of the
//! description. The device refuses invalid accesses with the abort codes of CiA 301 7.2.4.3.17 or with Modbus
//! exceptions. The driver under test accesses the device through [`Device::client`]. The test simulates the behavior of
//! the device.
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
//! // The driver under test:
//! let mut drive = DemoDrive::new(device.client::<CanOpen>());
//! drive.controlword().write(Controlword::from_raw(0x0F)).unwrap();
//! assert!(drive.statusword().read().unwrap().operation_enabled());
//! // The accessor would refuse this value, so this line writes it through the client.
//! let target = *objects::TARGET_POSITION.location();
//! let refused = lexibus::Client::write(drive.client(), target.canopen, &i32::MAX.to_le_bytes());
//! assert_eq!(refused, Err(Error::Abort(AbortCode::TOO_HIGH)));
//!
//! // The test uses the same handles, without access rights:
//! device.set(objects::POSITION_ACTUAL_VALUE, -2)?;
//! assert_eq!(device.transmit_pdo(0x1A01)?[2..], [0xFE, 0xFF, 0xFF, 0xFF]);
//! # Ok::<(), AbortCode>(())
//! ```
//!
//! - Values: [`Device::get`] and [`Device::set`] access numbers, [`Device::bytes`] and [`Device::set_bytes`] access all
//!   types. [`Device::set_initial`] sets the value that an item has after power-on.
//! - Behavior: [`Device::on_write`] calls a reaction after each write of an item. A reaction can also refuse values
//!   that the table allows, such as undefined values of an enumeration. [`Device::fail_next`] simulates faults.
//! - CANopen process data: [`Device::receive_pdo`] and [`Device::transmit_pdo`] use the current mapping. A master can
//!   change the mapping as on a real device.
//! - EtherCAT process data: [`Device::receive_image`] and [`Device::transmit_image`] exchange process images.
//! - Modbus: [`Device::read_words`] and related methods handle requests. A Modbus server can call these methods.
//! - CAN: with the feature `canopen`, a `CanNode` is a device on a simulated CAN bus, and a `CanBus` is a bus with
//!   several nodes. The CANopen clients of this crate can use both.
//! - Faults of the bus: a `FaultyCan` delays, loses, repeats or changes frames, and simulates bus-off and restarts. A
//!   [`FaultyStream`] delays, loses, repeats or changes messages on a byte stream, for Modbus and serial protocols.
//! - Further axes: [`Device::with_axes`] adds further axes.
//! - Drives: [`Device::with_cia402`] adds the behavior of CiA 402, and [`Device::fail`] simulates faults of a drive.
//! - Time: [`Device::step`] advances the simulated time.
//! - Parameters: the device stores parameters (0x1010) and restores parameters (0x1011) if it has these objects.
//!
//! A simulated device checks written values only against the data in the table. The device doesn't check the length of
//! texts, the values of enumerations, or gaps in a range.

mod behavior;
#[cfg(feature = "canopen")]
mod can;
mod cells;
mod client;
mod clock;
mod device;
mod drive;
mod emergency;
mod ethercat;
mod fault;
mod faults;
mod item_address;
mod limits;
mod modbus;
mod parameters;
mod process;
mod slots;
mod store;
mod stream;
#[cfg(feature = "modbus")]
mod stream_async;
mod time;
mod values;

#[cfg(feature = "canopen")]
pub use can::{CanBus, CanError, CanFault, CanNode, FaultyCan, SimulatedCan};
pub use client::Connection;
pub use device::{Device, DeviceAxis};
pub use ethercat::{Datagram, EtherCatFault, FaultyFrames};
pub use fault::{Exception, Fault};
pub use item_address::ItemAddress;
pub use stream::{FaultyStream, StreamFault};
