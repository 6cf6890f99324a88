//! Server side of SDO transfers.

use core::time::Duration;

use super::block::{block_size, end, Received, Receiver, Sender};
use super::message::{
    abort, block, block as subcommand, initiate, initiate_value, length_field, number, object, reply, request, segment,
    segment_data, specifier, subcommand as command, toggle, toggled, Initiated, Message, ABORT, ABORT_COMMAND,
    MOST_SEGMENTS, WITH_CRC, WITH_SIZE,
};
use crate::abort::AbortCode;
use crate::bus::Object;

/// Objects that a [`Server`] reads and writes.
pub trait Objects {
    /// Reads an object to the start of `buffer` and returns its length in bytes.
    ///
    /// # Errors
    ///
    /// Returns the code with which the server aborts the transfer. The code is [`AbortCode::OUT_OF_MEMORY`] if the
    /// value is longer than `buffer`.
    fn read(&mut self, object: Object, buffer: &mut [u8]) -> Result<usize, AbortCode>;

    /// Writes an object.
    ///
    /// # Errors
    ///
    /// Returns the code with which the server aborts the transfer.
    fn write(&mut self, object: Object, data: &[u8]) -> Result<(), AbortCode>;

    /// Returns the length of an object in bytes if its type has a fixed length of at most 4 bytes. The server uses this
    /// length for an expedited download that doesn't indicate its length. If this method returns `None`, the value of
    /// such a download has 4 bytes.
    fn length(&mut self, object: Object) -> Option<usize> {
        let _ = object;
        None
    }
}

/// SDO server of one channel (CiA 301 7.2.4.3), as a state machine that performs no I/O. Values have at most `N` bytes.
///
/// Pass each request to [`handle`](Self::handle), then send all messages that [`next`](Self::next) returns. Call
/// [`time_out`](Self::time_out) at the [`deadline`](Self::deadline).
///
/// A request that starts a transfer ends an unfinished transfer.
#[derive(Clone, Debug)]
pub struct Server<const N: usize> {
    timeout: Duration,
    has_blocks: bool,
    /// Object of the current transfer.
    object: Object,
    buffer: [u8; N],
    /// Length of the value in the buffer, as far as it is known.
    length: usize,
    state: State,
    reply: Option<Message>,
    deadline: Option<Duration>,
}

/// The request that the server expects next, with the data to process the request.
#[derive(Clone, Copy, Debug)]
enum State {
    Idle,
    Upload { toggle: bool, sent: usize },
    Download { toggle: bool, size: Option<usize> },
    BlockUpload { sender: Sender, has_crc: bool, is_started: bool },
    BlockUploadEnd,
    BlockDownload { receiver: Receiver, size: Option<usize>, has_crc: bool },
    BlockDownloadEnd { receiver: Receiver, size: Option<usize>, has_crc: bool },
}

/// Result of a request: a message to send if there is one, or the code with which the transfer is aborted.
type Reply = Result<Option<Message>, AbortCode>;

impl<const N: usize> Default for Server<N> {
    fn default() -> Self {
        Self::new()
    }
}

impl<const N: usize> Server<N> {
    /// Creates a server that waits up to one second for each message of a transfer.
    #[must_use]
    pub const fn new() -> Self {
        Self {
            timeout: Duration::from_secs(1),
            has_blocks: true,
            object: Object::new(0, 0),
            buffer: [0; N],
            length: 0,
            state: State::Idle,
            reply: None,
            deadline: None,
        }
    }

    /// Returns the server with another timeout for each message of a transfer.
    #[must_use]
    pub fn with_timeout(self, timeout: Duration) -> Self {
        Self { timeout, ..self }
    }

    /// Allows or refuses block transfers. A server that refuses block transfers aborts them with
    /// [`AbortCode::COMMAND`].
    pub fn allow_blocks(&mut self, has_blocks: bool) {
        self.has_blocks = has_blocks;
    }

    /// Ends an unfinished transfer without a message.
    pub fn reset(&mut self) {
        self.state = State::Idle;
        self.reply = None;
        self.deadline = None;
    }

    /// Returns the next message to send, or `None` if there is no further message.
    #[allow(clippy::should_implement_trait)]
    pub fn next(&mut self) -> Option<Message> {
        if let Some(reply) = self.reply.take() {
            return Some(reply);
        }
        match &mut self.state {
            State::BlockUpload { sender, is_started: true, .. } => sender.segment(self.buffer.get(..self.length)?),
            _ => None,
        }
    }

    /// Returns the time at which an unfinished transfer times out, or `None` if no transfer is unfinished.
    #[must_use]
    pub const fn deadline(&self) -> Option<Duration> {
        self.deadline
    }

    /// Aborts an unfinished transfer if its [deadline](Self::deadline) has passed. `now` is the time since an arbitrary
    /// fixed moment.
    pub fn time_out(&mut self, now: Duration) {
        if self.deadline.is_some_and(|deadline| deadline <= now) {
            self.abort(self.object, AbortCode::TIMEOUT);
        }
    }

    /// Processes a request. `now` is the time since an arbitrary fixed moment.
    pub fn handle(&mut self, request: &Message, now: Duration, objects: &mut impl Objects) {
        let reply = match self.state {
            // Segments of a block have no command specifier.
            State::BlockDownload { receiver, size, has_crc } if request[0] != ABORT_COMMAND => {
                self.block_segment(request, receiver, size, has_crc)
            }
            State::BlockDownloadEnd { receiver, .. } if receiver.is_repeated(request) => Ok(None),
            _ => self.command(request, objects),
        };
        match reply {
            Ok(reply) => {
                self.reply = reply;
                self.deadline = match self.state {
                    State::Idle => None,
                    _ => Some(now.saturating_add(self.timeout)),
                };
            }
            Err(code) => self.abort(self.object, code),
        }
    }

    fn abort(&mut self, object: Object, code: AbortCode) {
        self.reset();
        self.reply = Some(abort(object, code));
    }

    fn command(&mut self, request: &Message, objects: &mut impl Objects) -> Reply {
        match specifier(request) {
            ABORT => {
                self.state = State::Idle;
                Ok(None)
            }
            request::UPLOAD => self.upload(object(request), objects),
            request::UPLOAD_SEGMENT => self.upload_segment(request),
            request::DOWNLOAD => self.download(request, objects),
            request::DOWNLOAD_SEGMENT => self.download_segment(request, objects),
            request::BLOCK_UPLOAD if self.has_blocks => self.block_upload(request, objects),
            request::BLOCK_DOWNLOAD if self.has_blocks => self.block_download(request, objects),
            _ => {
                self.object = object(request);
                Err(AbortCode::COMMAND)
            }
        }
    }

    /// Refuses a message that the server doesn't expect in its current state.
    fn unexpected(&mut self) -> Reply {
        if let State::Idle = self.state {
            self.object = Object::new(0, 0);
        }
        Err(AbortCode::COMMAND)
    }

    /// Starts a transfer, which ends an unfinished one.
    fn begin(&mut self, object: Object) {
        (self.object, self.length, self.state) = (object, 0, State::Idle);
    }

    /// Reads an object to the buffer.
    fn read(&mut self, object: Object, objects: &mut impl Objects) -> Result<(), AbortCode> {
        self.begin(object);
        self.length = objects.read(object, &mut self.buffer)?;
        if self.length > N {
            return Err(AbortCode::OUT_OF_MEMORY);
        }
        Ok(())
    }

    fn value(&self) -> &[u8] {
        self.buffer.get(..self.length).unwrap_or_default()
    }

    fn upload(&mut self, object: Object, objects: &mut impl Objects) -> Reply {
        self.read(object, objects)?;
        Ok(Some(self.upload_reply()))
    }

    /// Starts an expedited or segmented upload of the value in the buffer.
    fn upload_reply(&mut self) -> Message {
        if !(1..=4).contains(&self.length) {
            self.state = State::Upload { toggle: false, sent: 0 };
        }
        initiate_value(reply::UPLOAD, self.object, self.value())
    }

    fn upload_segment(&mut self, request: &Message) -> Reply {
        let State::Upload { toggle: expected, sent } = self.state else { return self.unexpected() };
        if toggle(request) != expected {
            return Err(AbortCode::TOGGLE_BIT);
        }
        let rest = self.value().get(sent..).unwrap_or_default();
        let (message, length) = segment(reply::UPLOAD_SEGMENT, expected, rest);
        let (_, is_last) = segment_data(&message);
        let next = State::Upload { toggle: !expected, sent: sent + length };
        self.state = if is_last { State::Idle } else { next };
        Ok(Some(message))
    }

    fn download(&mut self, request: &Message, objects: &mut impl Objects) -> Reply {
        self.begin(object(request));
        match Initiated::of(request) {
            Initiated::Expedited { data, length } => {
                let length = length.or_else(|| objects.length(self.object)).unwrap_or(data.len());
                objects.write(self.object, data.get(..length).unwrap_or(&data))?;
            }
            Initiated::Segmented { length: size } => {
                self.check_room(size)?;
                self.state = State::Download { toggle: false, size };
            }
        }
        Ok(Some(initiate(reply::DOWNLOAD << 5, self.object, [0; 4])))
    }

    fn check_room(&self, size: Option<usize>) -> Result<(), AbortCode> {
        if size.is_some_and(|size| size > N) {
            return Err(AbortCode::OUT_OF_MEMORY);
        }
        Ok(())
    }

    fn download_segment(&mut self, request: &Message, objects: &mut impl Objects) -> Reply {
        let State::Download { toggle: expected, size } = self.state else { return self.unexpected() };
        if toggle(request) != expected {
            return Err(AbortCode::TOGGLE_BIT);
        }
        let (data, is_last) = segment_data(request);
        let all = self.length + data.len();
        self.buffer.get_mut(self.length..all).ok_or(AbortCode::OUT_OF_MEMORY)?.copy_from_slice(data);
        self.length = all;
        if is_last {
            if size.is_some_and(|size| size != all) {
                return Err(AbortCode::LENGTH);
            }
            objects.write(self.object, self.value())?;
            self.state = State::Idle;
        } else {
            self.state = State::Download { toggle: !expected, size };
        }
        Ok(Some(toggled(reply::DOWNLOAD_SEGMENT, expected)))
    }
}

/// Block transfers (CiA 301 7.2.4.3.9 to 7.2.4.3.15). The server announces CRC support only to a client that supports
/// the CRC, because some clients always check the CRC after this announcement.
impl<const N: usize> Server<N> {
    fn block_upload(&mut self, request: &Message, objects: &mut impl Objects) -> Reply {
        match (command(request), self.state) {
            (subcommand::INITIATE, _) => self.block_upload_initiate(request, objects),
            (subcommand::START, State::BlockUpload { sender, has_crc, .. }) => {
                self.state = State::BlockUpload { sender, has_crc, is_started: true };
                Ok(None)
            }
            (subcommand::ACKNOWLEDGE, State::BlockUpload { mut sender, has_crc, is_started: true }) => {
                let [_, sequence, size, ..] = *request;
                if sender.acknowledge(self.value(), sequence, size)? {
                    self.state = State::BlockUploadEnd;
                    return Ok(Some(end(reply::BLOCK_UPLOAD << 5 | subcommand::END, self.value(), has_crc)));
                }
                self.state = State::BlockUpload { sender, has_crc, is_started: true };
                Ok(None)
            }
            // The acknowledgment has arrived twice.
            (subcommand::ACKNOWLEDGE, State::BlockUploadEnd) => Ok(None),
            (subcommand::END, State::BlockUploadEnd | State::Idle) => {
                self.state = State::Idle;
                Ok(None)
            }
            _ => self.unexpected(),
        }
    }

    fn block_upload_initiate(&mut self, request: &Message, objects: &mut impl Objects) -> Reply {
        let [command, _, _, _, size, threshold, ..] = *request;
        self.read(object(request), objects)?;
        if threshold > 0 && self.length <= usize::from(threshold) {
            return Ok(Some(self.upload_reply()));
        }
        let (sender, has_crc) = (Sender::new(block_size(size)?), command & WITH_CRC != 0);
        self.state = State::BlockUpload { sender, has_crc, is_started: false };
        let command = reply::BLOCK_UPLOAD << 5 | command & WITH_CRC | WITH_SIZE | subcommand::INITIATE;
        Ok(Some(initiate(command, self.object, length_field(self.length))))
    }

    fn block_download(&mut self, request: &Message, objects: &mut impl Objects) -> Reply {
        if request[0] & 1 == subcommand::INITIATE {
            self.begin(object(request));
            let size = (request[0] & WITH_SIZE != 0).then_some(number(request) as usize);
            self.check_room(size)?;
            let has_crc = request[0] & WITH_CRC != 0;
            self.state = State::BlockDownload { receiver: Receiver::new(MOST_SEGMENTS, *request), size, has_crc };
            let command = reply::BLOCK_DOWNLOAD << 5 | request[0] & WITH_CRC | subcommand::INITIATE;
            return Ok(Some(initiate(command, self.object, [MOST_SEGMENTS, 0, 0, 0])));
        }
        let State::BlockDownloadEnd { receiver, size, has_crc } = self.state else { return self.unexpected() };
        self.length = receiver.end(request, size, has_crc, &mut self.buffer)?;
        objects.write(self.object, self.value())?;
        self.state = State::Idle;
        Ok(Some(block(reply::BLOCK_DOWNLOAD << 5 | subcommand::END, 0, 0)))
    }

    fn block_segment(
        &mut self,
        request: &Message,
        mut receiver: Receiver,
        size: Option<usize>,
        has_crc: bool,
    ) -> Reply {
        let received = receiver.segment(request, &mut self.buffer)?;
        self.state = State::BlockDownload { receiver, size, has_crc };
        let sequence = match received {
            Received::More => return Ok(None),
            Received::SubBlock(sequence) => sequence,
            Received::Value(sequence) => {
                self.state = State::BlockDownloadEnd { receiver, size, has_crc };
                sequence
            }
        };
        Ok(Some(block(reply::BLOCK_DOWNLOAD << 5 | subcommand::ACKNOWLEDGE, sequence, receiver.size())))
    }
}
