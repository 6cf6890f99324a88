//! TIME messages (CiA 301 7.2.6).

use super::frame::CanFrame;
use crate::pdo::can_id;
use crate::time::TimeOfDay;

/// Default COB-ID of TIME in object 0x1012 (CiA 301 7.3.5).
const TIME: u32 = 0x100;

impl TimeOfDay {
    /// Returns the time in a TIME message with the default COB-ID 0x100, or `None` for other frames.
    #[must_use]
    pub fn of(frame: &CanFrame) -> Option<Self> {
        Self::of_id(frame, TIME)
    }

    /// Returns the time in a TIME message with the COB-ID `id` (object 0x1012), or `None` for other frames. Bit 29 of
    /// `id` means that the CAN-ID has 29 bits; bits 30 and 31 are ignored.
    #[must_use]
    pub fn of_id(frame: &CanFrame, id: u32) -> Option<Self> {
        let [a, b, c, d, e, f] = <[u8; 6]>::try_from(frame.data()).ok()?;
        let time = Self::from_raw(u64::from_le_bytes([a, b, c, d, e, f, 0, 0]));
        Some(time).filter(|_| Some(frame.id()) == can_id(id))
    }

    /// Returns the TIME message with the default COB-ID 0x100.
    #[must_use]
    pub fn frame(self) -> CanFrame {
        let [a, b, c, d, e, f, ..] = self.raw().to_le_bytes();
        CanFrame::of(TIME, [a, b, c, d, e, f])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames() {
        let time = TimeOfDay::new(0x0123_4567, 0x89AB);
        let frame = time.frame();
        assert_eq!((frame.id(), frame.data()), (0x100, [0x67, 0x45, 0x23, 0x01, 0xAB, 0x89].as_slice()));
        assert_eq!(TimeOfDay::of(&frame), Some(time));
        assert_eq!(TimeOfDay::of_id(&frame, 0x8000_0100), Some(time));
        assert_eq!((TimeOfDay::of_id(&frame, 0x101), TimeOfDay::of(&CanFrame::of(0x100, [0; 5]))), (None, None));
    }
}
