//! Bits of the statusword that can still show the result of an earlier command.

use core::time::Duration;

use crate::remaining::Remaining;

/// Time after which bits of the statusword are considered a result of the last command, even if they haven't changed.
pub(super) const SETTLING: Duration = Duration::from_millis(100);

/// Decides whether bits of the statusword are the result of the last command. If the bits are 1 before the drive has
/// evaluated the command, they must stay 1 for 100 ms, or change to 0 and back.
pub(super) struct Settling {
    is_stale: bool,
    remaining: Remaining,
}

impl Settling {
    /// `is_set` is true if the bits were 1, or may have been 1, before the command.
    pub(super) fn new(now: Option<Duration>, is_set: bool) -> Self {
        Self { is_stale: is_set, remaining: Remaining::new(now, SETTLING) }
    }

    /// Returns whether the bits are 1 as a result of the command. `is_set` is true if the bits are 1 now.
    pub(super) fn confirms(&mut self, now: Option<Duration>, is_set: bool) -> bool {
        self.is_stale &= is_set && self.remaining.pause(now).is_some();
        is_set && !self.is_stale
    }
}
