//! Pairs of COB-IDs on which SDO messages are sent.

use crate::node_id::NodeId;
use crate::pdo::{is_can_id, is_restricted};

/// The two COB-IDs of an SDO channel (CiA 301 7.5.2.33 and 7.5.2.34). For a CAN-ID of 29 bits, bit 29 is set.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Channel {
    request: u32,
    reply: u32,
}

impl Channel {
    /// Creates a channel from the COB-IDs of requests (client to server) and replies (server to client).
    ///
    /// Returns `None` if the COB-IDs are equal, or if a COB-ID is invalid or restricted (CiA 301 7.3.5). A COB-ID is
    /// invalid if bit 30 or 31 is set, or if the CAN-ID has more than 11 bits and bit 29 isn't set. The COB-IDs of the
    /// default channel are restricted; use [`of_node`](Self::of_node).
    #[must_use]
    pub const fn new(request: u32, reply: u32) -> Option<Self> {
        if request == reply || !is_possible(request) || !is_possible(reply) {
            return None;
        }
        Some(Self { request, reply })
    }

    /// Returns the default channel of a node: requests with COB-ID 0x600 + node-ID, replies with 0x580 + node-ID (CiA
    /// 301 7.3.5).
    #[must_use]
    pub const fn of_node(node: NodeId) -> Self {
        Self { request: 0x600 + node.get() as u32, reply: 0x580 + node.get() as u32 }
    }

    /// Returns the COB-ID of requests.
    #[must_use]
    pub const fn request(self) -> u32 {
        self.request
    }

    /// Returns the COB-ID of replies.
    #[must_use]
    pub const fn reply(self) -> u32 {
        self.reply
    }
}

const fn is_possible(id: u32) -> bool {
    is_can_id(id) && !is_restricted(id)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn restricted_identifiers() {
        let channel = Channel::new(0x6E, 0x6F);
        assert_eq!(channel, None);
        let channel = Channel::new(0x680, 0x6DF).expect("a channel");
        assert_eq!((channel.request(), channel.reply()), (0x680, 0x6DF));
        for wrong in [(0x680, 0x680), (0, 0x680), (0x680, 0x605), (0x585, 0x680), (0x680, 0x800)] {
            assert_eq!(Channel::new(wrong.0, wrong.1), None, "{wrong:X?}");
        }
        let extended = Channel::new(0x2000_0605, 0x3FFF_FFFF).expect("a channel");
        assert_eq!((extended.request(), extended.reply()), (0x2000_0605, 0x3FFF_FFFF));
        assert_eq!(Channel::new(0x6000_0605, 0x680), None);
        let default = Channel::of_node(NodeId::new(5).expect("a node-ID"));
        assert_eq!((default.request(), default.reply()), (0x605, 0x585));
    }
}
