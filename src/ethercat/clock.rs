//! Distributed clocks.

/// An operation mode of the distributed clocks.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct ClockMode {
    /// Name of the mode.
    pub name: &'static str,
    /// Description; may be empty.
    pub description: &'static str,
    /// Value of register 0x0980, which activates the sync and latch units. The register value 0 disables the
    /// distributed clocks.
    pub assign_activate: u16,
    /// Cycle time of Sync0.
    pub cycle_sync0: ClockTime,
    /// Shift time of Sync0.
    pub shift_sync0: ClockTime,
    /// Cycle time of Sync1.
    pub cycle_sync1: ClockTime,
    /// Shift time of Sync1.
    pub shift_sync1: ClockTime,
}

/// A time of a clock mode: the sum of a constant and an optional multiple or fraction of the cycle time.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct ClockTime {
    /// Constant part of the time in ns.
    pub nanoseconds: i32,
    /// Factor of the cycle time. A negative factor divides the cycle time by the absolute value of the factor. The
    /// value 0 means that the time doesn't depend on the cycle time.
    pub factor: i32,
}

impl ClockTime {
    /// Creates a time from the constant part and the factor.
    #[must_use]
    pub const fn new(nanoseconds: i32, factor: i32) -> Self {
        Self { nanoseconds, factor }
    }

    /// Returns the time in ns if the cycle time is `cycle` ns. For Sync1, pass the cycle time of Sync0.
    #[must_use]
    pub const fn of_cycle(self, cycle: u32) -> i64 {
        let part = match self.factor {
            factor @ 1.. => cycle as i64 * factor as i64,
            0 => 0,
            divisor => cycle as i64 / -(divisor as i64),
        };
        part + self.nanoseconds as i64
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_follow_the_cycle() {
        assert_eq!(ClockTime::new(0, 1).of_cycle(1_000_000), 1_000_000);
        assert_eq!(ClockTime::new(-5_000, -4).of_cycle(1_000_000), 245_000);
        assert_eq!(ClockTime::new(30_000, 0).of_cycle(1_000_000), 30_000);
        assert_eq!(ClockTime::new(i32::MIN, i32::MIN).of_cycle(u32::MAX), 1 - (1 << 31));
    }
}
