//! Requests and replies of a command protocol as types.
//!
//! Generated bindings have a [`Message`] type for every request, and a type for its reply. [`Call`] sends a message
//! through a [`MessageClient`], for example [`Parameters`](crate::Parameters) over an [`Exchange`](crate::Exchange).
//! Nothing allocates: lists in requests are slices, and lists in replies are read from the reply's bytes one element at
//! a time.
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
    /// Type of the reply: the raw bytes if the device description declares none.
    type Reply<'r>: Reply<'r>;

    /// Type of the reply if the device refuses the request; [`Infallible`] if it has no such reply.
    type Refusal: for<'r> Reply<'r>;

    /// Name of the request in the device description.
    const NAME: &'static str;

    /// When the device has completed the request.
    const COMPLETION: Completion;

    /// Writes the data of the request to the device with this station address. Protocols without station addresses
    /// ignore `station`.
    ///
    /// # Errors
    ///
    /// If a field is outside its limits, or the data don't fit.
    fn write(&self, station: u32, to: &mut Writer<'_>) -> Result<(), WriteError>;
}

/// The reply to a [`Message`]. A program reads it; a simulated device writes it.
pub trait Reply<'r>: Sized {
    /// Whether any data match this reply. The data are then checked for a refusal first.
    const IS_ANYTHING: bool = false;

    /// Reads the reply to a request. Returns `None` if the data don't match the reply as a whole. Parts that repeat the
    /// request are compared with it.
    fn read(request: &[u8], from: &mut Reader<'r>) -> Option<Self>;

    /// Writes the data of the reply to a request.
    ///
    /// # Errors
    ///
    /// If a field is outside its limits, the data don't fit, or the request is shorter than the part that the reply
    /// repeats.
    fn write(&self, request: &[u8], to: &mut Writer<'_>) -> Result<(), WriteError>;
}

/// The refusal of a device that never refuses.
impl Reply<'_> for Infallible {
    fn read(_: &[u8], _: &mut Reader<'_>) -> Option<Self> {
        None
    }

    fn write(&self, _: &[u8], _: &mut Writer<'_>) -> Result<(), WriteError> {
        match *self {}
    }
}

/// A reply of any bytes.
impl<'r> Reply<'r> for &'r [u8] {
    const IS_ANYTHING: bool = true;

    fn read(_: &[u8], from: &mut Reader<'r>) -> Option<Self> {
        from.but(0)
    }

    fn write(&self, _: &[u8], to: &mut Writer<'_>) -> Result<(), WriteError> {
        to.bytes(self)
    }
}

/// The device's side of a [`Message`], for simulators and tests: reads a request.
pub trait Request<'r>: Message + Sized {
    /// Reads the station address and the request. Returns `None` if the data are another request. The station address
    /// is 0 if the protocol has none.
    ///
    /// Values are not checked against their limits. Limits are checked only when a request is written.
    fn parse(from: &mut Reader<'r>) -> Option<(u32, Self)>;
}

/// Reads the reply to the request `M`.
///
/// # Errors
///
/// [`Error::Refused`] if the device refuses, [`Error::UnexpectedReply`] if the data are another reply.
pub fn read<'r, M: Message, E>(request: &[u8], reply: &'r [u8]) -> Result<M::Reply<'r>, Error<E>> {
    answer::<E, M>(request, reply).map_err(Failure::into_error)
}

/// When a device has completed a request.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Completion {
    /// Before it sends the reply.
    Immediate,
    /// When it sends the reply, which may take a long time.
    Reply,
    /// When a field of a later reply, or an item, reports it. Replies with this field have the method `is_complete`.
    Polled,
    /// After this time in milliseconds.
    Delayed(u32),
}

/// A request that determines the meaning of later requests. Generated devices offer these requests only after the
/// selector was sent.
///
/// [`Call::select`] sends it and returns the device with these requests.
pub trait Selector: Message {
    /// Type of the device with a client `C`.
    type Device<C>;

    /// Creates the device over `client`. The device must have received this request.
    fn device<C>(client: C) -> Self::Device<C>;
}

/// State of a device whose last [`Selector`] is unknown, or that has received none.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Unselected;
