//! The clock of a simulated device.

use core::time::Duration;
use std::time::Instant;

/// Duration of one step of the simulation. All times are rounded down to whole steps, and the rest counts for the next
/// step. The result therefore doesn't depend on how a test divides the time.
pub(super) const STEP: Duration = Duration::from_millis(1);

/// Source of the time of a device, in addition to `Device::step`.
#[derive(Clone, Copy, Debug, Default)]
pub(super) enum Pace {
    /// No further source.
    #[default]
    Manual,
    /// Each access of a client advances the time by this duration.
    PerAccess(Duration),
    /// Each access of a client advances the time by the real time since this moment.
    Real(Instant),
}

/// Clock of a device.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Clock {
    pub(super) pace: Pace,
    /// Time since the last step.
    pub(super) rest: Duration,
}
