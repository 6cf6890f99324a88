//! CANopen: SDO transfers over any CAN interface (CiA 301 7.2.4), expedited and segmented.
//!
//! ```
//! use std::time::{Duration, Instant};
//!
//! use lexibus::clients::canopen::{Polled, Sdo};
//! use lexibus::{CanOpen, Item, NodeId, OnCanOpen, Rw};
//!
//! const TARGET_POSITION: Item<i32, Rw, OnCanOpen> = Item::object(0x607A, 0, "Target position");
//!
//! /// Any CAN interface, of a microcontroller or of a computer.
//! fn move_to<C: embedded_can::nb::Can>(can: C, position: i32) -> Result<(), lexibus::Error<C::Error>> {
//!     let start = Instant::now();
//!     let port = Polled::new(can, move || start.elapsed());
//!     let mut node = Sdo::new(port, NodeId::new(5).expect("a node-ID"));
//!     TARGET_POSITION.at(&mut node).write(position)
//! }
//! ```
//!
//! The buffer of a transfer is allocated; all else is on the stack.

use core::time::Duration;

use canopen_sdo::{SdoAbortCode, SdoClient, SdoConfig, SdoError, SdoFrame, SdoOutcome};
use embedded_can::{Id, StandardId};

use crate::abort::AbortCode;
use crate::bus::{CanOpen, Object};
use crate::client::Client;
use crate::error::{Error, LengthError};
use crate::node_id::NodeId;

/// How long an answer may take where nothing else is said.
pub const TIMEOUT: Duration = Duration::from_millis(500);

/// A data frame with an identifier of 11 bits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CanFrame {
    id: u16,
    data: [u8; 8],
    length: u8,
}

impl CanFrame {
    /// A frame; `None` where `id` has more than 11 bits, or there are more than 8 bytes.
    #[must_use]
    pub fn new(id: u16, data: &[u8]) -> Option<Self> {
        let mut bytes = [0; 8];
        bytes.get_mut(..data.len())?.copy_from_slice(data);
        (id <= 0x7FF).then_some(Self { id, data: bytes, length: data.len() as u8 })
    }

    /// The identifier (COB-ID).
    #[must_use]
    pub const fn id(&self) -> u16 {
        self.id
    }

    /// The bytes.
    #[must_use]
    pub fn data(&self) -> &[u8] {
        &self.data[..usize::from(self.length)]
    }

    /// A frame of a library; `None` for one without data of its own, or with an identifier of 29 bits.
    pub fn from_frame(frame: &impl embedded_can::Frame) -> Option<Self> {
        match frame.id() {
            Id::Standard(id) if frame.is_data_frame() => Self::new(id.as_raw(), frame.data()),
            _ => None,
        }
    }

    /// The same as a frame of a library; `None` where it has none like it.
    pub fn to_frame<F: embedded_can::Frame>(&self) -> Option<F> {
        F::new(StandardId::new(self.id)?, self.data())
    }
}

/// A CAN interface that waits for a while.
pub trait CanPort {
    /// What can go wrong at the interface.
    type Error;

    /// Sends a frame. `false` where that couldn't be done within `patience`.
    ///
    /// # Errors
    ///
    /// Whatever the interface reports.
    fn send(&mut self, frame: &CanFrame, patience: Duration) -> Result<bool, Self::Error>;

    /// The next frame with this identifier; others are passed over. `None` where none came within `patience`.
    ///
    /// # Errors
    ///
    /// Whatever the interface reports.
    fn receive(&mut self, id: u16, patience: Duration) -> Result<Option<CanFrame>, Self::Error>;
}

impl<P: CanPort + ?Sized> CanPort for &mut P {
    type Error = P::Error;

    fn send(&mut self, frame: &CanFrame, patience: Duration) -> Result<bool, P::Error> {
        P::send(self, frame, patience)
    }

    fn receive(&mut self, id: u16, patience: Duration) -> Result<Option<CanFrame>, P::Error> {
        P::receive(self, id, patience)
    }
}

/// An interface of `embedded-can` that never waits, and a clock: the time since any moment.
#[derive(Clone, Debug)]
pub struct Polled<C, T> {
    can: C,
    clock: T,
}

impl<C, T: FnMut() -> Duration> Polled<C, T> {
    /// The interface `can`, with a clock that never goes back.
    pub const fn new(can: C, clock: T) -> Self {
        Self { can, clock }
    }

    /// Gives the interface back.
    pub fn into_inner(self) -> C {
        self.can
    }
}

impl<C: embedded_can::nb::Can, T: FnMut() -> Duration> CanPort for Polled<C, T> {
    type Error = C::Error;

    fn send(&mut self, frame: &CanFrame, patience: Duration) -> Result<bool, C::Error> {
        let end = (self.clock)() + patience;
        let mut next: Option<C::Frame> = frame.to_frame();
        while let Some(frame) = next.take() {
            // A frame of lower priority that made room comes back, and is sent after this one.
            next = loop {
                match self.can.transmit(&frame) {
                    Ok(displaced) => break displaced,
                    Err(nb::Error::Other(error)) => return Err(error),
                    Err(nb::Error::WouldBlock) if (self.clock)() >= end => return Ok(false),
                    Err(nb::Error::WouldBlock) => core::hint::spin_loop(),
                }
            };
        }
        Ok(true)
    }

    fn receive(&mut self, id: u16, patience: Duration) -> Result<Option<CanFrame>, C::Error> {
        let end = (self.clock)() + patience;
        loop {
            match self.can.receive() {
                Ok(frame) => {
                    if let Some(own) = CanFrame::from_frame(&frame).filter(|own| own.id == id) {
                        return Ok(Some(own));
                    }
                }
                Err(nb::Error::Other(error)) => return Err(error),
                Err(nb::Error::WouldBlock) => core::hint::spin_loop(),
            }
            if (self.clock)() >= end {
                return Ok(None);
            }
        }
    }
}

/// The default SDO channel of one node: requests on 0x600 + node-ID, answers on 0x580 + node-ID (CiA 301 7.3.5).
#[derive(Clone, Debug)]
pub struct Sdo<P> {
    port: P,
    node: NodeId,
    timeout: Duration,
}

impl<P: CanPort> Sdo<P> {
    /// The node `node` behind `port`. An answer may take [`TIMEOUT`].
    pub const fn new(port: P, node: NodeId) -> Self {
        Self { port, node, timeout: TIMEOUT }
    }

    /// The same with another time for each answer.
    #[must_use]
    pub const fn with_timeout(mut self, timeout: Duration) -> Self {
        self.timeout = timeout;
        self
    }

    /// The node.
    pub const fn node(&self) -> NodeId {
        self.node
    }

    /// The interface.
    pub fn port(&mut self) -> &mut P {
        &mut self.port
    }

    /// Gives the interface back.
    pub fn into_port(self) -> P {
        self.port
    }

    fn send(&mut self, frame: SdoFrame) -> Result<(), Error<P::Error>> {
        let frame = CanFrame { id: frame.cob_id, data: frame.data, length: 8 };
        match self.port.send(&frame, self.timeout).map_err(Error::Client)? {
            true => Ok(()),
            false => Err(Error::Abort(AbortCode::TIMEOUT)),
        }
    }

    /// Carries a transfer to its end.
    fn run(&mut self, mut transfer: SdoClient) -> Result<SdoOutcome, Error<P::Error>> {
        let answers = SdoFrame::tsdo_id(self.node.get());
        loop {
            while let Some(frame) = transfer.poll_transmit() {
                self.send(frame)?;
            }
            let Some(frame) = self.port.receive(answers, self.timeout).map_err(Error::Client)? else {
                transfer.abort(SdoAbortCode::ProtocolTimeout);
                if let Some(frame) = transfer.poll_transmit() {
                    self.send(frame)?;
                }
                return Err(Error::Abort(AbortCode::TIMEOUT));
            };
            match transfer.handle_frame(SdoFrame::new(answers, frame.data), 0) {
                Ok(Some(outcome)) => return Ok(outcome),
                Ok(None) => {}
                Err(error) => {
                    if let Some(frame) = transfer.poll_transmit() {
                        self.send(frame)?;
                    }
                    return Err(refused(&error));
                }
            }
        }
    }
}

fn refused<E>(error: &SdoError) -> Error<E> {
    match error {
        SdoError::ServerAborted(code) => Error::Abort(AbortCode(u32::from(*code))),
        _ => Error::UnexpectedReply,
    }
}

/// A transfer that hasn't begun. The times are those of the port.
fn transfer() -> SdoClient {
    SdoClient::new(SdoConfig { timeout: u64::MAX })
}

impl<P: CanPort> Client for Sdo<P> {
    type Bus = CanOpen;
    type Error = P::Error;

    fn read(&mut self, address: Object, buffer: &mut [u8]) -> Result<usize, Error<P::Error>> {
        let mut upload = transfer();
        let begun = upload.begin_upload(self.node.get(), address.index, address.sub_index, 0);
        begun.map_err(|error| refused(&error))?;
        let SdoOutcome::UploadCompleted(data) = self.run(upload)? else { return Err(Error::UnexpectedReply) };
        buffer.iter_mut().zip(&data).for_each(|(to, from)| *to = *from);
        Ok(data.len())
    }

    fn write(&mut self, address: Object, data: &[u8]) -> Result<(), Error<P::Error>> {
        if data.is_empty() {
            // An SDO has no way to say so.
            return Err(Error::Length(LengthError::new(1, 0)));
        }
        let mut download = transfer();
        let begun = download.begin_download(self.node.get(), address.index, address.sub_index, data, 0);
        begun.map_err(|error| refused(&error))?;
        self.run(download).map(|_| ())
    }
}

#[cfg(all(feature = "socketcan", target_os = "linux"))]
mod linux {
    use std::io;
    use std::time::Instant;

    use socketcan::{CanSocket, Socket};

    use super::{CanFrame, CanPort, Duration};

    impl CanPort for CanSocket {
        type Error = io::Error;

        fn send(&mut self, frame: &CanFrame, patience: Duration) -> Result<bool, io::Error> {
            let Some(frame) = frame.to_frame::<socketcan::CanFrame>() else { return Ok(false) };
            self.set_write_timeout(patience)?;
            match self.write_frame(&frame) {
                Ok(()) => Ok(true),
                Err(error) if is_late(&error) => Ok(false),
                Err(error) => Err(error),
            }
        }

        fn receive(&mut self, id: u16, patience: Duration) -> Result<Option<CanFrame>, io::Error> {
            let end = Instant::now() + patience;
            loop {
                let left = end.saturating_duration_since(Instant::now());
                if left.is_zero() {
                    return Ok(None);
                }
                match self.read_frame_timeout(left) {
                    Ok(frame) => {
                        if let Some(own) = CanFrame::from_frame(&frame).filter(|own| own.id() == id) {
                            return Ok(Some(own));
                        }
                    }
                    Err(error) if is_late(&error) => return Ok(None),
                    Err(error) => return Err(error),
                }
            }
        }
    }

    fn is_late(error: &io::Error) -> bool {
        matches!(error.kind(), io::ErrorKind::WouldBlock | io::ErrorKind::TimedOut)
    }
}

#[cfg(test)]
mod tests;
