//! Faults of a simulated CAN bus.

use core::error;
use core::fmt;
use core::time::Duration;
use std::vec::Vec;

use crate::clients::canopen::CanFrame;

/// A fault of a frame that a client receives from a simulated CAN bus. [`FaultyCan`](super::FaultyCan) injects the
/// fault.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum CanFault {
    /// The frame arrives with this delay.
    Late(Duration),
    /// The frame doesn't arrive.
    Lost,
    /// The frame arrives twice.
    Duplicated,
    /// The frame arrives with only the first half of its data.
    Truncated,
    /// Instead of the frame, another frame arrives `count` times, such as the reply to another request.
    Foreign {
        /// The frame that arrives.
        frame: CanFrame,
        /// Number of times that the frame arrives.
        count: u32,
        /// Time before each of these frames.
        period: Duration,
    },
    /// This number of frames with the CAN-ID 0x123 arrives before the frame. The predefined connection set (CiA 301 7.3.3)
    /// doesn't use this CAN-ID.
    Noise(u32),
    /// The toggle bit of the frame is inverted: bit 7 of an answer to node guarding or of a heartbeat, and bit 4 of an
    /// SDO segment or its confirmation from the default SDO server. Other frames are not changed. In block uploads, bit
    /// 4 of sequence numbers up to 63 is inverted, except in the last segment.
    WrongToggle,
    /// The frame is lost, because all devices on the bus restart, as after a power failure.
    Restart,
    /// The interface enters the bus-off state. This frame, all following frames, and the frames that the client has not
    /// received are lost, and each attempt to send or receive returns [`CanError::BusOff`], until
    /// [`recover`](super::FaultyCan::recover) is called.
    BusOff,
    /// The interface receives an error frame, and the client gets the error [`CanError::ErrorFrame`]. The frame arrives
    /// after the error frame, because the sender repeats the frame.
    ErrorFrame,
}

/// Error of a simulated CAN interface.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum CanError {
    /// The interface is in the bus-off state: it neither sends nor receives.
    BusOff,
    /// The interface received an error frame.
    ErrorFrame,
}

impl fmt::Display for CanError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::BusOff => "the simulated CAN interface is bus-off",
            Self::ErrorFrame => "the simulated CAN interface received an error frame",
        })
    }
}

impl error::Error for CanError {}

/// Returns the frame with the first half of its data.
pub(super) fn truncated(frame: &CanFrame) -> CanFrame {
    let data = frame.data();
    data.get(..data.len() / 2).and_then(|half| CanFrame::new(frame.id(), half)).unwrap_or(*frame)
}

/// Returns the frame with an inverted toggle bit if it has one.
pub(super) fn toggled(frame: &CanFrame) -> CanFrame {
    /// Toggle bits of an answer to node guarding (CiA 301 7.2.8.3.2.1) and of an SDO segment (7.2.4.3.6).
    const GUARDING: u8 = 1 << 7;
    const SEGMENT: u8 = 1 << 4;
    let mut data: Vec<u8> = frame.data().to_vec();
    let (id, length) = (frame.id(), data.len());
    let Some(first) = data.first_mut() else { return *frame };
    // The command specifier of a segment or of its confirmation is 0 or 1.
    *first ^= match (id, length, *first >> 5) {
        (0x701..=0x77F, 1, _) => GUARDING,
        (0x581..=0x5FF, 8, 0 | 1) => SEGMENT,
        _ => 0,
    };
    CanFrame::new(frame.id(), &data).unwrap_or(*frame)
}
