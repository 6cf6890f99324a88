//! Several values of a device on Modbus at once, and which requests a device takes.
//!
//! Registers are read one after the other with [`Item::at`](crate::Item::at). What a cycle needs is better read together:
//! [`RegisterClient::read_block`] asks for any number of values with as few requests as the device allows.
//!
//! ```
//! use lexibus::modbus::RegisterClient;
//! use lexibus::{Client, Error, Flags, Item, Modbus, OnModbus, Register, Ro};
//!
//! // What the compiler emits for three registers of a drive:
//! type RegisterItem<V> = Item<V, Ro, OnModbus>;
//! const STATUS: RegisterItem<u16> = RegisterItem::register(Register::holding(10), "Status", Flags::NONE);
//! const SPEED: RegisterItem<i16> = RegisterItem::register(Register::holding(11), "Speed", Flags::NONE);
//! const POSITION: RegisterItem<i32> = RegisterItem::register(Register::low_first(12, 2), "Position", Flags::NONE);
//!
//! // A client for a test: the device's registers, and how many requests it got.
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
//! # What is read together
//!
//! Values in one table, at addresses that follow each other. Addresses between them are read along where the [`Limits`] of
//! the device say that they can be read; generated bindings have these as `MODBUS`. One request never asks for more than the
//! device gives, and never for an address that nobody described. The values of one request are of one moment, as far as the
//! device keeps its registers together; those of two requests aren't. [`Plan`] tells, as a constant, how many it takes.

mod block;
mod client;
mod limits;
mod plan;
mod reading;

pub use block::{Block, BlockItem};
pub use client::{AsyncRegisterClient, RegisterClient};
pub use limits::{Limits, Span, TableLimits};
pub use plan::Plan;
