//! Node guarding of a node (CiA 301 7.2.8.3.2.1).

use core::time::Duration;

use crate::clients::canopen::NmtState;

/// Toggle bit and life time of a node that is guarded.
#[derive(Clone, Debug, Default)]
pub(super) struct Guard {
    toggle: bool,
    deadline: Option<Duration>,
}

impl Guard {
    /// Returns the byte of the answer to a request. The node expects the next request within `life_time`; 0 disables
    /// life guarding.
    pub fn answer(&mut self, state: NmtState, life_time: Duration, now: Duration) -> u8 {
        let raw = state.raw() | u8::from(self.toggle) << 7;
        self.toggle = !self.toggle;
        self.deadline = (!life_time.is_zero()).then(|| now.saturating_add(life_time));
        raw
    }

    /// Returns the time at which the node life time passes.
    pub const fn deadline(&self) -> Option<Duration> {
        self.deadline
    }

    /// Returns whether the node life time has passed. Returns `true` only once.
    pub fn is_expired(&mut self, now: Duration) -> bool {
        let is_expired = self.deadline.is_some_and(|deadline| deadline <= now);
        if is_expired {
            self.deadline = None;
        }
        is_expired
    }
}
