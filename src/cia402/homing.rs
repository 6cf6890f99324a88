//! Result of a homing procedure.

use core::time::Duration;

use super::bits::{CONFIRMED, FAILED, REACHED};
use super::error::MotionError;
use super::settling::Settling;

/// Decides whether bits 12 and 13 of the statusword are the result of a new homing procedure. After an earlier procedure,
/// the bits can remain set until the drive has evaluated the start bit.
pub(super) struct Outcome(Settling);

impl Outcome {
    /// `now` is the time of the client's clock, and `status` is the statusword before the start of homing.
    pub(super) fn new(now: Option<Duration>, status: u16) -> Self {
        Self(Settling::new(now, status & (CONFIRMED | FAILED) != 0))
    }

    /// Returns the result of homing, or `None` while homing is in progress (CiA 402-2 13, bits 10, 12 and 13).
    pub(super) fn of<E>(&mut self, now: Option<Duration>, status: u16) -> Option<Result<(), MotionError<E>>> {
        let bits = status & (CONFIRMED | FAILED);
        if !self.0.confirms(now, bits != 0) {
            return None;
        }
        if bits & FAILED != 0 {
            return Some(Err(MotionError::Homing));
        }
        (status & REACHED != 0).then_some(Ok(()))
    }
}
