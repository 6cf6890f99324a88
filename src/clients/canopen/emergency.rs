//! Emergency messages in CAN frames (CiA 301 7.2.7).

use super::frame::CanFrame;
use crate::emergency::Emergency;
use crate::node_id::NodeId;
use crate::pdo::can_id;

/// Default COB-ID of emergency messages in object 0x1014, without the node-ID (CiA 301 7.3.5).
pub(super) const EMERGENCY: u32 = 0x080;

impl Emergency {
    /// Returns the emergency message in a frame with the default COB-ID of `node`, or `None` for other frames.
    #[must_use]
    pub fn of(frame: &CanFrame, node: NodeId) -> Option<Self> {
        Self::of_id(frame, EMERGENCY + u32::from(node.get()))
    }

    /// Returns the emergency message in a frame with the COB-ID `id` (object 0x1014), or `None` for other frames. Bit
    /// 29 of `id` means that the CAN-ID has 29 bits; bits 30 and 31 are ignored.
    #[must_use]
    pub fn of_id(frame: &CanFrame, id: u32) -> Option<Self> {
        Self::from_bytes(frame.data()).filter(|_| Some(frame.id()) == can_id(id))
    }

    /// Returns the frame in which `node` sends this message.
    #[must_use]
    pub fn frame(&self, node: NodeId) -> CanFrame {
        CanFrame::of(EMERGENCY + u32::from(node.get()), self.to_bytes())
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
        let extended = CanFrame::new(CanFrame::EXTENDED | 0x085, frame.data()).expect("a frame");
        assert_eq!(Emergency::of_id(&extended, 0x085), None);
        assert_eq!(Emergency::of_id(&extended, 0x2000_0085), Some(emergency));
        assert_eq!(Emergency::of(&CanFrame::of(0x085, [0; 7]), node), None);
    }
}
