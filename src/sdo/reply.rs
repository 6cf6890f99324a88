//! Replies that a client expects.

use super::message::{block, object, reply, specifier, subcommand, Message, ABORT, ABORT_COMMAND};
use crate::bus::Object;

/// The expected reply to a request: a reply of this kind, or an abort for the same object.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Expected {
    pub(super) object: Object,
    pub(super) kind: Kind,
}

/// Kind of a reply.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    Upload,
    UploadSegment,
    Download,
    DownloadSegment,
    /// The server may reply with [`Upload`](Self::Upload) instead if the value is short.
    BlockUpload,
    /// Segments of a block have no command specifier: any message except an abort is a segment.
    BlockUploadSegment,
    BlockUploadEnd,
    BlockDownload,
    BlockDownloadAcknowledge,
    BlockDownloadEnd,
}

impl Expected {
    /// Returns whether a message of the server is the expected reply. Other messages must not restart the timeout.
    pub fn accepts(self, message: &Message) -> bool {
        self.is_abort(message) || self.is_reply(message)
    }

    /// Returns whether a message aborts the transfer.
    pub(super) fn is_abort(self, message: &Message) -> bool {
        let is_abort = match self.kind {
            Kind::BlockUploadSegment => message[0] == ABORT_COMMAND,
            _ => specifier(message) == ABORT,
        };
        is_abort && self.is_of_object(message)
    }

    fn is_of_object(self, message: &Message) -> bool {
        object(message) == self.object
    }

    fn is_reply(self, message: &Message) -> bool {
        let is_block = |expected, command| specifier(message) == expected && subcommand(message) == command;
        // In the reply that initiates a block transfer, bit 1 may be the bit for the length.
        let initiates = |expected| specifier(message) == expected && message[0] & 1 == block::INITIATE;
        match self.kind {
            Kind::Upload => specifier(message) == reply::UPLOAD && self.is_of_object(message),
            Kind::Download => specifier(message) == reply::DOWNLOAD && self.is_of_object(message),
            Kind::UploadSegment => specifier(message) == reply::UPLOAD_SEGMENT,
            Kind::DownloadSegment => specifier(message) == reply::DOWNLOAD_SEGMENT,
            Kind::BlockUpload => {
                let is_upload = specifier(message) == reply::UPLOAD || initiates(reply::BLOCK_UPLOAD);
                is_upload && self.is_of_object(message)
            }
            Kind::BlockUploadSegment => true,
            Kind::BlockUploadEnd => is_block(reply::BLOCK_UPLOAD, block::END),
            Kind::BlockDownload => is_block(reply::BLOCK_DOWNLOAD, block::INITIATE) && self.is_of_object(message),
            Kind::BlockDownloadAcknowledge => is_block(reply::BLOCK_DOWNLOAD, block::ACKNOWLEDGE),
            Kind::BlockDownloadEnd => is_block(reply::BLOCK_DOWNLOAD, block::END),
        }
    }

    /// Returns whether the server has answered the first request, and the transfer isn't complete.
    pub const fn is_continued(self) -> bool {
        !matches!(self.kind, Kind::Upload | Kind::Download | Kind::BlockUpload | Kind::BlockDownload)
    }

    /// Returns whether the server sends several messages without waiting for the client.
    pub const fn is_stream(self) -> bool {
        matches!(self.kind, Kind::BlockUploadSegment)
    }

    /// Returns the object of the transfer.
    pub const fn object(self) -> Object {
        self.object
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn accepts(kind: Kind, message: Message) -> bool {
        Expected { object: Object::new(0x2000, 1), kind }.accepts(&message)
    }

    #[test]
    fn aborts_and_segments() {
        let abort = [0x80, 0, 0x20, 1, 0, 0, 0, 8];
        let other = [0x80, 0, 0x20, 2, 0, 0, 0, 8];
        for kind in [Kind::Upload, Kind::UploadSegment, Kind::BlockUploadEnd, Kind::BlockDownloadAcknowledge] {
            assert!(accepts(kind, abort) && !accepts(kind, other), "{kind:?}");
        }
        let expected = Expected { object: Object::new(0x2000, 1), kind: Kind::BlockUploadSegment };
        assert!(expected.is_abort(&abort));
        assert!(!expected.is_abort(&[0x81, 0, 0x20, 1, 0, 0, 0, 8]), "the last segment of a value");
    }

    #[test]
    fn block_replies() {
        assert!(accepts(Kind::BlockUpload, [0xC6, 0, 0x20, 1, 0, 0, 0, 0]));
        assert!(accepts(Kind::BlockUpload, [0x43, 0, 0x20, 1, 0, 0, 0, 0]), "the server switches the protocol");
        assert!(!accepts(Kind::BlockUpload, [0xC6, 0, 0x20, 2, 0, 0, 0, 0]));
        assert!(!accepts(Kind::BlockUpload, [0xC1, 0, 0x20, 1, 0, 0, 0, 0]));
        assert!(accepts(Kind::BlockUploadEnd, [0xD5, 0, 0, 0, 0, 0, 0, 0]));
        assert!(accepts(Kind::BlockDownload, [0xA4, 0, 0x20, 1, 127, 0, 0, 0]));
        assert!(accepts(Kind::BlockDownloadAcknowledge, [0xA2, 5, 127, 0, 0, 0, 0, 0]));
        assert!(!accepts(Kind::BlockDownloadEnd, [0xA2, 5, 127, 0, 0, 0, 0, 0]));
    }
}
