//! Client side of an SDO transfer.

mod blocks;
mod segmented;

use core::error;
use core::fmt;
use core::time::Duration;

use super::block::{Receiver, Sender};
use super::message::{
    abort, block as subcommand, initiate, initiate_value, length_field, number, reply, request, specifier, Message,
    MOST_SEGMENTS, SEGMENT, WITH_CRC, WITH_SIZE,
};
use super::reply::{Expected, Kind};
use crate::abort::AbortCode;
use crate::bus::Object;
use crate::error::Error;
use crate::value_error::LengthError;

/// Default minimum length of a block transfer, in bytes.
pub const BLOCK_THRESHOLD: usize = 1024;

/// Protocol switch threshold in bytes: the server may switch from a block upload to a segmented or expedited upload for
/// values up to this length. A block upload of this length needs as many messages as a segmented one.
const SWITCH_THRESHOLD: u8 = 28;

/// Each segment extends the maximum duration of a transfer by the timeout divided by this number.
const SEGMENTS_PER_TIMEOUT: u32 = 10;

/// Reason why a transfer failed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum TransferError {
    /// The server aborted the transfer.
    Refused(AbortCode),
    /// A reply had a wrong toggle bit, sequence number, sub-block size, length or CRC. The client aborted the transfer.
    UnexpectedReply,
    /// The uploaded value is longer than the buffer.
    TooLong(LengthError),
    /// The server didn't reply in time.
    Timeout,
}

impl fmt::Display for TransferError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        // The texts are those of the client.
        Error::<AbortCode>::from(*self).fmt(f)
    }
}

impl error::Error for TransferError {}

impl<E> From<TransferError> for Error<E> {
    fn from(error: TransferError) -> Self {
        match error {
            TransferError::Refused(code) => Self::Abort(code),
            TransferError::UnexpectedReply => Self::UnexpectedReply,
            TransferError::TooLong(error) => Self::Length(error),
            TransferError::Timeout => Self::Timeout,
        }
    }
}

/// Client side of an SDO transfer (CiA 301 7.2.4.3), as a state machine that performs no I/O.
///
/// Repeat these steps until [`result`](Self::result) returns the result:
///
/// 1. Send all messages that [`next`](Self::next) returns.
/// 2. Pass the next message of the server to [`handle`](Self::handle). Call [`time_out`](Self::time_out) instead if no
///    message arrives that the transfer [accepts](Self::accepts).
///
/// Values with at least the minimum length of a block transfer are transferred in blocks with CRC (CiA 301 7.2.4.3.9 to
/// 7.2.4.3.16). For an upload, the length of the buffer decides, because the length of the value is unknown before the
/// transfer. If the server doesn't support block transfers (abort code 0x05040001) or the CRC, the transfer continues
/// as a segmented one.
#[derive(Debug)]
pub struct Transfer<'a> {
    object: Object,
    value: Value<'a>,
    phase: Phase,
    /// Messages to send: an abort, a request, or first an abort and then a request.
    queue: [Option<Message>; 2],
    /// Length of the value in bytes, as far as it is known. An upload without an announced length has the length of the
    /// received segments.
    length: usize,
    is_block_refused: bool,
    is_owed: bool,
    result: Option<Result<usize, TransferError>>,
}

/// The caller's buffer.
#[derive(Debug)]
enum Value<'a> {
    Upload(&'a mut [u8]),
    Download(&'a [u8]),
}

/// The reply that the client expects next, with the data to process the reply.
#[derive(Clone, Copy, Debug)]
enum Phase {
    Upload,
    UploadSegment { toggle: bool, length: usize, size: Option<usize> },
    Download,
    DownloadSegment { toggle: bool, sent: usize },
    BlockUpload,
    BlockUploadSegment { receiver: Receiver, size: Option<usize> },
    BlockUploadEnd { receiver: Receiver, size: Option<usize> },
    BlockDownload,
    BlockDownloadSegment { sender: Sender },
    BlockDownloadEnd,
}

impl Phase {
    const fn kind(self) -> Kind {
        match self {
            Self::Upload => Kind::Upload,
            Self::UploadSegment { .. } => Kind::UploadSegment,
            Self::Download => Kind::Download,
            Self::DownloadSegment { .. } => Kind::DownloadSegment,
            Self::BlockUpload => Kind::BlockUpload,
            Self::BlockUploadSegment { .. } => Kind::BlockUploadSegment,
            Self::BlockUploadEnd { .. } => Kind::BlockUploadEnd,
            Self::BlockDownload => Kind::BlockDownload,
            Self::BlockDownloadSegment { .. } => Kind::BlockDownloadAcknowledge,
            Self::BlockDownloadEnd => Kind::BlockDownloadEnd,
        }
    }
}

impl<'a> Transfer<'a> {
    fn new(object: Object, value: Value<'a>, length: usize, phase: Phase, request: Message) -> Self {
        let queue = [Some(request), None];
        Self { object, value, phase, queue, length, is_block_refused: false, is_owed: false, result: None }
    }

    /// Creates a transfer that reads an object to the start of `buffer`. The transfer is a block transfer if `buffer` has
    /// at least `threshold` bytes, and more than 4.
    pub fn upload(object: Object, buffer: &'a mut [u8], threshold: usize) -> Self {
        let is_block = is_block(buffer.len(), threshold);
        let (phase, request) = if is_block {
            let command = request::BLOCK_UPLOAD << 5 | WITH_CRC | subcommand::INITIATE;
            (Phase::BlockUpload, initiate(command, object, [MOST_SEGMENTS, SWITCH_THRESHOLD, 0, 0]))
        } else {
            (Phase::Upload, upload_request(object))
        };
        Self::new(object, Value::Upload(buffer), 0, phase, request)
    }

    /// Creates a transfer that writes `data` to an object. The transfer is a block transfer if `data` has at least
    /// `threshold` bytes, and more than 4.
    ///
    /// # Errors
    ///
    /// Returns an error if `data` is empty, because an SDO download has at least one byte.
    pub fn download(object: Object, data: &'a [u8], threshold: usize) -> Result<Self, LengthError> {
        if data.is_empty() {
            return Err(LengthError::new(1, 0));
        }
        let (phase, request) = if is_block(data.len(), threshold) {
            let command = request::BLOCK_DOWNLOAD << 5 | WITH_CRC | WITH_SIZE | subcommand::INITIATE;
            (Phase::BlockDownload, initiate(command, object, length_field(data.len())))
        } else {
            (Phase::Download, initiate_value(request::DOWNLOAD, object, data))
        };
        Ok(Self::new(object, Value::Download(data), data.len(), phase, request))
    }

    /// Returns the next message to send. Returns `None` if the transfer waits for a reply or has ended.
    #[allow(clippy::should_implement_trait)]
    pub fn next(&mut self) -> Option<Message> {
        if let Some(message) = self.queue.iter_mut().find_map(Option::take) {
            return Some(message);
        }
        match (&mut self.phase, &self.value) {
            (Phase::BlockDownloadSegment { sender }, Value::Download(data)) if self.result.is_none() => {
                sender.segment(data)
            }
            _ => None,
        }
    }

    /// Returns whether a message of the server belongs to the transfer. Other messages must not restart the timeout.
    #[must_use]
    pub fn accepts(&self, message: &Message) -> bool {
        self.result.is_none() && self.expected().accepts(message)
    }

    /// Returns the maximum duration of the whole transfer if the timeout for a reply is `timeout`. The duration is one
    /// timeout, plus one tenth of the timeout for each segment of 7 bytes. Call [`time_out`](Self::time_out) if the
    /// transfer takes longer. The maximum duration of an upload of unknown length increases with each received segment.
    #[must_use]
    pub fn limit(&self, timeout: Duration) -> Duration {
        let segments = u32::try_from(self.length.div_ceil(SEGMENT)).unwrap_or(u32::MAX);
        timeout.saturating_add((timeout / SEGMENTS_PER_TIMEOUT).saturating_mul(segments))
    }

    /// Returns the result if the transfer has ended: the length of the value, or the reason for the failure. The length
    /// can be greater than the length of the buffer if the value has at most 4 bytes. Before you use the result, send
    /// all messages that [`next`](Self::next) returns.
    #[must_use]
    pub const fn result(&self) -> Option<Result<usize, TransferError>> {
        self.result
    }

    /// Returns whether the transfer continued as a segmented one because the server doesn't support block transfers
    /// with CRC.
    #[must_use]
    pub const fn is_block_refused(&self) -> bool {
        self.is_block_refused
    }

    /// Returns the expected reply.
    pub(crate) const fn expected(&self) -> Expected {
        Expected { object: self.object, kind: self.phase.kind() }
    }

    /// Returns whether the server may still reply after the end of the transfer.
    pub(crate) const fn is_owed(&self) -> bool {
        self.is_owed
    }

    /// Ends the transfer because a reply is missing. [`next`](Self::next) returns the abort message.
    pub fn time_out(&mut self) {
        if self.result.is_none() {
            self.is_owed = true;
            self.give_up(AbortCode::TIMEOUT, TransferError::Timeout);
        }
    }

    /// Ends the transfer because the interface has failed. [`next`](Self::next) returns the abort message.
    pub(crate) fn fail(&mut self) {
        self.is_owed = true;
        self.give_up(AbortCode::GENERAL, TransferError::UnexpectedReply);
    }

    /// Processes a message of the server. Ignores messages that the transfer doesn't [accept](Self::accepts).
    pub fn handle(&mut self, message: &Message) {
        if !self.accepts(message) {
            return;
        }
        if self.expected().is_abort(message) {
            return self.refused(AbortCode(number(message)));
        }
        match self.phase {
            Phase::Upload => self.upload_initiated(message),
            Phase::UploadSegment { toggle, length, size } => self.upload_segment(message, toggle, length, size),
            Phase::Download if self.data().len() <= 4 => self.result = Some(Ok(self.data().len())),
            Phase::Download => self.download_segment(false, 0),
            Phase::DownloadSegment { toggle, sent } => self.download_confirmed(message, toggle, sent),
            Phase::BlockUpload if specifier(message) == reply::UPLOAD => self.upload_initiated(message),
            Phase::BlockUpload => self.block_upload_initiated(message),
            Phase::BlockUploadSegment { receiver, size } => self.block_upload_segment(message, receiver, size),
            Phase::BlockUploadEnd { receiver, size } => self.block_upload_ended(message, receiver, size),
            Phase::BlockDownload => self.block_download_initiated(message),
            Phase::BlockDownloadSegment { sender } => self.block_download_acknowledged(message, sender),
            Phase::BlockDownloadEnd => self.result = Some(Ok(self.data().len())),
        }
    }

    /// Returns the value of a download.
    fn data(&self) -> &[u8] {
        match &self.value {
            Value::Upload(_) => &[],
            Value::Download(data) => data,
        }
    }

    /// Returns the buffer of an upload.
    fn buffer(&mut self) -> &mut [u8] {
        match &mut self.value {
            Value::Upload(buffer) => buffer,
            Value::Download(_) => &mut [],
        }
    }

    fn send(&mut self, message: Message) {
        self.queue = [Some(message), None];
    }

    /// Aborts the transfer.
    fn give_up(&mut self, code: AbortCode, error: TransferError) {
        self.send(abort(self.object, code));
        self.result = Some(Err(error));
    }

    /// Aborts a transfer because of a wrong reply.
    fn give_up_unexpected(&mut self, code: AbortCode) {
        self.give_up(code, TransferError::UnexpectedReply);
    }

    /// Aborts an upload whose value is longer than the buffer.
    fn give_up_too_long(&mut self, length: usize) {
        let room = self.buffer().len();
        self.give_up(AbortCode::OUT_OF_MEMORY, TransferError::TooLong(LengthError::new(room, length)));
    }

    /// Ends the transfer after an abort by the server, or continues without blocks.
    fn refused(&mut self, code: AbortCode) {
        match self.phase {
            Phase::BlockUpload | Phase::BlockDownload if code == AbortCode::COMMAND => {
                let request = self.fall_back();
                self.send(request);
            }
            _ => self.result = Some(Err(TransferError::Refused(code))),
        }
    }

    /// Changes from a block transfer to a segmented one. Returns the first request.
    fn fall_back(&mut self) -> Message {
        self.is_block_refused = true;
        match self.value {
            Value::Upload(_) => {
                self.phase = Phase::Upload;
                upload_request(self.object)
            }
            Value::Download(data) => {
                self.phase = Phase::Download;
                initiate_value(request::DOWNLOAD, self.object, data)
            }
        }
    }

    /// Aborts a block transfer without CRC, which wouldn't detect repeated frames, and continues without blocks.
    fn fall_back_without_crc(&mut self) {
        let request = self.fall_back();
        self.queue = [Some(abort(self.object, AbortCode::GENERAL)), Some(request)];
    }
}

fn is_block(length: usize, threshold: usize) -> bool {
    length > 4 && length >= threshold
}

const fn upload_request(object: Object) -> Message {
    initiate(request::UPLOAD << 5, object, [0; 4])
}
