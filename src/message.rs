//! Requests and replies of a command protocol, as types.
//!
//! Generated bindings have a [`Message`] for every request, with its fields, and a type for what is answered. [`Call`] sends
//! one through anything that is a [`MessageClient`], such as [`Parameters`](crate::Parameters) over an
//! [`Exchange`](crate::Exchange). Nothing allocates: lists are slices where they are sent, and are read from the reply's bytes
//! one by one.
//!
//! ```
//! use lexibus::message::{Completion, Message, Reader, Reply, WriteError, Writer};
//!
//! // What the compiler emits for a request `node 0x40 speed` that is answered by `node 0x40 status`:
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

/// A request.
pub trait Message {
    /// What the device answers. The bytes as they come, where its description doesn't say.
    type Reply<'r>: Reply<'r>;

    /// What the device answers instead where it refuses; [`Infallible`] where it has no such answer.
    type Refusal: for<'r> Reply<'r>;

    /// The name of the request, as the device's description has it.
    const NAME: &'static str;

    /// When the order is carried out.
    const COMPLETION: Completion;

    /// Writes the data of the request to the device with this number. A protocol without numbers of devices ignores it.
    ///
    /// # Errors
    ///
    /// Where a field is outside its limits, or the data don't fit.
    fn write(&self, station: u32, to: &mut Writer<'_>) -> Result<(), WriteError>;
}

/// What is answered to a [`Message`]. A program reads it; a simulated device writes it.
pub trait Reply<'r>: Sized {
    /// Whether any data are such a reply, so that only a refusal can tell itself from it.
    const IS_ANYTHING: bool = false;

    /// The reply to a request, with all of its data; `None` where the data are something else. What comes back of the request is
    /// held against what was sent.
    fn read(request: &[u8], from: &mut Reader<'r>) -> Option<Self>;

    /// Writes the data of the reply to a request.
    ///
    /// # Errors
    ///
    /// Where a field is outside its limits, the data don't fit, or the request is shorter than what comes back of it.
    fn write(&self, request: &[u8], to: &mut Writer<'_>) -> Result<(), WriteError>;
}

/// Never: what a device answers that can't refuse.
impl Reply<'_> for Infallible {
    fn read(_: &[u8], _: &mut Reader<'_>) -> Option<Self> {
        None
    }

    fn write(&self, _: &[u8], _: &mut Writer<'_>) -> Result<(), WriteError> {
        match *self {}
    }
}

/// Any bytes.
impl<'r> Reply<'r> for &'r [u8] {
    const IS_ANYTHING: bool = true;

    fn read(_: &[u8], from: &mut Reader<'r>) -> Option<Self> {
        from.but(0)
    }

    fn write(&self, _: &[u8], to: &mut Writer<'_>) -> Result<(), WriteError> {
        to.bytes(self)
    }
}

/// The device's side of a [`Message`], for simulators and tests: a request that is read.
pub trait Request<'r>: Message + Sized {
    /// The number of the device that is meant, and the request; `None` where the data are another one. A protocol without
    /// numbers of devices has 0.
    ///
    /// Values are taken as they come: limits are checked only where a request is written.
    fn parse(from: &mut Reader<'r>) -> Option<(u32, Self)>;
}

/// The reply to a request, which is `M`.
///
/// # Errors
///
/// [`Error::Refused`] where the device refuses, [`Error::UnexpectedReply`] where the data are something else.
pub fn read<'r, M: Message, E>(request: &[u8], reply: &'r [u8]) -> Result<M::Reply<'r>, Error<E>> {
    answer::<E, M>(request, reply).map_err(Failure::into_error)
}

/// When an order is carried out.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Completion {
    /// Before the reply.
    Immediate,
    /// When the reply comes, which may take long.
    Reply,
    /// When a field of replies, or an item, says so. Replies that have the field have a method `is_complete`.
    Polled,
    /// After so many milliseconds.
    Delayed(u32),
}

/// A request that decides what a later one means. Generated devices have the later ones only once it was sent.
///
/// [`Call::select`] sends it and gives the device that has them.
pub trait Selector: Message {
    /// The device, over a client `C`.
    type Device<C>;

    /// The device over `client`, which has been sent this request.
    fn device<C>(client: C) -> Self::Device<C>;
}

/// The state of a device that may have been sent any [`Selector`], or none.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Unselected;
