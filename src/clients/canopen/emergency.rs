//! Emergency messages in CAN frames (CiA 301 7.2.7).

use super::frame::CanFrame;
use crate::emergency::Emergency;
use crate::node_id::NodeId;

/// Default COB-ID of emergency messages in object 0x1014, without the node-ID (CiA 301 7.3.5).
const EMERGENCY: u16 = 0x080;

impl Emergency {
    /// Returns the emergency message in a frame with the default COB-ID of `node`, or `None` for other frames.
    #[must_use]
    pub fn of(frame: &CanFrame, node: NodeId) -> Option<Self> {
        Self::of_id(frame, EMERGENCY + u16::from(node.get()))
    }

    /// Returns the emergency message in a frame with the COB-ID `id` (bits 0 to 10 of object 0x1014). Returns `None`
    /// for other frames.
    #[must_use]
    pub fn of_id(frame: &CanFrame, id: u16) -> Option<Self> {
        Self::from_bytes(frame.data()).filter(|_| frame.id() == id)
    }

    /// Returns the frame in which `node` sends this message.
    #[must_use]
    pub fn frame(&self, node: NodeId) -> CanFrame {
        CanFrame::of(EMERGENCY + u16::from(node.get()), self.to_bytes())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames() {
        let node = NodeId::new(5).expect("a node-ID");
        let emergency = Emergency { code: 0x8130, register: 0x11, vendor: [1, 2, 3, 4, 5] };
        let frame = emergency.frame(node);
        assert_eq!((frame.id(), frame.data()), (0x085, [0x30, 0x81, 0x11, 1, 2, 3, 4, 5].as_slice()));
        assert_eq!(Emergency::of(&frame, node), Some(emergency));
        assert_eq!(Emergency::of_id(&frame, 0x086), None);
        assert_eq!(Emergency::of(&CanFrame::of(0x085, [0; 7]), node), None);
    }
}
