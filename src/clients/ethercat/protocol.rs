//! CoE messages, without the mailbox transfer (ETG.1000.6 5.6.1, 5.6.2).

use crate::abort::AbortCode;
use crate::bus::Object;
use crate::emergency::Emergency;

/// Length of the header of a mailbox message in bytes (ETG.1000.4 5.6).
const MAILBOX_HEADER: usize = 6;

/// Length of the CoE header in bytes.
const COE_HEADER: usize = 2;

/// Length of a request that starts a transfer, in bytes: CoE header, command, index, sub-index, and four bytes of data
/// or length.
const INITIATE: usize = 10;

/// Minimum length of a mailbox into which every first request of a transfer fits, in bytes.
pub(super) const SMALLEST: usize = MAILBOX_HEADER + INITIATE;

/// Minimum length of the data in a segment, in bytes.
const SEGMENT: usize = 7;

/// Protocol number of a mailbox error in the header of a mailbox message, and the service type in its data
/// (ETG.1000.4 5.6).
const ERROR: u8 = 0;
const ERROR_REPLY: [u8; 2] = [1, 0];

/// Protocol number of CoE in the header of a mailbox message.
const COE: u8 = 3;

/// Whether bytes of the value follow the head of a request.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Command {
    /// The head contains all data.
    Short,
    /// Bytes of the value follow the head.
    Normal,
}

/// A message to the device: a head, which may be followed by bytes of a value.
#[derive(Clone, Copy, Debug)]
pub(super) struct Request {
    head: [u8; SMALLEST],
    head_len: usize,
    command: Command,
}

impl Request {
    /// Creates a request. `rest` contains the bytes of the head after the CoE header. `length` is the number of bytes after the
    /// mailbox header.
    fn new(rest: &[u8], length: usize, command: Command) -> Self {
        // The address is 0, with the lowest priority. The counter stays 0, which disables the detection of repeated
        // messages, because the counter of `ethercrab` is unknown.
        let [low, high] = (length as u16).to_le_bytes();
        let fixed = [low, high, 0, 0, 0, COE, 0, Service::Request as u8 * 0x10];
        let mut head = [0; SMALLEST];
        head.iter_mut().zip(fixed.iter().chain(rest)).for_each(|(to, from)| *to = *from);
        Self { head, head_len: fixed.len() + rest.len(), command }
    }

    pub(super) fn head(&self) -> &[u8] {
        self.head.get(..self.head_len).unwrap_or(&self.head)
    }

    pub(super) const fn command(&self) -> Command {
        self.command
    }
}

/// CoE service numbers.
#[derive(Clone, Copy)]
enum Service {
    Emergency = 1,
    Request = 2,
    Response = 3,
}

fn initiate(command: u8, object: Object, complete: bool, data: [u8; 4]) -> [u8; 8] {
    let [low, high] = object.index.to_le_bytes();
    let [a, b, c, d] = data;
    [command | u8::from(complete) << 4, low, high, object.sub_index, a, b, c, d]
}

pub(super) fn upload(object: Object, complete: bool) -> Request {
    Request::new(&initiate(0x40, object, complete, [0; 4]), INITIATE, Command::Short)
}

pub(super) fn upload_segment(toggle: bool) -> Request {
    Request::new(&[0x60 | u8::from(toggle) << 4, 0, 0, 0, 0, 0, 0, 0], INITIATE, Command::Short)
}

/// Returns the first request of a download, and the number of bytes of `data` that the request transfers. `room` is the
/// maximum length of a message in bytes.
pub(super) fn download(object: Object, complete: bool, data: &[u8], room: usize) -> (Request, usize) {
    if (1..=4).contains(&data.len()) {
        let mut bytes = [0; 4];
        bytes.iter_mut().zip(data).for_each(|(to, from)| *to = *from);
        let command = 0x23 | (4 - data.len() as u8) << 2;
        return (Request::new(&initiate(command, object, complete, bytes), INITIATE, Command::Short), data.len());
    }
    let first = data.len().min(room.saturating_sub(SMALLEST));
    let size = (data.len() as u32).to_le_bytes();
    (Request::new(&initiate(0x21, object, complete, size), INITIATE + first, Command::Normal), first)
}

/// Returns the request for the next segment of a download, and the number of bytes that follow its head. `rest` is the
/// number of remaining bytes.
pub(super) fn download_segment(toggle: bool, rest: usize, room: usize) -> (Request, usize) {
    let most = room.saturating_sub(MAILBOX_HEADER + COE_HEADER + 1).max(SEGMENT);
    let length = rest.min(most);
    let unused = SEGMENT.saturating_sub(length) as u8;
    let command = u8::from(toggle) << 4 | unused << 1 | u8::from(length == rest);
    (Request::new(&[command], COE_HEADER + 1 + length.max(SEGMENT), Command::Normal), length)
}

/// A message from the device.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Answer<'d> {
    /// A value, or the first part of it. `size` is the length of the whole value, if the message contains it.
    Upload { object: Object, size: Option<usize>, data: &'d [u8] },
    /// The next part of a value.
    UploadSegment { toggle: bool, last: bool, data: &'d [u8] },
    /// Confirms a value or the first part of it.
    Download { object: Object },
    /// Confirms the next part of a value.
    DownloadSegment { toggle: bool },
    /// The device aborted the transfer.
    Abort { object: Object, code: AbortCode },
    /// An emergency message.
    Emergency(Emergency),
    /// The mailbox rejected the request, with an error code.
    MailboxError(u16),
    /// A message of another protocol or service.
    Foreign,
    /// An invalid message.
    Malformed,
}

impl<'d> Answer<'d> {
    /// Parses the contents of the mailbox.
    pub(super) fn parse(mailbox: &'d [u8]) -> Self {
        Self::read(mailbox).unwrap_or(Answer::Malformed)
    }

    fn read(mailbox: &'d [u8]) -> Option<Self> {
        let (header, rest) = mailbox.split_first_chunk::<MAILBOX_HEADER>()?;
        let body = rest.get(..usize::from(u16::from_le_bytes([header[0], header[1]])))?;
        match header[5] & 0x0F {
            ERROR => {
                let (reply, detail) = body.split_first_chunk::<2>()?;
                let code = u16::from_le_bytes(*detail.first_chunk()?);
                return (*reply == ERROR_REPLY).then_some(Answer::MailboxError(code));
            }
            COE => {}
            _ => return Some(Answer::Foreign),
        }
        let (coe, sdo) = body.split_first_chunk::<COE_HEADER>()?;
        match coe[1] >> 4 {
            service if service == Service::Emergency as u8 => emergency(sdo),
            // An abort can also be sent as a request.
            service if service == Service::Response as u8 || service == Service::Request as u8 => response(sdo),
            _ => Some(Answer::Foreign),
        }
    }
}

fn emergency(message: &[u8]) -> Option<Answer<'_>> {
    Emergency::from_bytes(message.first_chunk::<8>()?).map(Answer::Emergency)
}

fn response(sdo: &[u8]) -> Option<Answer<'_>> {
    let (&command, behind) = sdo.split_first()?;
    let toggle = command & 0x10 != 0;
    match command >> 5 {
        0 => {
            // A segment has at least seven bytes. If it has exactly seven, the command contains the number of unused
            // bytes.
            let unused = if behind.len() == SEGMENT { usize::from(command >> 1 & 7) } else { 0 };
            let data = behind.get(..behind.len() - unused)?;
            Some(Answer::UploadSegment { toggle, last: command & 1 != 0, data })
        }
        1 => Some(Answer::DownloadSegment { toggle }),
        2 => uploaded(command, behind),
        3 => Some(Answer::Download { object: address(behind)?.0 }),
        4 => {
            let (object, behind) = address(behind)?;
            Some(Answer::Abort { object, code: AbortCode(u32::from_le_bytes(*behind.first_chunk()?)) })
        }
        _ => None,
    }
}

fn uploaded(command: u8, behind: &[u8]) -> Option<Answer<'_>> {
    let (object, data) = address(behind)?;
    if command & 0x02 != 0 {
        let size = (command & 0x01 != 0).then_some(4 - usize::from(command >> 2 & 3));
        return Some(Answer::Upload { object, size, data: data.get(..size.unwrap_or(4))? });
    }
    let (size, data) = data.split_first_chunk()?;
    let size = usize::try_from(u32::from_le_bytes(*size)).ok()?;
    Some(Answer::Upload { object, size: Some(size), data: data.get(..size).unwrap_or(data) })
}

fn address(bytes: &[u8]) -> Option<(Object, &[u8])> {
    let (&[low, high, sub_index], rest) = bytes.split_first_chunk()?;
    Some((Object { index: u16::from_le_bytes([low, high]), sub_index }, rest))
}

#[cfg(test)]
mod tests;
