//! Node-ID of a device on a CANopen network.

use core::fmt;

/// A CANopen node-ID, 1 to 127.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct NodeId(u8);

impl NodeId {
    /// Creates a node-ID. Returns `None` if `id` is outside the range 1 to 127.
    #[must_use]
    pub const fn new(id: u8) -> Option<Self> {
        match id {
            1..=127 => Some(Self(id)),
            _ => None,
        }
    }

    /// Returns the node-ID as a number, 1 to 127.
    #[must_use]
    pub const fn get(self) -> u8 {
        self.0
    }
}

impl fmt::Display for NodeId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn limits() {
        assert_eq!(NodeId::new(0), None);
        assert_eq!(NodeId::new(1).map(NodeId::get), Some(1));
        assert_eq!(NodeId::new(127).map(NodeId::get), Some(127));
        assert_eq!(NodeId::new(128), None);
    }
}
