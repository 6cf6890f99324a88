//! Sub-blocks of a block transfer (CiA 301 7.2.4.3.10 and 7.2.4.3.14). The client sends sub-blocks in a download, and
//! the server in an upload.

use super::crc::crc;
use super::message::{with_data, Message, LAST_OF_BLOCK, MOST_SEGMENTS, SEGMENT};
use crate::abort::AbortCode;

/// Maximum number of repetitions of a sub-block of which no segment arrived.
const MOST_REPETITIONS: u8 = 3;

/// Checks a received number of segments per sub-block, which must be 1 to 127.
pub(super) fn block_size(size: u8) -> Result<u8, AbortCode> {
    match size {
        1..=MOST_SEGMENTS => Ok(size),
        _ => Err(AbortCode::BLOCK_SIZE),
    }
}

/// Sender of a value in sub-blocks.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sender {
    /// Number of acknowledged segments.
    acknowledged: usize,
    /// Number of sent segments of the current sub-block.
    sent: u8,
    /// Maximum number of segments in the current sub-block.
    size: u8,
    /// Number of consecutive acknowledgments that confirmed no segment.
    repetitions: u8,
}

impl Sender {
    pub const fn new(size: u8) -> Self {
        Self { acknowledged: 0, sent: 0, size, repetitions: 0 }
    }

    /// Returns the number of segments of a value. An empty value has one segment.
    fn count(value: &[u8]) -> usize {
        value.len().div_ceil(SEGMENT).max(1)
    }

    /// Returns the next segment of the current sub-block, or `None` if the sub-block is complete.
    pub fn segment(&mut self, value: &[u8]) -> Option<Message> {
        let at = self.acknowledged + usize::from(self.sent);
        if self.sent == self.size || at >= Self::count(value) {
            return None;
        }
        self.sent += 1;
        let is_last = at + 1 == Self::count(value);
        let command = self.sent | if is_last { LAST_OF_BLOCK } else { 0 };
        Some(with_data(command, value.get(at * SEGMENT..).unwrap_or_default()))
    }

    /// Processes an acknowledgment: the number of the last segment that arrived in sequence, and the size of the next
    /// sub-block. Segments after the last segment in sequence are sent again. Returns whether the whole value has
    /// arrived.
    pub fn acknowledge(&mut self, value: &[u8], sequence: u8, size: u8) -> Result<bool, AbortCode> {
        if sequence > self.sent {
            return Err(AbortCode::SEQUENCE_NUMBER);
        }
        self.acknowledged += usize::from(sequence);
        if self.acknowledged == Self::count(value) {
            return Ok(true);
        }
        self.repetitions = if sequence == 0 { self.repetitions + 1 } else { 0 };
        if self.repetitions > MOST_REPETITIONS {
            return Err(AbortCode::SEQUENCE_NUMBER);
        }
        (self.sent, self.size) = (0, block_size(size)?);
        Ok(false)
    }
}

/// Returns the number of unused bytes in the last segment of a value.
pub(super) fn unused(value: &[u8]) -> u8 {
    (Sender::count(value) * SEGMENT - value.len()) as u8
}

/// Returns the message that ends a block transfer: unused bytes in the last segment, and CRC. The CRC is 0 if the other
/// side doesn't support it.
pub(super) fn end(command: u8, value: &[u8], has_crc: bool) -> Message {
    let [low, high] = if has_crc { crc(value) } else { 0 }.to_le_bytes();
    [command | unused(value) << 2, low, high, 0, 0, 0, 0, 0]
}

/// Receiver of a value in sub-blocks.
#[derive(Clone, Copy, Debug)]
pub(super) struct Receiver {
    /// Number of bytes in the buffer. The last segment isn't counted, because its length isn't known yet.
    length: usize,
    /// Number of the last segment that arrived in sequence.
    sequence: u8,
    /// Number of segments in a sub-block.
    size: u8,
    /// The previous message. The receiver ignores its repetition, because CAN controllers may receive a frame twice.
    previous: Message,
}

/// Reaction to a segment.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Received {
    /// The sub-block is not complete.
    More,
    /// The sub-block has ended. The number of the last segment that arrived in sequence must be acknowledged.
    SubBlock(u8),
    /// The value is complete. The number of the last segment must be acknowledged.
    Value(u8),
}

impl Receiver {
    /// Creates a receiver of sub-blocks with `size` segments: 2 to 127. The receiver couldn't distinguish a repeated
    /// frame from the next sub-block if a sub-block had only one segment. `previous` is the message that started the
    /// transfer, which may also arrive twice.
    pub const fn new(size: u8, previous: Message) -> Self {
        Self { length: 0, sequence: 0, size, previous }
    }

    /// Returns the number of segments in a sub-block.
    pub const fn size(&self) -> u8 {
        self.size
    }

    /// Returns the number of received bytes, except those of the last segment.
    pub const fn length(&self) -> usize {
        self.length
    }

    /// Returns whether a message is the repetition of the previous message.
    pub fn is_repeated(&self, message: &Message) -> bool {
        self.previous == *message
    }

    /// Stores a segment in `buffer`. A segment that is out of sequence isn't stored, but it can end the sub-block.
    ///
    /// Returns [`AbortCode::SEQUENCE_NUMBER`] if the number of the segment is invalid, or
    /// [`AbortCode::OUT_OF_MEMORY`] if the value is longer than `buffer`.
    pub fn segment(&mut self, message: &Message, buffer: &mut [u8]) -> Result<Received, AbortCode> {
        if self.is_repeated(message) {
            return Ok(Received::More);
        }
        let [command, data @ ..] = message;
        let (sequence, is_last) = (command & !LAST_OF_BLOCK, command & LAST_OF_BLOCK != 0);
        if sequence == 0 || sequence > self.size {
            return Err(AbortCode::SEQUENCE_NUMBER);
        }
        self.previous = *message;
        if sequence <= self.sequence {
            return Ok(Received::More);
        }
        if sequence == self.sequence + 1 {
            self.sequence = sequence;
            if is_last {
                return Ok(Received::Value(sequence));
            }
            let room = buffer.get_mut(self.length..self.length + SEGMENT).ok_or(AbortCode::OUT_OF_MEMORY)?;
            room.copy_from_slice(data);
            self.length += SEGMENT;
        }
        Ok(if is_last || sequence == self.size { self.acknowledge() } else { Received::More })
    }

    fn acknowledge(&mut self) -> Received {
        Received::SubBlock(core::mem::take(&mut self.sequence))
    }

    /// Returns the length of the value: all segments, except the unused bytes of the last segment.
    pub fn ended_length(&self, end: &Message) -> usize {
        self.length + SEGMENT - usize::from(end[0] >> 2 & 7)
    }

    /// Ends the transfer: stores the last segment and compares length and CRC. Returns the length of the value.
    ///
    /// `end` is the message that ends the transfer. `length` is the announced length if it is known. Returns
    /// [`AbortCode::LENGTH`] if the length is wrong, [`AbortCode::CRC`] if the CRC is wrong, or
    /// [`AbortCode::OUT_OF_MEMORY`] if the value is longer than `buffer`.
    pub fn end(
        &self,
        end: &Message,
        length: Option<usize>,
        has_crc: bool,
        buffer: &mut [u8],
    ) -> Result<usize, AbortCode> {
        let [_, low, high, ..] = *end;
        let all = self.ended_length(end);
        if length.is_some_and(|length| length != all) {
            return Err(AbortCode::LENGTH);
        }
        let room = buffer.get_mut(self.length..all).ok_or(AbortCode::OUT_OF_MEMORY)?;
        room.iter_mut().zip(&self.previous[1..]).for_each(|(to, from)| *to = *from);
        let expected = u16::from_le_bytes([low, high]);
        let is_right = !has_crc || buffer.get(..all).is_some_and(|value| crc(value) == expected);
        if is_right {
            Ok(all)
        } else {
            Err(AbortCode::CRC)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const START: Message = [0xC6, 1, 0x20, 0, 40, 0, 0, 0];

    /// Sends one sub-block, except the segments in `lost`. Returns the last reaction.
    fn sub_block(
        sender: &mut Sender,
        value: &[u8],
        receiver: &mut Receiver,
        buffer: &mut [u8],
        lost: &[u8],
    ) -> Result<Received, AbortCode> {
        let mut last = Ok(Received::More);
        while let Some(segment) = sender.segment(value) {
            if !lost.contains(&(segment[0] & 0x7F)) {
                last = receiver.segment(&segment, buffer);
            }
        }
        last
    }

    fn value() -> [u8; 40] {
        core::array::from_fn(|at| at as u8)
    }

    #[test]
    fn lost_segments_are_repeated() {
        let (value, mut buffer) = (value(), [0; 40]);
        let (mut sender, mut receiver) = (Sender::new(4), Receiver::new(4, START));
        let mut send = |sender: &mut Sender, lost: &[u8]| sub_block(sender, &value, &mut receiver, &mut buffer, lost);
        assert_eq!(send(&mut sender, &[2, 3]), Ok(Received::SubBlock(1)));
        assert_eq!(sender.acknowledge(&value, 1, 4), Ok(false));
        assert_eq!(send(&mut sender, &[1]), Ok(Received::SubBlock(0)));
        assert_eq!(sender.acknowledge(&value, 0, 4), Ok(false));
        assert_eq!(send(&mut sender, &[4]), Ok(Received::More), "the end of the sub-block is lost");
        let mut sender = Sender { sent: 0, ..sender };
        // The segments 1 to 3 have been received, and the sub-block ends with segment 4.
        assert_eq!(send(&mut sender, &[]), Ok(Received::SubBlock(4)));
        assert_eq!(sender.acknowledge(&value, 4, 4), Ok(false));
        assert_eq!(send(&mut sender, &[]), Ok(Received::Value(1)));
        assert_eq!(sender.acknowledge(&value, 1, 0), Ok(true));
        let message = end(0xC1, &value, true);
        assert_eq!(message[0], 0xC1 | 2 << 2);
        assert_eq!(receiver.end(&message, Some(40), true, &mut buffer), Ok(40));
        assert_eq!(buffer, value);
    }

    #[test]
    fn repeated_segments_are_ignored() {
        let (value, mut buffer) = (value(), [0; 40]);
        let (mut sender, mut receiver) = (Sender::new(3), Receiver::new(3, START));
        assert_eq!(receiver.segment(&START, &mut buffer), Ok(Received::More));
        for _ in 0..2 {
            let mut last = Ok(Received::More);
            while let Some(segment) = sender.segment(&value) {
                last = receiver.segment(&segment, &mut buffer);
                assert_eq!(receiver.segment(&segment, &mut buffer), Ok(Received::More));
            }
            sender.acknowledge(&value, 3, 3).expect("it is right");
            assert!(matches!(last, Ok(Received::SubBlock(3) | Received::Value(3))));
        }
        assert_eq!(receiver.end(&end(0xC1, &value, true), None, true, &mut buffer), Ok(40));
    }

    #[test]
    fn wrong_sequence_numbers() {
        let mut buffer = [0; 40];
        for wrong in [0x00, 0x80, 0x05, 0x85] {
            let segment = [wrong, 1, 2, 3, 4, 5, 6, 7];
            assert_eq!(Receiver::new(4, START).segment(&segment, &mut buffer), Err(AbortCode::SEQUENCE_NUMBER));
        }
        let mut sender = Sender::new(4);
        sender.segment(&value());
        assert_eq!(sender.acknowledge(&value(), 2, 4), Err(AbortCode::SEQUENCE_NUMBER));
        assert_eq!(sender.acknowledge(&value(), 1, 0), Err(AbortCode::BLOCK_SIZE));
        assert_eq!(sender.acknowledge(&value(), 0, 128), Err(AbortCode::BLOCK_SIZE));
    }

    #[test]
    fn repetitions_end() {
        let mut sender = Sender::new(4);
        for _ in 0..MOST_REPETITIONS {
            assert_eq!(sender.acknowledge(&value(), 0, 4), Ok(false));
        }
        assert_eq!(sender.acknowledge(&value(), 0, 4), Err(AbortCode::SEQUENCE_NUMBER));
    }

    #[test]
    fn wrong_ends() {
        let (value, mut buffer) = (value(), [0; 40]);
        let (mut sender, mut receiver) = (Sender::new(127), Receiver::new(127, START));
        assert_eq!(sub_block(&mut sender, &value, &mut receiver, &mut buffer, &[]), Ok(Received::Value(6)));
        let right = end(0xC1, &value, true);
        let mut wrong = right;
        wrong[1] ^= 1;
        assert_eq!(receiver.end(&wrong, Some(40), true, &mut buffer), Err(AbortCode::CRC));
        assert_eq!(receiver.end(&wrong, Some(40), false, &mut buffer), Ok(40));
        assert_eq!(receiver.end(&right, Some(41), true, &mut buffer), Err(AbortCode::LENGTH));
        assert_eq!(receiver.end(&right, None, true, &mut buffer[..39]), Err(AbortCode::OUT_OF_MEMORY));
        let mut short = Receiver::new(127, START);
        let first = Sender::new(127).segment(&value).expect("a segment");
        assert_eq!(short.segment(&first, &mut [0; 6]), Err(AbortCode::OUT_OF_MEMORY));
    }

    #[test]
    fn an_empty_value_has_one_segment() {
        let (mut sender, mut receiver) = (Sender::new(127), Receiver::new(127, START));
        assert_eq!(sub_block(&mut sender, &[], &mut receiver, &mut [], &[]), Ok(Received::Value(1)));
        assert_eq!(sender.acknowledge(&[], 1, 127), Ok(true));
        let message = end(0xC1, &[], true);
        assert_eq!((message, unused(&[])), ([0xC1 | 7 << 2, 0, 0, 0, 0, 0, 0, 0], 7));
        assert_eq!(receiver.end(&message, Some(0), true, &mut []), Ok(0));
    }
}
