//! Simulated time of a device.

use core::time::Duration;
use std::time::Instant;

use super::clock::{Pace, STEP};
use super::device::Device;

impl Device {
    /// Returns the device with a fixed duration for each access of a client. The simulated time advances by `time`
    /// before each access. Use this method for a driver that polls the device without [waiting](crate::Client::wait),
    /// and for a `CanNode`, where each received frame is an access.
    #[must_use]
    pub fn with_access_time(mut self, time: Duration) -> Self {
        self.clock.pace = Pace::PerAccess(time);
        self
    }

    /// Returns the device with a clock that also follows the real time. Before each access of a client, the simulated
    /// time advances by the real time since the last access. Use this method for demonstrations. Tests with real time
    /// are not deterministic.
    #[must_use]
    pub fn with_real_time(mut self) -> Self {
        self.clock.pace = Pace::Real(Instant::now());
        self
    }

    /// Advances the simulated time. Simulated drives ([`with_cia402`](Self::with_cia402)) move in steps of 1 ms.
    ///
    /// A client of the device also advances the time when the driver [waits](crate::Client::wait). A `CanNode` advances
    /// the time with its own clock.
    pub fn step(&mut self, time: Duration) {
        self.clock.rest = self.clock.rest.saturating_add(time);
        while self.clock.rest >= STEP {
            if self.is_settled {
                // All further steps have the same result.
                let rest = self.clock.rest.as_nanos() % STEP.as_nanos();
                self.clock.rest = Duration::from_nanos(rest as u64);
                return;
            }
            self.clock.rest -= STEP;
            self.step_drives();
        }
    }

    /// Returns the time by which an access of a client advances the simulated time.
    pub(super) fn access_time(&mut self) -> Duration {
        match &mut self.clock.pace {
            Pace::Manual => Duration::ZERO,
            Pace::PerAccess(time) => *time,
            Pace::Real(last) => core::mem::replace(last, Instant::now()).elapsed(),
        }
    }

    /// Advances the simulated time before an access of a client.
    pub(super) fn access(&mut self) {
        let time = self.access_time();
        self.step(time);
    }

    /// Returns the time until the next step, or `None` if the next step changes nothing.
    #[cfg(feature = "canopen")]
    pub(super) fn next_step(&self) -> Option<Duration> {
        (!self.is_settled).then(|| STEP.saturating_sub(self.clock.rest))
    }
}
