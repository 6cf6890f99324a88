//! Emergency messages (CiA 301 7.2.7).

use super::frame::CanFrame;
use crate::codes::CodeTable;
use crate::node_id::NodeId;

/// The identifier of emergency messages, less the node-ID, where object 0x1014 has its usual value (CiA 301 7.3.5).
const EMERGENCY: u16 = 0x080;

/// What a device tells of an error.
///
/// ```
/// use lexibus::clients::canopen::{CanFrame, Emergency};
/// use lexibus::NodeId;
/// use lexibus_drives::demo_drive::codes::DriveErrors;
///
/// let frame = CanFrame::new(0x085, &[0x11, 0x86, 0x21, 0, 0, 0, 0, 0]).expect("a frame");
/// let emergency = Emergency::of(&frame, NodeId::new(5).expect("a node-ID")).expect("an emergency message");
/// assert_eq!(emergency.alarm::<DriveErrors>(), DriveErrors::FollowingError);
/// assert!(!emergency.is_reset());
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Emergency {
    /// The error code.
    pub code: u16,
    /// The error register, object 0x1001.
    pub register: u8,
    /// What the vendor adds.
    pub vendor: [u8; 5],
}

impl Emergency {
    /// What a frame tells that has the usual identifier of `node`'s emergency messages; `None` for other frames.
    #[must_use]
    pub fn of(frame: &CanFrame, node: NodeId) -> Option<Self> {
        Self::of_id(frame, EMERGENCY + u16::from(node.get()))
    }

    /// The same where object 0x1014 has the identifier `id`.
    #[must_use]
    pub fn of_id(frame: &CanFrame, id: u16) -> Option<Self> {
        let &[low, high, register, ref vendor @ ..] = frame.data() else { return None };
        let vendor = vendor.try_into().ok()?;
        (frame.id() == id).then_some(Self { code: u16::from_le_bytes([low, high]), register, vendor })
    }

    /// Whether it says that an error, or all errors, are gone (CiA 301 7.2.7.1: codes 0x0000 to 0x00FF).
    #[must_use]
    pub const fn is_reset(&self) -> bool {
        self.code <= 0xFF
    }

    /// The code by its name in one of the device's tables, such as the type `codes::Emergency` of generated bindings.
    #[must_use]
    pub fn alarm<T: CodeTable>(&self) -> T
    where
        T::Raw: From<u16>,
    {
        T::from_raw(self.code.into())
    }

    /// The frame by which `node` tells it.
    #[must_use]
    pub fn frame(&self, node: NodeId) -> CanFrame {
        let ([low, high], [a, b, c, d, e]) = (self.code.to_le_bytes(), self.vendor);
        CanFrame::of(EMERGENCY + u16::from(node.get()), [low, high, self.register, a, b, c, d, e])
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
        assert!(Emergency { code: 0, ..emergency }.is_reset());
    }
}
