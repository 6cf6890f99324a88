//! SDO transfers (CiA 301 7.2.4) as state machines that perform no I/O.
//!
//! [`Transfer`] is the client side of one transfer, and [`Server`] is the server side of one SDO channel. Both support
//! expedited, segmented and block transfers. Neither allocates memory: a transfer uses the caller's buffer, and a
//! server has a buffer of a fixed size. The caller sends the messages that `next` returns, passes received messages to
//! `handle`, and measures the time. `clients::canopen::Node` performs these tasks on the client side, for any CAN
//! interface.
//!
//! ```
//! use core::time::Duration;
//!
//! use lexibus::sdo::{Objects, Server, Transfer, BLOCK_THRESHOLD};
//! use lexibus::{AbortCode, Object};
//!
//! /// A device with a program of 4,000 bytes.
//! struct Program([u8; 4000]);
//!
//! impl Objects for Program {
//!     fn read(&mut self, object: Object, buffer: &mut [u8]) -> Result<usize, AbortCode> {
//!         let room = buffer.get_mut(..4000).filter(|_| object == Object::new(0x1F50, 1));
//!         room.ok_or(AbortCode::NO_OBJECT)?.copy_from_slice(&self.0);
//!         Ok(4000)
//!     }
//!
//!     fn write(&mut self, _: Object, _: &[u8]) -> Result<(), AbortCode> {
//!         Err(AbortCode::READ_ONLY)
//!     }
//! }
//!
//! let (mut device, mut server) = (Program([7; 4000]), Server::<4096>::new());
//! let mut buffer = [0; 4096];
//! let mut transfer = Transfer::upload(Object::new(0x1F50, 1), &mut buffer, BLOCK_THRESHOLD);
//! let length = loop {
//!     while let Some(request) = transfer.next() {
//!         server.handle(&request, Duration::ZERO, &mut device);
//!     }
//!     if let Some(result) = transfer.result() {
//!         break result;
//!     }
//!     while let Some(reply) = server.next() {
//!         transfer.handle(&reply);
//!     }
//! };
//! assert_eq!(length, Ok(4000));
//! assert_eq!(buffer[..4000], [7; 4000]);
//! ```

mod block;
mod channel;
mod crc;
mod message;
mod reply;
mod server;
mod transfer;

#[cfg(test)]
mod tests;

pub use channel::Channel;
pub use message::Message;
pub use server::{Objects, Server};
pub use transfer::{Transfer, TransferError, BLOCK_THRESHOLD};

pub(crate) use message::abort;
pub(crate) use reply::Expected;
