//! SDO transfers (CiA 301 7.2.4) that read and write the objects of one node.

use core::time::Duration;

use canopen_sdo::{SdoAbortCode, SdoClient, SdoConfig, SdoError, SdoFrame, SdoOutcome};

use super::frame::CanFrame;
use super::node::Node;
use super::port::{AsyncCanPort, CanPort, BACKLOG};
use crate::abort::AbortCode;
use crate::bus::{CanOpen, Object};
use crate::client::{AsyncClient, Client};
use crate::error::Error;
use crate::node_id::NodeId;
use crate::value_error::LengthError;

/// An SDO transfer on the default channel: requests with COB-ID 0x600 + node-ID, replies with 0x580 + node-ID (CiA 301
/// 7.3.5).
struct Transfer {
    client: SdoClient,
    answers: u16,
    object: Object,
    /// Size of the caller's buffer in bytes, and for a segmented upload, the number of bytes received.
    room: usize,
    received: Option<usize>,
    /// Whether the reply contains the whole value but no length.
    is_unsized: bool,
    /// Next frame to send in response to the reply.
    next: Option<SdoFrame>,
    /// How many more replies to other transfers are ignored before the transfer fails.
    strangers: usize,
    outcome: Option<Outcome>,
}

/// Result of a transfer.
enum Outcome {
    Done(SdoOutcome),
    Refused(AbortCode),
    Unexpected,
    TooLong(usize),
    Late,
}

impl Transfer {
    fn new(node: NodeId, object: Object, room: usize) -> Self {
        // The port measures the timeout.
        let client = SdoClient::new(SdoConfig { timeout: u64::MAX });
        Self {
            client,
            answers: SdoFrame::tsdo_id(node.get()),
            object,
            room,
            received: None,
            is_unsized: false,
            next: None,
            strangers: BACKLOG,
            outcome: None,
        }
    }

    /// Returns a filter for possible replies. An SDO message has eight bytes (CiA 301 7.2.4.3).
    fn is_answer(answers: u16) -> impl FnMut(&CanFrame) -> bool {
        move |frame| frame.id() == answers && frame.data().len() == 8
    }

    fn upload<E>(node: NodeId, object: Object, room: usize) -> Result<Self, Error<E>> {
        let mut transfer = Self::new(node, object, room);
        let begun = transfer.client.begin_upload(node.get(), object.index, object.sub_index, 0);
        begun.map_err(|_| Error::UnexpectedReply)?;
        Ok(transfer)
    }

    fn download<E>(node: NodeId, object: Object, data: &[u8]) -> Result<Self, Error<E>> {
        if data.is_empty() {
            // An SDO transfer can't have the length 0.
            return Err(Error::Length(LengthError::new(1, 0)));
        }
        let mut transfer = Self::new(node, object, data.len());
        let begun = transfer.client.begin_download(node.get(), object.index, object.sub_index, data, 0);
        begun.map_err(|_| Error::UnexpectedReply)?;
        Ok(transfer)
    }

    /// Returns the next frame to send.
    fn request(&mut self) -> Option<CanFrame> {
        let frame = self.next.take().or_else(|| self.client.poll_transmit())?;
        CanFrame::new(frame.cob_id, &frame.data)
    }

    /// Aborts the transfer and sends the abort code to the node.
    fn give_up(&mut self, code: SdoAbortCode, outcome: Outcome) {
        self.client.abort(code);
        self.outcome = Some(outcome);
    }

    /// Processes a reply, or `None` after a timeout.
    fn answer(&mut self, frame: Option<CanFrame>) {
        let Some(frame) = frame else { return self.give_up(SdoAbortCode::ProtocolTimeout, Outcome::Late) };
        let data = frame.padded();
        if let Some(length) = self.too_long(&data) {
            return self.give_up(SdoAbortCode::OutOfMemory, Outcome::TooLong(length));
        }
        if self.is_empty_segment(&data) {
            return self.give_up(SdoAbortCode::DataTypeLengthMismatch, Outcome::Unexpected);
        }
        self.is_unsized = self.received.is_none() && data[0] & 0xE3 == 0x42;
        self.outcome = match self.client.handle_frame(SdoFrame::new(self.answers, data), 0) {
            Ok(Some(outcome)) => Some(Outcome::Done(outcome)),
            Ok(None) => None,
            Err(SdoError::ServerAborted(code)) => Some(Outcome::Refused(AbortCode(u32::from(code)))),
            Err(_) => Some(Outcome::Unexpected),
        };
        self.next = self.client.poll_transmit();
        if self.outcome.is_none() && self.next.is_none() {
            self.pass_over();
        }
    }

    /// Ignores a reply to another transfer. Each reply restarts the timeout, so their number is limited.
    fn pass_over(&mut self) {
        self.strangers -= 1;
        if self.strangers == 0 {
            self.give_up(SdoAbortCode::ProtocolTimeout, Outcome::Late);
        }
    }

    /// Returns whether this is a segment without data that isn't the last one. A node could send these forever.
    const fn is_empty_segment(&self, data: &[u8; 8]) -> bool {
        self.received.is_some() && data[0] & 0xEF == 0x0E
    }

    /// Returns the length of an upload if it is longer than the caller's buffer. This is the length that the node
    /// announces, or the length of the segments if it announces none. Memory is allocated only for data that fit.
    fn too_long(&mut self, data: &[u8; 8]) -> Option<usize> {
        let [command, low, high, sub_index, length @ ..] = *data;
        let length = match (command >> 5, self.received) {
            // Reply to the upload request. Bit 1 means that it contains the whole value, bit 0 that it contains a
            // length.
            (2, None) if command & 2 == 0 && self.object == Object::new(u16::from_le_bytes([low, high]), sub_index) => {
                self.received = Some(0);
                if command & 1 == 1 {
                    u32::from_le_bytes(length) as usize
                } else {
                    0
                }
            }
            // A segment. Bits 1 to 3 are the number of its seven bytes without data.
            (0, Some(received)) => {
                let received = received + 7 - usize::from(command >> 1 & 7);
                self.received = Some(received);
                received
            }
            _ => 0,
        };
        Some(length).filter(|length| *length > self.room)
    }

    /// Aborts the transfer after the interface has failed, and returns the abort message to the node.
    fn broken(&mut self) -> Option<CanFrame> {
        self.client.abort(SdoAbortCode::General);
        self.request()
    }

    /// Returns the result if the transfer has ended.
    fn end<E>(&mut self) -> Option<Result<Done, Error<E>>> {
        Some(match self.outcome.take()? {
            Outcome::Done(outcome) => Ok(Done { outcome, is_unsized: self.is_unsized }),
            Outcome::Refused(code) => Err(Error::Abort(code)),
            Outcome::Unexpected => Err(Error::UnexpectedReply),
            Outcome::TooLong(length) => Err(Error::Length(LengthError::new(self.room, length))),
            Outcome::Late => Err(Error::Timeout),
        })
    }
}

/// A completed transfer.
struct Done {
    outcome: SdoOutcome,
    is_unsized: bool,
}

impl Done {
    /// Copies the uploaded value to the start of `buffer` and returns its length. If the node sent no length, the value
    /// has the requested length.
    fn uploaded<E>(&self, buffer: &mut [u8]) -> Result<usize, Error<E>> {
        let SdoOutcome::UploadCompleted(data) = &self.outcome else { return Err(Error::UnexpectedReply) };
        buffer.iter_mut().zip(data).for_each(|(to, from)| *to = *from);
        Ok(if self.is_unsized { data.len().min(buffer.len()) } else { data.len() })
    }
}

macro_rules! transfers {
    ($Port:ident $Client:ident $send:ident $run:ident $($async:ident $await:ident)?) => {
        impl<P: $Port> Node<P> {
            $($async)? fn $run(&mut self, mut transfer: Transfer) -> Result<Done, Error<P::Error>> {
                let (mut of_node, timeout) = (Transfer::is_answer(transfer.answers), self.timeout());
                // Late replies to earlier requests may still be waiting.
                let mut old = BACKLOG;
                while old > 0 {
                    let late = self.port().receive(Duration::ZERO, &mut of_node)$(.$await)?;
                    old = if late.map_err(Error::Client)?.is_some() { old - 1 } else { 0 };
                }
                loop {
                    while let Some(frame) = transfer.request() {
                        self.$send(&frame)$(.$await)??;
                    }
                    if let Some(end) = transfer.end() {
                        return end;
                    }
                    match self.port().receive(timeout, &mut of_node)$(.$await)? {
                        Ok(answer) => transfer.answer(answer),
                        Err(error) => {
                            // Abort, so that the node doesn't wait for the rest. The caller gets the first error, even
                            // if sending the abort fails.
                            if let Some(abort) = transfer.broken() {
                                let _ = self.$send(&abort)$(.$await)?;
                            }
                            return Err(Error::Client(error));
                        }
                    }
                }
            }
        }

        impl<P: $Port> $Client for Node<P> {
            type Bus = CanOpen;
            type Error = P::Error;

            $($async)? fn read(&mut self, address: Object, buffer: &mut [u8]) -> Result<usize, Error<P::Error>> {
                let transfer = Transfer::upload(self.id(), address, buffer.len())?;
                self.$run(transfer)$(.$await)??.uploaded(buffer)
            }

            $($async)? fn write(&mut self, address: Object, data: &[u8]) -> Result<(), Error<P::Error>> {
                let transfer = Transfer::download(self.id(), address, data)?;
                self.$run(transfer)$(.$await)?.map(|_| ())
            }
        }
    };
}

transfers! { CanPort Client send run }
transfers! { AsyncCanPort AsyncClient send_async run_async async await }
