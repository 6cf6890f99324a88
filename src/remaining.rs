//! Remaining time until a deadline.

use core::time::Duration;

use crate::clock::elapsed;

/// Maximum pause between two polls of a device.
const PAUSE: Duration = Duration::from_millis(5);

/// The remaining time until a deadline. The elapsed time is measured with the client's clock, but is at least the sum
/// of the pauses.
pub(crate) struct Remaining {
    start: Option<Duration>,
    waited: Duration,
    deadline: Duration,
}

impl Remaining {
    /// Starts a time measurement that ends after `deadline`. `now` is the time of the client's clock.
    pub(crate) fn new(now: Option<Duration>, deadline: Duration) -> Self {
        Self { start: now, waited: Duration::ZERO, deadline }
    }

    /// Returns the next pause, or `None` after the deadline.
    pub(crate) fn pause(&mut self, now: Option<Duration>) -> Option<Duration> {
        let elapsed = elapsed(self.start, now);
        let rest = self.deadline.saturating_sub(elapsed.unwrap_or_default().max(self.waited));
        let pause = rest.min(PAUSE);
        self.waited += pause;
        (!pause.is_zero()).then_some(pause)
    }
}
