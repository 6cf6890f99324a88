//! Distributed clocks.

/// A mode of operation of the distributed clocks.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct ClockMode {
    /// Its name.
    pub name: &'static str,
    /// What it does; may be empty.
    pub description: &'static str,
    /// Value of the register 0x0980: which units are active. 0 = no distributed clock.
    pub assign_activate: u16,
    /// Cycle of Sync0.
    pub cycle_sync0: ClockTime,
    /// Shift of Sync0.
    pub shift_sync0: ClockTime,
    /// Cycle of Sync1.
    pub cycle_sync1: ClockTime,
    /// Shift of Sync1.
    pub shift_sync1: ClockTime,
}

/// A time of a clock mode.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct ClockTime {
    /// The time in ns, to which the part that follows from the cycle is added.
    pub nanoseconds: i32,
    /// Times the cycle; a negative number divides it. 0 = the time doesn't depend on the cycle.
    pub factor: i32,
}

impl ClockTime {
    /// A time.
    #[must_use]
    pub const fn new(nanoseconds: i32, factor: i32) -> Self {
        Self { nanoseconds, factor }
    }

    /// The time in ns for a cycle of `cycle` ns. For Sync1, `cycle` is that of Sync0.
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
