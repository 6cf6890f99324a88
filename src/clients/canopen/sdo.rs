//! SDO transfers (CiA 301 7.2.4): one node's objects, read and written.

use core::time::Duration;

use canopen_sdo::{SdoAbortCode, SdoClient, SdoConfig, SdoError, SdoFrame, SdoOutcome};

use super::frame::CanFrame;
use super::node::Node;
use super::port::{AsyncCanPort, CanPort, BACKLOG};
use crate::abort::AbortCode;
use crate::bus::{CanOpen, Object};
use crate::client::{AsyncClient, Client};
use crate::error::{Error, LengthError};
use crate::node_id::NodeId;

/// A transfer on the default channel: requests on 0x600 + node-ID, answers on 0x580 + node-ID (CiA 301 7.3.5).
struct Transfer {
    client: SdoClient,
    answers: u16,
    object: Object,
    /// How many bytes there is room for, and of an upload in segments, how many these have brought.
    room: usize,
    received: Option<usize>,
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
        Self { client, answers: SdoFrame::tsdo_id(node.get()), object, room, received: None, outcome: None }
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
        self.client.poll_transmit().and_then(|frame| CanFrame::new(frame.cob_id, &frame.data))
    }

    /// Takes an answer, or `None` where none came.
    fn answer(&mut self, frame: Option<CanFrame>) {
        let Some(frame) = frame else {
            self.client.abort(SdoAbortCode::ProtocolTimeout);
            self.outcome = Some(Outcome::Late);
            return;
        };
        if let Some(length) = self.too_long(&frame.padded()) {
            self.client.abort(SdoAbortCode::OutOfMemory);
            self.outcome = Some(Outcome::TooLong(length));
            return;
        }
        self.outcome = match self.client.handle_frame(SdoFrame::new(self.answers, frame.padded()), 0) {
            Ok(Some(outcome)) => Some(Outcome::Done(outcome)),
            Ok(None) => None,
            Err(SdoError::ServerAborted(code)) => Some(Outcome::Refused(AbortCode(u32::from(code)))),
            Err(_) => Some(Outcome::Unexpected),
        };
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

    /// The end, once it is reached.
    fn end<E>(&mut self) -> Option<Result<SdoOutcome, Error<E>>> {
        Some(match self.outcome.take()? {
            Outcome::Done(outcome) => Ok(outcome),
            Outcome::Refused(code) => Err(Error::Abort(code)),
            Outcome::Unexpected => Err(Error::UnexpectedReply),
            Outcome::TooLong(length) => Err(Error::Length(LengthError::new(self.room, length))),
            Outcome::Late => Err(Error::Timeout),
        })
    }
}

/// Puts what was uploaded to the start of `buffer`, and gives its length.
fn uploaded<E>(outcome: SdoOutcome, buffer: &mut [u8]) -> Result<usize, Error<E>> {
    let SdoOutcome::UploadCompleted(data) = outcome else { return Err(Error::UnexpectedReply) };
    buffer.iter_mut().zip(&data).for_each(|(to, from)| *to = *from);
    Ok(data.len())
}

impl<P: CanPort> Node<P> {
    fn run(&mut self, mut transfer: Transfer) -> Result<SdoOutcome, Error<P::Error>> {
        let (answers, timeout) = (transfer.answers, self.timeout());
        let mut of_node = |frame: &CanFrame| frame.id() == answers;
        let mut old = if self.is_unfinished { BACKLOG } else { 0 };
        while old > 0 && self.port().receive(Duration::ZERO, &mut of_node).map_err(Error::Client)?.is_some() {
            old -= 1;
        }
        self.is_unfinished = true;
        loop {
            while let Some(frame) = transfer.request() {
                self.send(&frame)?;
            }
            if let Some(end) = transfer.end() {
                self.is_unfinished = !matches!(end, Ok(_) | Err(Error::Abort(_)));
                return end;
            }
            let answer = self.port().receive(timeout, &mut of_node);
            transfer.answer(answer.map_err(Error::Client)?);
        }
    }
}

impl<P: CanPort> Client for Node<P> {
    type Bus = CanOpen;
    type Error = P::Error;

    fn read(&mut self, address: Object, buffer: &mut [u8]) -> Result<usize, Error<P::Error>> {
        let outcome = self.run(Transfer::upload(self.id(), address, buffer.len())?)?;
        uploaded(outcome, buffer)
    }

    fn write(&mut self, address: Object, data: &[u8]) -> Result<(), Error<P::Error>> {
        self.run(Transfer::download(self.id(), address, data)?).map(|_| ())
    }
}

impl<P: AsyncCanPort> Node<P> {
    async fn run_async(&mut self, mut transfer: Transfer) -> Result<SdoOutcome, Error<P::Error>> {
        let (answers, timeout) = (transfer.answers, self.timeout());
        let mut of_node = |frame: &CanFrame| frame.id() == answers;
        let mut old = if self.is_unfinished { BACKLOG } else { 0 };
        while old > 0 && self.port().receive(Duration::ZERO, &mut of_node).await.map_err(Error::Client)?.is_some() {
            old -= 1;
        }
        self.is_unfinished = true;
        loop {
            while let Some(frame) = transfer.request() {
                self.send_async(&frame).await?;
            }
            if let Some(end) = transfer.end() {
                self.is_unfinished = !matches!(end, Ok(_) | Err(Error::Abort(_)));
                return end;
            }
            let answer = self.port().receive(timeout, &mut of_node).await;
            transfer.answer(answer.map_err(Error::Client)?);
        }
    }
}

impl<P: AsyncCanPort> AsyncClient for Node<P> {
    type Bus = CanOpen;
    type Error = P::Error;

    async fn read(&mut self, address: Object, buffer: &mut [u8]) -> Result<usize, Error<P::Error>> {
        let outcome = self.run_async(Transfer::upload(self.id(), address, buffer.len())?).await?;
        uploaded(outcome, buffer)
    }

    async fn write(&mut self, address: Object, data: &[u8]) -> Result<(), Error<P::Error>> {
        self.run_async(Transfer::download(self.id(), address, data)?).await.map(|_| ())
    }
}
