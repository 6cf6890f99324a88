//! Client side of block transfers.

use super::super::block::{block_size, end, Received, Receiver, Sender};
use super::super::message::{
    block, block as subcommand, number, request, Message, MOST_SEGMENTS, SEGMENT, WITH_CRC, WITH_SIZE,
};
use super::{Phase, Transfer};
use crate::abort::AbortCode;

/// Block transfers (CiA 301 7.2.4.3.9 to 7.2.4.3.15).
impl Transfer<'_> {
    pub(super) fn block_upload_initiated(&mut self, message: &Message) {
        if message[0] & WITH_CRC == 0 {
            return self.fall_back_without_crc();
        }
        let size = (message[0] & WITH_SIZE != 0).then_some(number(message) as usize);
        let room = self.buffer().len();
        if let Some(size) = size.filter(|size| *size > room) {
            return self.give_up_too_long(size);
        }
        self.length = size.unwrap_or(0);
        self.phase = Phase::BlockUploadSegment { receiver: Receiver::new(MOST_SEGMENTS, *message), size };
        self.send(block(request::BLOCK_UPLOAD << 5 | subcommand::START, 0, 0));
    }

    pub(super) fn block_upload_segment(&mut self, message: &Message, mut receiver: Receiver, size: Option<usize>) {
        let received = receiver.segment(message, self.buffer());
        self.length = self.length.max(receiver.length());
        self.phase = Phase::BlockUploadSegment { receiver, size };
        let sequence = match received {
            Ok(Received::More) => return,
            Ok(Received::SubBlock(sequence)) => sequence,
            Ok(Received::Value(sequence)) => {
                self.phase = Phase::BlockUploadEnd { receiver, size };
                sequence
            }
            Err(code) => {
                // The server may still send the rest of the sub-block.
                self.is_owed = true;
                return match code {
                    AbortCode::OUT_OF_MEMORY if size.is_some() => self.give_up_unexpected(AbortCode::LENGTH),
                    AbortCode::OUT_OF_MEMORY => self.give_up_too_long(receiver.length() + SEGMENT),
                    code => self.give_up_unexpected(code),
                };
            }
        };
        self.send(block(request::BLOCK_UPLOAD << 5 | subcommand::ACKNOWLEDGE, sequence, receiver.size()));
    }

    pub(super) fn block_upload_ended(&mut self, message: &Message, receiver: Receiver, size: Option<usize>) {
        if receiver.is_repeated(message) {
            return;
        }
        match receiver.end(message, size, true, self.buffer()) {
            Ok(length) => {
                self.send(block(request::BLOCK_UPLOAD << 5 | subcommand::END, 0, 0));
                self.result = Some(Ok(length));
            }
            Err(AbortCode::OUT_OF_MEMORY) => self.give_up_too_long(receiver.ended_length(message)),
            Err(code) => self.give_up_unexpected(code),
        }
    }

    pub(super) fn block_download_initiated(&mut self, message: &Message) {
        if message[0] & WITH_CRC == 0 {
            return self.fall_back_without_crc();
        }
        match block_size(message[4]) {
            Ok(size) => self.phase = Phase::BlockDownloadSegment { sender: Sender::new(size) },
            Err(code) => self.give_up_unexpected(code),
        }
    }

    pub(super) fn block_download_acknowledged(&mut self, message: &Message, mut sender: Sender) {
        let [_, sequence, size, ..] = *message;
        match sender.acknowledge(self.data(), sequence, size) {
            Ok(false) => self.phase = Phase::BlockDownloadSegment { sender },
            Ok(true) => {
                self.phase = Phase::BlockDownloadEnd;
                let end = end(request::BLOCK_DOWNLOAD << 5 | subcommand::END, self.data(), true);
                self.send(end);
            }
            Err(code) => self.give_up_unexpected(code),
        }
    }
}
