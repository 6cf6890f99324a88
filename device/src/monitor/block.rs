//! State of SDO block transfers (CiA 301 7.2.4.3.9 to 7.2.4.3.17).
//!
//! A segment of a block transfer begins with its sequence number instead of a command. Only the messages before it show that
//! it is a segment.

use std::collections::HashMap;

/// First byte of an abort. No segment has this first byte.
const ABORT: u8 = 0x80;
/// Bit in the first byte of a segment: set in the last segment of a value. The other bits of this byte are the sequence
/// number.
const LAST: u8 = 0x80;

/// The block transfers that are in progress, by node-ID.
#[derive(Debug, Default)]
pub(super) struct Blocks(HashMap<u8, Block>);

#[derive(Debug)]
struct Block {
    /// True if the client sends the segments.
    is_download: bool,
    /// True if the next message of the sender is a segment.
    is_sending: bool,
    /// Number of segments in a sub-block.
    size: u8,
    /// Sequence number of the last segment of the value, if this segment was sent.
    last: Option<u8>,
}

impl Blocks {
    /// Returns whether an SDO message is a segment of a block transfer, and updates the state of this transfer. All SDO
    /// messages of the node must be passed in their order.
    pub fn is_segment(&mut self, node: u8, is_request: bool, message: &[u8; 8]) -> bool {
        let command = message[0];
        if command == ABORT {
            self.0.remove(&node);
            return false;
        }
        match self.0.get_mut(&node) {
            Some(block) if block.is_sending && block.is_download == is_request => {
                let sequence = command & !LAST;
                block.last = (command & LAST != 0).then_some(sequence);
                block.is_sending = block.last.is_none() && sequence < block.size;
                true
            }
            _ => {
                self.follow(node, is_request, message);
                false
            }
        }
    }

    /// Updates the state for a message that is neither a segment nor an abort.
    fn follow(&mut self, node: u8, is_request: bool, message: &[u8; 8]) {
        let [command, acknowledged, next_size, _, size, ..] = *message;
        const RECEIVER: u8 = 5;
        if command >> 5 != RECEIVER {
            return;
        }
        let is_download = !is_request;
        match (command & 3, self.0.get_mut(&node)) {
            // In a download, the reply starts the segments. In an upload, the client sends a separate message.
            (0, _) => {
                self.0.insert(node, Block { is_download, is_sending: is_download, size, last: None });
            }
            (2, Some(block)) if block.last == Some(acknowledged) => {
                self.0.remove(&node);
            }
            (2, Some(block)) => *block = Block { is_download, is_sending: true, size: next_size, last: None },
            (3, Some(block)) => block.is_sending = true,
            _ => {}
        }
    }
}
