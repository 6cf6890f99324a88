//! The clock of a simulated device.

use core::time::Duration;
use std::time::Instant;

/// Duration of one step of the simulation. The simulation advances in whole steps, and the remaining time is added to
/// the next advance. The result therefore doesn't depend on how many calls of `Device::step` a test uses to advance
/// the time.
pub(super) const STEP: Duration = Duration::from_millis(1);

/// Selects whether client accesses advance the simulated time, in addition to `Device::step`.
#[derive(Clone, Copy, Debug, Default)]
pub(super) enum Pace {
    /// Only `Device::step` advances the time.
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
