//! Requests and replies of a command protocol as types.
//!
//! Generated bindings have a [`Message`] type for every request, and a type for the reply to the request. [`Call`]
//! sends a message through a [`MessageClient`], for example [`Parameters`](crate::Parameters) over an
//! [`Exchange`](crate::Exchange). This module doesn't allocate. Lists in requests are slices. Lists in replies are
//! decoded from the bytes of the reply, one element at a time.
//!
//! ```
//! use lexibus::message::{Completion, Message, Reader, Reply, WriteError, Writer};
//!
//! // The compiler generates this for a request `node 0x40 speed` with the reply `node 0x40 status`:
//! #[derive(Debug, PartialEq)]
//! struct Jog {
//!     speed: i16,
//! }
//!
//! impl Message for Jog {
//!     type Reply<'r> = JogReply;
//!     type Refusal = core::convert::Infallible;
//!     const NAME: &'static str = "Jog";
//!     const COMPLETION: Completion = Completion::Immediate;
//!
//!     fn write(&self, station: u32, to: &mut Writer<'_>) -> Result<(), WriteError> {
//!         to.number(8, station.into())?;
//!         to.bytes(&[0x40])?;
//!         to.number(16, self.speed as u16 as u64)
//!     }
//! }
//!
//! #[derive(Debug, PartialEq)]
//! struct JogReply {
//!     status: u8,
//! }
//!
//! impl Reply<'_> for JogReply {
//!     fn read(request: &[u8], from: &mut Reader<'_>) -> Option<Self> {
//!         from.echo(request, 0, 2)?;
//!         let status = from.number(8)? as u8;
//!         from.end()?;
//!         Some(JogReply { status })
//!     }
//!
//!     fn write(&self, request: &[u8], to: &mut Writer<'_>) -> Result<(), WriteError> {
//!         to.echo(request, 0, 2)?;
//!         to.number(8, self.status.into())
//!     }
//! }
//!
//! let mut data = [0; 8];
//! let mut request = Writer::new(&mut data);
//! Jog { speed: -578 }.write(5, &mut request)?;
//! assert_eq!(request.written(), [0x05, 0x40, 0xFD, 0xBE]);
//! let reply = JogReply::read(request.written(), &mut Reader::new(&[0x05, 0x40, 0x02]));
//! assert_eq!(reply, Some(JogReply { status: 2 }));
//! # Ok::<(), WriteError>(())
//! ```

mod call;
mod list;
mod outcome;
mod reader;
mod scale;
mod setting;
mod writer;

use core::convert::Infallible;

use crate::error::Error;

pub(crate) use call::answer;
pub use call::{Answer, AsyncMessageClient, Call, Failure, MessageClient, Station};
pub use list::{Group, List, ListIter, Settings, SettingsIter, SettingsRule};
pub use outcome::{Outcome, Outcomes, StateOutcomes};
pub use reader::Reader;
pub use scale::Scale;
pub use setting::Setting;
pub use writer::{check, WriteError, Writer};

/// A request to a device.
pub trait Message {
    /// Type of the reply. If the device description declares no reply, this type is a slice of the raw bytes.
    type Reply<'r>: Reply<'r>;

    /// Type of the device's refusal; [`Infallible`] if the device never refuses the request.
    type Refusal: for<'r> Reply<'r>;

    /// Name of the request in the device description.
    const NAME: &'static str;

    /// Specifies when the device completes the request.
    const COMPLETION: Completion;

    /// Writes the data of the request for the device with this station address. Protocols without station addresses
    /// ignore `station`.
    ///
    /// # Errors
    ///
    /// Returns an error if a field is outside its limits, if a parameter doesn't exist, if a value has the wrong
    /// length, or if the data don't fit into the buffer.
    fn write(&self, station: u32, to: &mut Writer<'_>) -> Result<(), WriteError>;
}

/// The reply to a [`Message`]. A program decodes replies; a simulated device encodes them.
pub trait Reply<'r>: Sized {
    /// True if this reply accepts any data. In this case, received data are checked for a refusal first.
    const IS_ANYTHING: bool = false;

    /// Decodes the reply to a request. Returns `None` unless all data match the reply. Parts of the reply that repeat
    /// the request must be equal to the request.
    fn read(request: &[u8], from: &mut Reader<'r>) -> Option<Self>;

    /// Writes the data of the reply to a request.
    ///
    /// # Errors
    ///
    /// Returns an error if a field is outside its limits, if a parameter doesn't exist, if a value has the wrong
    /// length, if the data don't fit into the buffer, or if a part that the reply repeats is missing or different in
    /// the request.
    fn write(&self, request: &[u8], to: &mut Writer<'_>) -> Result<(), WriteError>;
}

/// Refusal type of requests that a device never refuses.
impl Reply<'_> for Infallible {
    fn read(_: &[u8], _: &mut Reader<'_>) -> Option<Self> {
        None
    }

    fn write(&self, _: &[u8], _: &mut Writer<'_>) -> Result<(), WriteError> {
        match *self {}
    }
}

/// Raw bytes, as the reply to a request without a declared reply.
impl<'r> Reply<'r> for &'r [u8] {
    const IS_ANYTHING: bool = true;

    fn read(_: &[u8], from: &mut Reader<'r>) -> Option<Self> {
        from.but(0)
    }

    fn write(&self, _: &[u8], to: &mut Writer<'_>) -> Result<(), WriteError> {
        to.bytes(self)
    }
}

/// A [`Message`] that a simulated device or a test can decode.
pub trait Request<'r>: Message + Sized {
    /// Decodes the station address and the request. Returns `None` if the data contain another request. The station
    /// address is 0 if the protocol has no station addresses.
    ///
    /// Values are not checked against their limits. Limits are checked only when a request is encoded.
    fn parse(from: &mut Reader<'r>) -> Option<(u32, Self)>;
}

/// Decodes the reply to the request `M`.
///
/// # Errors
///
/// Returns [`Error::Refused`] if the device refuses the request, or [`Error::UnexpectedReply`] if the data contain
/// another reply.
pub fn read<'r, M: Message, E>(request: &[u8], reply: &'r [u8]) -> Result<M::Reply<'r>, Error<E>> {
    answer::<E, M>(request, reply).map_err(Failure::into_error)
}

/// Specifies when a device completes a request.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Completion {
    /// The device completes the request before it sends the reply.
    Immediate,
    /// The device sends the reply when the request is completed, which may take a long time.
    Reply,
    /// A field of a reply, or an item, indicates whether the request is completed. Replies with such a field have the
    /// method `is_complete`.
    Polled,
    /// The device has completed the request after this number of milliseconds.
    Delayed(u32),
}

/// A request that determines the meaning of later requests. A generated device has the methods for these requests only
/// after the selector has been sent.
///
/// [`Call::select`] sends the selector and returns a device with these methods.
pub trait Selector: Message {
    /// Type of the device with the methods for these requests. `C` is the client.
    type Device<C>;

    /// Creates the device with the client `client`. The hardware must already have received the selector.
    fn device<C>(client: C) -> Self::Device<C>;
}

/// Typestate of a device to which no [`Selector`] has been sent, or whose last selector is unknown.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Unselected;
