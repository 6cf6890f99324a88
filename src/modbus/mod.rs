//! Access to several Modbus values with one request, and the limits of a device's requests.
//!
//! An [`Accessor`](crate::Accessor) reads one value per request. For cyclic reads, use [`RegisterClient::read_block`],
//! which reads several values with as few requests as the device allows.
//!
//! ```
//! use lexibus::modbus::RegisterClient;
//! use lexibus::{Client, Error, Flags, Item, Modbus, OnModbus, Register, Ro};
//!
//! // Generated code for three registers of a drive:
//! type RegisterItem<V> = Item<V, Ro, OnModbus>;
//! const STATUS: RegisterItem<u16> = RegisterItem::register(Register::holding(10), "Status", Flags::NONE);
//! const SPEED: RegisterItem<i16> = RegisterItem::register(Register::holding(11), "Speed", Flags::NONE);
//! const POSITION: RegisterItem<i32> = RegisterItem::register(Register::low_first(12, 2), "Position", Flags::NONE);
//!
//! // A client for tests, which contains the registers of the device and counts the requests.
//! struct Registers([u16; 16], usize);
//!
//! impl Client for Registers {
//!     type Bus = Modbus;
//!     type Error = core::convert::Infallible;
//!
//!     fn read(&mut self, register: Register, buffer: &mut [u8]) -> Result<usize, Error<Self::Error>> {
//!         self.1 += 1;
//!         let first = usize::from(register.address);
//!         let words = self.0.get(first..first + usize::from(register.count)).ok_or(Error::UnexpectedReply)?;
//!         Ok(register.decode(words, buffer)?)
//!     }
//!
//!     fn write(&mut self, _: Register, _: &[u8]) -> Result<(), Error<Self::Error>> {
//!         Err(Error::UnexpectedReply)
//!     }
//! }
//!
//! impl RegisterClient for Registers {}
//!
//! let mut client = Registers([0; 16], 0);
//! client.0[10..14].copy_from_slice(&[0x0040, 0xFFFF, 0x86A0, 0x0001]);
//! let (position, speed, status) = client.read_block((POSITION, SPEED, STATUS))?;
//! assert_eq!((position, speed, status), (100_000, -1, 0x40));
//! assert_eq!(client.1, 1); // one request, for registers 10 to 13
//! # Ok::<(), Error<core::convert::Infallible>>(())
//! ```
//!
//! # Items in one request
//!
//! One request reads values of the same table at consecutive addresses. A request also includes addresses between the
//! values if the [`Limits`] of the device allow it. Generated bindings contain the limits as the constant `MODBUS`. A
//! request never exceeds the device's limit, and never includes an address that isn't in the device description. The
//! values of one request are consistent if the device updates its registers together. The values of different requests
//! may be inconsistent. [`Plan`] can compute the requests at compile time.
//!
//! [`RegisterClient::write_block`] writes adjacent holding registers with one request if the device allows it.
//! [`RegisterClient::exchange`] writes and reads with one request if the device supports function 23. If the device
//! supports function 22, [`RegisterClient::write_masked`] changes some bits of a register with one request.

mod block;
mod client;
mod limits;
mod plan;
mod reading;
mod write_block;

pub use block::{Block, BlockItem};
#[cfg(feature = "std")]
pub(crate) use client::is_combined;
pub use client::{AsyncRegisterClient, RegisterClient};
#[cfg(feature = "std")]
pub(crate) use limits::MAX_EXCHANGED;
pub use limits::{Limits, Span, TableLimits};
pub use plan::Plan;
#[cfg(feature = "std")]
pub(crate) use write_block::masked;
pub use write_block::{Encoded, WriteBlock, WriteItem};
