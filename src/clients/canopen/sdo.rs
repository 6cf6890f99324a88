//! SDO transfers (CiA 301 7.2.4) that read and write the objects of one node.

use core::time::Duration;

use canopen_sdo::{SdoAbortCode, SdoClient, SdoConfig, SdoError, SdoFrame, SdoOutcome};

use super::frame::CanFrame;
use super::node::{sent, Node};
use super::port::{AsyncCanPort, CanPort, BACKLOG};
use crate::abort::AbortCode;
use crate::bus::{CanOpen, Object};
use crate::client::{AsyncClient, Client};
use crate::error::Error;
use crate::node_id::NodeId;
use crate::value_error::LengthError;

/// Command specifiers of a node's replies: bits 5 to 7 of the first byte.
const UPLOAD_SEGMENT: u8 = 0;
const DOWNLOAD_SEGMENT: u8 = 1;
const UPLOAD: u8 = 2;
const DOWNLOAD: u8 = 3;
const ABORT: u8 = 4;

/// Length of the data in a segment in bytes.
const SEGMENT: usize = 7;

/// The timeout divided by this number is the time by which each segment prolongs a transfer.
const SEGMENTS_PER_TIMEOUT: u32 = 10;

/// Returns the maximum duration of a transfer of `length` bytes.
fn limit(timeout: Duration, length: usize) -> Duration {
    let segments = u32::try_from(length.div_ceil(SEGMENT)).unwrap_or(u32::MAX);
    timeout.saturating_add((timeout / SEGMENTS_PER_TIMEOUT).saturating_mul(segments))
}

/// The expected reply to a request: a reply with this command specifier, or an abort for the same object.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Expected {
    answers: u16,
    object: Object,
    specifier: u8,
}

impl Expected {
    /// Returns whether the frame is the expected reply. An SDO message has eight bytes (CiA 301 7.2.4.3). Other frames
    /// are not accepted because they would restart the timeout.
    fn is(self, frame: &CanFrame) -> bool {
        let &[command, low, high, sub_index, ..] = frame.data() else { return false };
        let is_message = frame.id() == self.answers && frame.data().len() == 8;
        let is_of_object = self.object == Object::new(u16::from_le_bytes([low, high]), sub_index);
        is_message
            && match command >> 5 {
                ABORT => is_of_object,
                specifier => specifier == self.specifier && (self.is_segment() || is_of_object),
            }
    }

    /// Returns whether the reply confirms or contains a segment. Segments don't contain the address of their object.
    const fn is_segment(self) -> bool {
        matches!(self.specifier, UPLOAD_SEGMENT | DOWNLOAD_SEGMENT)
    }

    /// Returns the expected reply to the next segment.
    const fn segment(self) -> Self {
        let specifier = match self.specifier {
            UPLOAD => UPLOAD_SEGMENT,
            DOWNLOAD => DOWNLOAD_SEGMENT,
            other => other,
        };
        Self { specifier, ..self }
    }
}

/// A missing reply: the client gave up the transfer before the reply arrived, or the transfer was dropped.
#[derive(Clone, Copy, Debug)]
pub(super) struct Owed {
    reply: Expected,
    is_aborted: bool,
}

impl Owed {
    /// Returns the message that aborts the transfer (CiA 301 7.2.4.3.17).
    fn abort(&self, node: NodeId) -> CanFrame {
        let ([low, high], [a, b, c, d]) = (self.reply.object.index.to_le_bytes(), AbortCode::GENERAL.0.to_le_bytes());
        let data = [ABORT << 5, low, high, self.reply.object.sub_index, a, b, c, d];
        CanFrame::of(SdoFrame::rsdo_id(node.get()), data)
    }
}

/// An SDO transfer on the default channel: requests with COB-ID 0x600 + node-ID, replies with 0x580 + node-ID (CiA 301
/// 7.3.5).
struct Transfer {
    client: SdoClient,
    expected: Expected,
    /// Size of the caller's buffer in bytes.
    room: usize,
    /// Length of the value in bytes, as far as it is known. An upload without an announced length has the length of the
    /// received segments.
    length: usize,
    /// Time of the first request.
    start: Option<Duration>,
    /// Number of received bytes of a segmented upload.
    received: Option<usize>,
    /// True if the reply contains the whole value but no length.
    is_unsized: bool,
    /// Next frame to send in response to the reply.
    next: Option<SdoFrame>,
    /// True if the transfer was given up before the reply to its last request.
    is_owed: bool,
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
    fn new(node: NodeId, object: Object, specifier: u8, room: usize) -> Self {
        // The SDO client needs no timeout because the port measures it.
        let client = SdoClient::new(SdoConfig { timeout: u64::MAX });
        Self {
            client,
            expected: Expected { answers: SdoFrame::tsdo_id(node.get()), object, specifier },
            room,
            length: 0,
            start: None,
            received: None,
            is_unsized: false,
            next: None,
            is_owed: false,
            outcome: None,
        }
    }

    fn upload<E>(node: NodeId, object: Object, room: usize) -> Result<Self, Error<E>> {
        let mut transfer = Self::new(node, object, UPLOAD, room);
        let begun = transfer.client.begin_upload(node.get(), object.index, object.sub_index, 0);
        begun.map_err(|_| Error::UnexpectedReply)?;
        Ok(transfer)
    }

    fn download<E>(node: NodeId, object: Object, data: &[u8]) -> Result<Self, Error<E>> {
        if data.is_empty() {
            // An SDO transfer cannot have the length 0.
            return Err(Error::Length(LengthError::new(1, 0)));
        }
        let mut transfer = Self { length: data.len(), ..Self::new(node, object, DOWNLOAD, data.len()) };
        let begun = transfer.client.begin_download(node.get(), object.index, object.sub_index, data, 0);
        begun.map_err(|_| Error::UnexpectedReply)?;
        Ok(transfer)
    }

    /// Returns the next frame to send.
    fn request(&mut self) -> Option<CanFrame> {
        let frame = self.next.take().or_else(|| self.client.poll_transmit())?;
        CanFrame::new(frame.cob_id, &frame.data)
    }

    /// Returns how long to wait for the bus or the next reply: at most `timeout`, and at most until the transfer exceeds
    /// its limit. The message that aborts a transfer always has the whole timeout.
    fn patience(&self, now: Option<Duration>, timeout: Duration) -> Duration {
        match self.start.zip(now).filter(|_| self.outcome.is_none()) {
            Some((start, now)) => limit(timeout, self.length).saturating_sub(now.saturating_sub(start)).min(timeout),
            None => timeout,
        }
    }

    /// Returns the reply that the node still has to send after this request. Nodes don't reply to an abort message.
    fn owed(&self, request: &CanFrame) -> Option<Owed> {
        let is_aborted = request.data().first().is_some_and(|command| command >> 5 == ABORT);
        (self.is_owed || !is_aborted).then_some(Owed { reply: self.expected, is_aborted })
    }

    /// Aborts the transfer with this outcome. The next [`request`](Self::request) is the abort message with this code.
    fn give_up(&mut self, code: SdoAbortCode, outcome: Outcome) {
        self.client.abort(code);
        self.outcome = Some(outcome);
    }

    /// Processes a reply, or `None` after a timeout.
    fn answer(&mut self, frame: Option<CanFrame>) {
        let Some(frame) = frame else {
            self.is_owed = true;
            return self.give_up(SdoAbortCode::ProtocolTimeout, Outcome::Late);
        };
        let data = frame.padded();
        if let Some(length) = self.too_long(&data) {
            return self.give_up(SdoAbortCode::OutOfMemory, Outcome::TooLong(length));
        }
        if self.is_empty_segment(&data) {
            return self.give_up(SdoAbortCode::DataTypeLengthMismatch, Outcome::Unexpected);
        }
        self.is_unsized = self.received.is_none() && data[0] & 0xE3 == 0x42;
        self.outcome = match self.client.handle_frame(SdoFrame::new(self.expected.answers, data), 0) {
            Ok(Some(outcome)) => Some(Outcome::Done(outcome)),
            Ok(None) => None,
            Err(SdoError::ServerAborted(code)) => Some(Outcome::Refused(AbortCode(u32::from(code)))),
            Err(error) => {
                // A repeated segment arrived before the requested one.
                self.is_owed = matches!(error, SdoError::ClientAborted(SdoAbortCode::ToggleBitNotAlternated));
                Some(Outcome::Unexpected)
            }
        };
        self.next = self.client.poll_transmit();
        self.expected = self.expected.segment();
        if self.outcome.is_none() && self.next.is_none() {
            self.give_up(SdoAbortCode::General, Outcome::Unexpected);
        }
    }

    /// Returns whether a reply is an empty segment that isn't the last one. A node could send empty segments forever.
    const fn is_empty_segment(&self, data: &[u8; 8]) -> bool {
        self.received.is_some() && data[0] & 0xEF == 0x0E
    }

    /// Returns the length of an upload if it is longer than the caller's buffer. The length of an upload is the length
    /// that the node announces, or the length of the segments if the node announces none. Memory is allocated only for
    /// data that fit.
    fn too_long(&mut self, data: &[u8; 8]) -> Option<usize> {
        let [command, _, _, _, length @ ..] = *data;
        let length = match (command >> 5, self.received) {
            // This is the reply to the upload request. Bit 1 means that the reply contains the whole value. Bit 0 means
            // that the reply contains a length.
            (UPLOAD, None) if command & 2 == 0 => {
                self.received = Some(0);
                if command & 1 == 1 {
                    u32::from_le_bytes(length) as usize
                } else {
                    0
                }
            }
            // This is a segment of seven bytes. Bits 1 to 3 contain the number of unused bytes.
            (UPLOAD_SEGMENT, Some(received)) => {
                let received = received + SEGMENT - usize::from(command >> 1 & 7);
                self.received = Some(received);
                received
            }
            _ => 0,
        };
        self.length = self.length.max(length);
        Some(length).filter(|length| *length > self.room)
    }

    /// Aborts the transfer after the interface has failed, and returns the abort message for the node.
    fn broken(&mut self) -> Option<CanFrame> {
        self.is_owed = true;
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
    /// Copies the uploaded value to the start of `buffer` and returns its length. If the node sent no length, the
    /// length is that of `buffer`, but at most 4.
    fn uploaded<E>(&self, buffer: &mut [u8]) -> Result<usize, Error<E>> {
        let SdoOutcome::UploadCompleted(data) = &self.outcome else { return Err(Error::UnexpectedReply) };
        buffer.iter_mut().zip(data).for_each(|(to, from)| *to = *from);
        Ok(if self.is_unsized { data.len().min(buffer.len()) } else { data.len() })
    }
}

macro_rules! transfers {
    ($Port:ident $Client:ident $send:ident $settle:ident $run:ident $($async:ident $await:ident)?) => {
        impl<P: $Port> Node<P> {
            /// Waits for the reply to an earlier transfer that was given up or dropped, and discards all waiting
            /// replies. If the transfer was dropped, aborts it first.
            $($async)? fn $settle(&mut self, answers: u16) -> Result<(), Error<P::Error>> {
                let timeout = self.timeout();
                if let Some(owed) = self.owed {
                    if !owed.is_aborted {
                        self.$send(&owed.abort(self.id()))$(.$await)??;
                        self.owed = Some(Owed { is_aborted: true, ..owed });
                    }
                    let late = self.port().receive(timeout, &mut |frame| owed.reply.is(frame))$(.$await)?;
                    late.map_err(Error::Client)?;
                    self.owed = None;
                }
                let mut old = BACKLOG;
                while old > 0 {
                    let late = self.port().receive(Duration::ZERO, &mut |frame| frame.id() == answers)$(.$await)?;
                    old = if late.map_err(Error::Client)?.is_some() { old - 1 } else { 0 };
                }
                Ok(())
            }

            $($async)? fn $run(&mut self, mut transfer: Transfer) -> Result<Done, Error<P::Error>> {
                let timeout = self.timeout();
                self.$settle(transfer.expected.answers)$(.$await)??;
                transfer.start = self.port().now();
                loop {
                    while let Some(frame) = transfer.request() {
                        self.owed = transfer.owed(&frame);
                        let patience = transfer.patience(self.port().now(), timeout);
                        let is_sent = self.port().send(&frame, patience)$(.$await)?;
                        if let Err(error) = is_sent.map_err(Error::Client).and_then(sent) {
                            // A node that did not receive the first request of a transfer does not reply.
                            self.owed = self.owed.filter(|owed| owed.reply.is_segment());
                            return Err(error);
                        }
                    }
                    if let Some(end) = transfer.end() {
                        return end;
                    }
                    let (expected, patience) = (transfer.expected, transfer.patience(self.port().now(), timeout));
                    match self.port().receive(patience, &mut |frame| expected.is(frame))$(.$await)? {
                        Ok(answer) => {
                            self.owed = None;
                            transfer.answer(answer);
                        }
                        Err(error) => {
                            // Abort the transfer, so that the node doesn't wait for its remaining messages. The caller
                            // gets the first error, even if the abort message cannot be sent.
                            if let Some(abort) = transfer.broken() {
                                self.owed = transfer.owed(&abort);
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

transfers! { CanPort Client send settle run }
transfers! { AsyncCanPort AsyncClient send_async settle_async run_async async await }
