//! SDO messages: command specifiers and fields (CiA 301 7.2.4.3).

use crate::abort::AbortCode;
use crate::bus::Object;
use crate::pdo::{from_bytes, to_bytes};

/// Content of an SDO message. An SDO message always has eight bytes.
pub type Message = [u8; 8];

/// Length of the data in a segment in bytes.
pub(super) const SEGMENT: usize = 7;

/// Maximum number of segments in a sub-block of a block transfer.
pub(super) const MOST_SEGMENTS: u8 = 127;

/// Command specifiers of requests: bits 5 to 7 of the first byte.
pub(super) mod request {
    pub const DOWNLOAD_SEGMENT: u8 = 0;
    pub const DOWNLOAD: u8 = 1;
    pub const UPLOAD: u8 = 2;
    pub const UPLOAD_SEGMENT: u8 = 3;
    pub const BLOCK_UPLOAD: u8 = 5;
    pub const BLOCK_DOWNLOAD: u8 = 6;
}

/// Command specifiers of replies: bits 5 to 7 of the first byte.
pub(super) mod reply {
    pub const UPLOAD_SEGMENT: u8 = 0;
    pub const DOWNLOAD_SEGMENT: u8 = 1;
    pub const UPLOAD: u8 = 2;
    pub const DOWNLOAD: u8 = 3;
    pub const BLOCK_DOWNLOAD: u8 = 5;
    pub const BLOCK_UPLOAD: u8 = 6;
}

/// Subcommands of a block transfer: bits 0 and 1 of the first byte.
pub(super) mod block {
    pub const INITIATE: u8 = 0;
    pub const END: u8 = 1;
    pub const ACKNOWLEDGE: u8 = 2;
    pub const START: u8 = 3;
}

/// Command specifier of an abort, which the client or the server sends.
pub(super) const ABORT: u8 = 4;

/// Bit of an initiate message of a block transfer: the sender supports the CRC.
pub(super) const WITH_CRC: u8 = 1 << 2;
/// Bit of an initiate message of a block transfer: the message contains the length of the value.
pub(super) const WITH_SIZE: u8 = 1 << 1;
/// Bit of a segment in a block transfer: the segment is the last one of the value.
pub(super) const LAST_OF_BLOCK: u8 = 1 << 7;
/// First byte of an abort. No segment of a block transfer has this first byte.
pub(super) const ABORT_COMMAND: u8 = ABORT << 5;
/// Toggle bit of segments and their confirmations.
const TOGGLE: u8 = 1 << 4;

/// Returns the command specifier of a message.
pub(super) const fn specifier(message: &Message) -> u8 {
    message[0] >> 5
}

/// Returns the subcommand of a block transfer.
pub(super) const fn subcommand(message: &Message) -> u8 {
    message[0] & 3
}

/// Returns the object in a message. Segments don't contain an object.
pub(super) const fn object(message: &Message) -> Object {
    Object::new(u16::from_le_bytes([message[1], message[2]]), message[3])
}

/// Returns bytes 4 to 7 of a message as a number: a length or an abort code.
pub(super) const fn number(message: &Message) -> u32 {
    let [_, _, _, _, a, b, c, d] = *message;
    u32::from_le_bytes([a, b, c, d])
}

/// Returns the toggle bit of a segment or its confirmation.
pub(super) const fn toggle(message: &Message) -> bool {
    message[0] & TOGGLE != 0
}

/// Creates a message with an object and four bytes of data.
pub(super) const fn initiate(command: u8, object: Object, data: [u8; 4]) -> Message {
    let ([low, high], [a, b, c, d]) = (object.index.to_le_bytes(), data);
    [command, low, high, object.sub_index, a, b, c, d]
}

/// Creates the message that aborts a transfer (CiA 301 7.2.4.3.17).
pub(crate) const fn abort(object: Object, code: AbortCode) -> Message {
    initiate(ABORT_COMMAND, object, code.0.to_le_bytes())
}

/// Creates a message with a command specifier and a toggle bit, without data: a request for a segment, or the
/// confirmation of a segment.
pub(super) const fn toggled(specifier: u8, toggle: bool) -> Message {
    [specifier << 5 | if toggle { TOGGLE } else { 0 }, 0, 0, 0, 0, 0, 0, 0]
}

/// Creates a message of a block transfer with two bytes of data.
pub(super) const fn block(command: u8, first: u8, second: u8) -> Message {
    [command, first, second, 0, 0, 0, 0, 0]
}

/// Creates a message from its first byte and at most seven bytes of data.
pub(super) fn with_data(command: u8, data: &[u8]) -> Message {
    let [a, b, c, d, e, f, g] = to_bytes(from_bytes(data));
    [command, a, b, c, d, e, f, g]
}

/// Creates the initiate message of an expedited or segmented transfer: a download request or an upload reply. The
/// message contains the value if the value has 1 to 4 bytes.
pub(super) fn initiate_value(specifier: u8, object: Object, value: &[u8]) -> Message {
    if let 1..=4 = value.len() {
        let command = specifier << 5 | (4 - value.len() as u8) << 2 | 3;
        return initiate(command, object, to_bytes(from_bytes(value)));
    }
    initiate(specifier << 5 | 1, object, length_field(value.len()))
}

/// Encodes the length of a value. The length field has 32 bits.
pub(super) fn length_field(length: usize) -> [u8; 4] {
    u32::try_from(length).unwrap_or(u32::MAX).to_le_bytes()
}

/// Content of the initiate message of an expedited or segmented transfer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Initiated {
    /// The message contains the value: the first bytes of `data`. The length is unknown if the sender doesn't indicate
    /// it.
    Expedited { data: [u8; 4], length: Option<usize> },
    /// Segments follow. The length is unknown if the sender doesn't indicate it.
    Segmented { length: Option<usize> },
}

impl Initiated {
    /// Reads a download request or an upload reply.
    pub fn of(message: &Message) -> Self {
        let is_sized = message[0] & 1 == 1;
        if message[0] & 2 == 2 {
            let length = is_sized.then_some(4 - usize::from(message[0] >> 2 & 3));
            return Self::Expedited { data: number(message).to_le_bytes(), length };
        }
        Self::Segmented { length: is_sized.then_some(number(message) as usize) }
    }
}

/// Creates a segment of a segmented transfer. `rest` is the part of the value that isn't sent yet. Also returns the
/// number of data bytes in the segment.
pub(super) fn segment(specifier: u8, toggle: bool, rest: &[u8]) -> (Message, usize) {
    let length = rest.len().min(SEGMENT);
    let is_last = rest.len() <= SEGMENT;
    let [command, ..] = toggled(specifier, toggle);
    let command = command | ((SEGMENT - length) as u8) << 1 | u8::from(is_last);
    (with_data(command, rest.get(..length).unwrap_or(rest)), length)
}

/// Returns the data of a segment of a segmented transfer, and whether the segment is the last one.
pub(super) fn segment_data(message: &Message) -> (&[u8], bool) {
    let [command, data @ ..] = message;
    let length = SEGMENT - usize::from(command >> 1 & 7);
    (data.get(..length).unwrap_or_default(), command & 1 == 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn segments() {
        let (message, length) = segment(0, true, &[1, 2, 3]);
        assert_eq!((message, length), ([0x19, 1, 2, 3, 0, 0, 0, 0], 3));
        assert_eq!(segment_data(&message), ([1, 2, 3].as_slice(), true));
        assert_eq!(segment(0, false, &[1; 8]), ([0, 1, 1, 1, 1, 1, 1, 1], 7));
        assert_eq!(segment(0, false, &[]), ([0x0F, 0, 0, 0, 0, 0, 0, 0], 0));
        assert_eq!(segment_data(&[0x0F, 1, 1, 1, 1, 1, 1, 1]), ([].as_slice(), true));
    }

    #[test]
    fn initiate_messages() {
        let object = Object::new(0x2001, 3);
        let short = initiate_value(reply::UPLOAD, object, &[7, 8]);
        assert_eq!(short, [0x4B, 1, 0x20, 3, 7, 8, 0, 0]);
        assert_eq!(Initiated::of(&short), Initiated::Expedited { data: [7, 8, 0, 0], length: Some(2) });
        let long = initiate_value(request::DOWNLOAD, object, &[0; 300]);
        assert_eq!(long, [0x21, 1, 0x20, 3, 0x2C, 1, 0, 0]);
        assert_eq!(Initiated::of(&long), Initiated::Segmented { length: Some(300) });
        let unsized_value = [0x42, 1, 0x20, 3, 1, 2, 3, 4];
        assert_eq!(Initiated::of(&unsized_value), Initiated::Expedited { data: [1, 2, 3, 4], length: None });
        assert_eq!(Initiated::of(&[0x40, 1, 0x20, 3, 1, 2, 3, 4]), Initiated::Segmented { length: None });
        assert_eq!(abort(object, AbortCode::CRC), [0x80, 1, 0x20, 3, 4, 0, 4, 5]);
    }
}
