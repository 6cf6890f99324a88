//! SDO transfers (CiA 301 7.2.4): one node's objects, read and written.

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

/// A transfer on the default channel: requests on 0x600 + node-ID, answers on 0x580 + node-ID (CiA 301 7.3.5).
struct Transfer {
    client: SdoClient,
    answers: u16,
    object: Object,
    /// How many bytes there is room for, and of an upload in segments, how many these have brought.
    room: usize,
    received: Option<usize>,
    /// Whether the answer has all of the value and no length.
    is_unsized: bool,
    /// What the answer asks for.
    next: Option<SdoFrame>,
    /// How many more frames that have nothing to do with it are passed over.
    strangers: usize,
    outcome: Option<Outcome>,
}

/// How a transfer ended.
enum Outcome {
    Done(SdoOutcome),
    Refused(AbortCode),
    Unexpected,
    TooLong(usize),
    Late,
}

impl Transfer {
    fn new(node: NodeId, object: Object, room: usize) -> Self {
        // The times are those of the port.
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

    /// Whether a frame may be an answer: a message of SDO has eight bytes (CiA 301 7.2.4.3).
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
            // An SDO has no way to say so.
            return Err(Error::Length(LengthError::new(1, 0)));
        }
        let mut transfer = Self::new(node, object, data.len());
        let begun = transfer.client.begin_download(node.get(), object.index, object.sub_index, data, 0);
        begun.map_err(|_| Error::UnexpectedReply)?;
        Ok(transfer)
    }

    /// The next frame to be sent.
    fn request(&mut self) -> Option<CanFrame> {
        let frame = self.next.take().or_else(|| self.client.poll_transmit())?;
        CanFrame::new(frame.cob_id, &frame.data)
    }

    /// Gives the transfer up, and tells the node why.
    fn give_up(&mut self, code: SdoAbortCode, outcome: Outcome) {
        self.client.abort(code);
        self.outcome = Some(outcome);
    }

    /// Takes an answer, or `None` where none came.
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

    /// Passes over an answer to somebody else. Each has its own time, so that there must not be too many.
    fn pass_over(&mut self) {
        self.strangers -= 1;
        if self.strangers == 0 {
            self.give_up(SdoAbortCode::ProtocolTimeout, Outcome::Late);
        }
    }

    /// Whether this is a segment that brings nothing and isn't the last one: there could be any number.
    const fn is_empty_segment(&self, data: &[u8; 8]) -> bool {
        self.received.is_some() && data[0] & 0xEF == 0x0E
    }

    /// How many bytes an upload has that has more than there is room for: by the length that the device announces, or by its
    /// segments where it announces none. Memory is for what fits only.
    fn too_long(&mut self, data: &[u8; 8]) -> Option<usize> {
        let [command, low, high, sub_index, length @ ..] = *data;
        let length = match (command >> 5, self.received) {
            // The answer to the request of an upload; bit 1 says that all is in it, bit 0 that there is a length.
            (2, None) if command & 2 == 0 && self.object == Object::new(u16::from_le_bytes([low, high]), sub_index) => {
                self.received = Some(0);
                if command & 1 == 1 {
                    u32::from_le_bytes(length) as usize
                } else {
                    0
                }
            }
            // A segment; bits 1 to 3 say how many of its seven bytes have no data.
            (0, Some(received)) => {
                let received = received + 7 - usize::from(command >> 1 & 7);
                self.received = Some(received);
                received
            }
            _ => 0,
        };
        Some(length).filter(|length| *length > self.room)
    }

    /// What tells the node that nobody listens any more, because of the interface.
    fn broken(&mut self) -> Option<CanFrame> {
        self.client.abort(SdoAbortCode::General);
        self.request()
    }

    /// The end, once it is reached.
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

/// A transfer that was done.
struct Done {
    outcome: SdoOutcome,
    is_unsized: bool,
}

impl Done {
    /// Puts what was uploaded to the start of `buffer`, and gives its length: where none was sent, there are as many bytes as
    /// asked for.
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
                // Answers to requests that were given up may have come late.
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
                            // The node needn't wait for the rest. Whether that reaches it doesn't matter to the caller.
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
