//! Result of a homing procedure.

use core::time::Duration;

use super::bits::{CONFIRMED, FAILED, REACHED};
use super::error::MotionError;
use crate::remaining::Remaining;

/// Time after which bits of the statusword are considered a result of the last command, even if they haven't changed.
pub(super) const SETTLING: Duration = Duration::from_millis(100);

/// Decides whether bits 12 and 13 of the statusword are the result of a new homing procedure. After an earlier procedure,
/// the bits can remain set until the drive has evaluated the start bit.
pub(super) struct Outcome {
    is_stale: bool,
    settling: Remaining,
}

impl Outcome {
    /// `status` is the statusword before the start.
    pub(super) fn new(status: u16) -> Self {
        Self { is_stale: status & (CONFIRMED | FAILED) != 0, settling: Remaining::new(SETTLING) }
    }

    /// Returns the result of homing, or `None` while homing is in progress (CiA 402-2 13, bits 10, 12 and 13).
    pub(super) fn of<E>(&mut self, status: u16) -> Option<Result<(), MotionError<E>>> {
        self.is_stale &= status & (CONFIRMED | FAILED) != 0 && self.settling.pause().is_some();
        match status & (CONFIRMED | FAILED) {
            _ if self.is_stale => None,
            bits if bits & FAILED != 0 => Some(Err(MotionError::Homing)),
            CONFIRMED if status & REACHED != 0 => Some(Ok(())),
            _ => None,
        }
    }
}
