//! Runtime of Lexibus, the object-dictionary compiler.
//!
//! Generated bindings describe every value of a fieldbus device as a `const` [`Item`]. An item has a type, access
//! rights and an address on each [`Bus`] on which it exists. A [`Client`] or an [`AsyncClient`] transfers the bytes.
//! [`Item::at`] combines an item and a client into an [`Accessor`]. The accessor's methods `read` and `write` exist
//! only if the device and the bus allow them.
//!
//! The crate is `no_std`, doesn't allocate, contains no `unsafe` code and has no dependencies in its default build.
//!
//! # Example
//!
//! The compiler generated the module `demo_drive` from the EDS of a drive. A simulated drive replaces the CAN bus here;
//! with the feature `canopen`, `clients::canopen::Node` is the client of a real drive.
//!
//! ```
//! # #[cfg(feature = "std")] {
//! # let mut device = lexibus::sim::Device::new(lexibus_drives::demo_drive::ENTRIES).with_cia402();
//! # let client = device.client::<lexibus::CanOpen>();
//! use std::time::Duration;
//!
//! use lexibus::{AccessError, Error};
//! use lexibus_drives::demo_drive::types::{ModesOfOperation, State};
//! use lexibus_drives::demo_drive::DemoDrive;
//!
//! let mut drive = DemoDrive::new(client);
//! // Resets a fault if there is one, and enables the drive.
//! drive.walk(State::OperationEnabled, Duration::from_secs(2)).unwrap();
//! drive.modes_of_operation().write(ModesOfOperation::ProfilePosition).unwrap();
//! drive.target_position().write(-4711).unwrap();
//! let position = drive.position_actual_value().read().unwrap();
//! # assert_eq!(position, 0);
//!
//! // 600,000 is outside the range that the EDS declares, so nothing is sent:
//! let refused = drive.profile_velocity().write(600_000);
//! assert!(matches!(refused, Err(AccessError { error: Error::OutOfRange(_), .. })));
//! // drive.position_actual_value().write(0) does not compile, because the object is read-only.
//! # }
//! # Ok::<(), lexibus::AbortCode>(())
//! ```
//!
//! The documentation of [`Client`] shows a client for another bus library.
//!
//! # Overview
//!
//! | topic | items |
//! |---|---|
//! | values, reading and writing | [`Item`], [`Accessor`], [`Value`], [`Range`], [`AccessError`], [`Error`] |
//! | buses and addresses of an item | [`Location`], [`On`], [`location!`] |
//! | scaling and units | [`Quantity`], [`Scaled`] and related types |
//! | types and codes of CiA 301, CiA 402 and CoE, which bindings re-export | [`profiles`] |
//! | the state machine of a drive | [`Walker`], [`Machine`], [`Step`] |
//! | modes, homing and motion of a CiA 402 drive | [`cia402`] |
//! | the configuration of a DCF or XDC | [`Configuration`] |
//! | alarms and other codes | [`codes`] |
//! | custom clients | [`Client`], [`AsyncClient`], [`RegisterClient`](modbus::RegisterClient), [`RecordClient`](profinet::RecordClient), [`Exchange`], [`Clock`], [`Timer`] |
//! | timeouts and retries | [`Deadline`], [`Retrying`] |
//! | process data of CANopen, custom PDO mappings | [`pdo`](mod@pdo), [`pdo!`] |
//! | EtherCAT: PDO assignment, slots, start-up lists | [`ethercat`] |
//! | PROFINET: plans, records, images, diagnosis | [`profinet`] |
//! | Modbus: several items in one request | [`modbus`] |
//! | serial protocols | [`message`], [`framing`] |
//! | all items of a device as data | [`table`] |
//!
//! # Features
//!
//! No feature is on by default.
//!
//! | feature | description |
//! |---|---|
//! | `macros` | macro `dictionary!`, which compiles a device description during the build; needs Rust 1.88 |
//! | `std` | `sim`: simulated devices; [`Client::wait`] with a default implementation that sleeps |
//! | `canopen` | `clients::canopen`: SDO, NMT, heartbeat, emergencies, LSS and PDOs over any CAN interface; [`sdo`] and [`lss`]: SDO transfers and LSS as state machines that perform no I/O |
//! | `socketcan`, `socketcan-tokio` | `clients::canopen` over SocketCAN on Linux, blocking and async |
//! | `ethercat` | `clients::ethercat`: objects of EtherCAT SubDevices through `ethercrab`; needs Rust 1.85 |
//! | `modbus` | `clients::modbus`: RTU and TCP with `tokio-modbus`; needs Rust 1.85 |
//! | `serial` | `clients::serial`: messages over any byte stream of `embedded-io` |
//! | `serde`, `defmt` | implementations of the traits of these crates for the types of the runtime that values of generated code contain |
//!
//! [The book](https://github.com/lexibus/lexibus/blob/main/docs/src/SUMMARY.md) starts with an introduction. The book
//! has a chapter for each format and each bus.
//!
//! Clauses such as "CiA 301 7.1.6.5" refer to CiA 301 version 4.2.0.

#![no_std]
#![forbid(unsafe_code)]
#![deny(missing_docs)]
#![cfg_attr(not(test), deny(clippy::indexing_slicing, clippy::unwrap_used, clippy::expect_used, clippy::panic))]

#[cfg(any(test, feature = "std"))]
extern crate std;

mod abort;
mod access;
mod access_error;
mod accessor;
mod axes;
mod bit_field;
pub mod bits;
mod bus;
mod bus_address;
pub mod cia402;
mod client;
#[cfg(any(feature = "canopen", feature = "ethercat", feature = "modbus", feature = "serial"))]
pub mod clients;
mod clock;
pub mod codes;
mod composite;
pub mod configuration;
mod crc;
mod data_type;
mod emergency;
mod enumeration;
mod error;
pub mod ethercat;
mod exchange;
mod flags;
pub mod framing;
mod from;
mod identity;
mod image_field;
mod initial;
pub mod interface;
mod item;
mod location;
#[cfg(feature = "canopen")]
pub mod lss;
mod machine;
pub mod message;
pub mod modbus;
mod named;
mod node_id;
#[cfg(test)]
mod now;
#[cfg(feature = "serde")]
pub mod octets;
pub mod pdo;
#[rustfmt::skip]
#[cfg_attr(not(test), expect(clippy::indexing_slicing, reason = "the index of a name is the position of a variant"))]
pub mod profiles;
pub mod profinet;
mod quantity;
mod range;
mod raw_value;
mod register;
mod remaining;
mod retrying;
mod route;
#[cfg(feature = "canopen")]
pub mod sdo;
#[cfg(feature = "std")]
pub mod sim;
pub mod table;
mod text;
mod time;
mod value;
mod value_error;
mod wide;

pub use abort::AbortCode;
pub use access::{Const, Readable, Ro, Rw, Wo, Writable};
pub use access_error::AccessError;
pub use accessor::Accessor;
pub use axes::{Axes, Axis, AxisBus, AxisRange, AxisStep};
#[doc(hidden)]
pub use bit_field::{bits16, bits32, bits64, bits8};
pub use bit_field::{debug_bits, BitField, SetFlags};
pub use bus::{Bus, CanOpen, CoE, Esc, EscMemory, Modbus, Object, Parameter, ProcessImage, Profinet, Record, Serial};
pub use bus_address::BusAddress;
pub use client::{AsyncClient, Client, Timed, Write};
pub use clock::{Clock, DefaultClock, Timer};
pub use composite::Composite;
pub use configuration::{Configuration, Setting};
pub use data_type::DataType;
pub use emergency::Emergency;
pub use enumeration::Enumeration;
pub use error::Error;
pub use exchange::{AsyncExchange, Exchange, ParameterMessages, Parameters};
pub use flags::Flags;
pub use identity::Identity;
pub use image_field::{ImageField, ImageOrder};
pub use initial::{AddNodeId, Initial};
pub use item::Item;
pub use location::{
    Location, On, OnCanOpen, OnCanOpenAndCoE, OnCanOpenAndModbus, OnCanOpenCoEAndModbus, OnCoE, OnCoEAndModbus, OnEsc,
    OnImage, OnModbus, OnProfinet, OnSerial,
};
pub use machine::{Machine, MachineState, StateWord, Step, Stopped, Transition, WalkError, Walked, Walker};
pub use named::{display_name, find_name, parse_name, Named, UnknownName};
pub use node_id::NodeId;
pub use pdo::{AnyPdo, CobId, Mappable, MappedEntry, Pdo, Remappable, Rpdo, SdoWrite, SdoWriteError, Tpdo};
pub use quantity::{Exponential, Fraction, Number, OrNone, PerItem, Quantity, Reciprocal, Scaled};
pub use range::Range;
pub use raw_value::RawValue;
pub use register::{Register, RegisterPart, RegisterTable, WordOrder};
pub use retrying::{Deadline, Retrying};
pub use route::{
    Closed, Direct, Handshake, Limited, ReadRoute, ReadWindow, Resized, Route, Split, Through, WriteRoute, WriteWindow,
};
pub use table::{AccessRights, Bound, Entry, RawInitial};
pub use text::{Domain, OctetString, Opaque, UnicodeString, Utf16, VisibleString};
pub use time::{TimeDifference, TimeOfDay};
pub use value::{Fixed, Value};
pub use value_error::{LengthError, OutOfRange, TextError};
pub use wide::{Int, Uint};

#[cfg(feature = "macros")]
pub use lexibus_macros::dictionary;
