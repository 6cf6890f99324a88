//! Set-points of the cyclic synchronous modes in process data.

use core::fmt;

use super::bits::{CONFIRMED, FAILED, OF_MODE};
use super::error::Numbered;
use super::{Mode, State};
use crate::machine::{MachineState, StateWord};

/// Monitors a drive in a cyclic synchronous mode (CSP, CSV or CST), and selects the set-point that the drive receives
/// in each cycle. A `Cyclic` needs no client and works with every bus library: the program copies the inputs from the
/// process data, and the outputs to the process data.
///
/// - The drive follows the command values if bit 12 of the statusword is 1 in "Operation enabled" and in this mode.
///   Otherwise, the set-point is the actual position in CSP, and 0 in CSV and CST. The first cycle in which the drive
///   follows still has this set-point, so that the axis doesn't jump: start the trajectory at this set-point.
/// - If the drive has followed and then leaves "Operation enabled" or the mode, the cycle returns an error.
/// - The cycle also returns an error if the drive reports a following error (bit 13 of the statusword in CSP), or if
///   the absolute value of the actual following error (0x60F4) is above the limit of the program.
/// - Bits 4, 5, 6 and 9 of the controlword become 0, as these modes require. The other bits don't change: a
///   [`Walker`](crate::Walker) enables the drive.
///
/// After an error, the program decides how the axis stops: for example, a walker can bring the drive to "Switched on".
/// [`Self::hold`] returns the set-point that doesn't move the axis.
///
/// ```
/// use lexibus::cia402::{Cyclic, CycleError, Inputs};
///
/// let mut cyclic = Cyclic::position().with_limit(100);
/// // Statusword, active mode, actual position and following error from the TPDO.
/// let mut inputs = Inputs { status: 0x0237_u16, mode: Some(8), actual: 5000, following_error: Some(3) };
/// // The drive doesn't follow yet: the target is the actual position.
/// let cycle = cyclic.cycle(inputs, 0x000F_u16, 9000)?;
/// assert_eq!((cycle.control, cycle.target, cycle.is_following), (0x000F, 5000, false));
/// // Bit 12: the drive follows. The trajectory starts at the set-point of this cycle.
/// inputs.status = 0x1237;
/// let cycle = cyclic.cycle(inputs, 0x000F_u16, 9000)?;
/// assert_eq!((cycle.target, cycle.is_following), (5000, true));
/// assert_eq!(cyclic.cycle(inputs, 0x000F_u16, 5010)?.target, 5010);
/// inputs.following_error = Some(-101);
/// let error = CycleError::LimitExceeded { error: -101, limit: 100 };
/// assert_eq!(cyclic.cycle(inputs, 0x000F_u16, 5020), Err(error));
/// # Ok::<(), CycleError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Cyclic {
    mode: Mode,
    limit: Option<u32>,
    /// Whether the drive has followed the command values since the last error.
    has_followed: bool,
    /// Whether the drive followed the command values in the last cycle.
    is_following: bool,
}

/// The process data that a [`Cyclic`] reads from the drive in a cycle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Inputs<S> {
    /// Statusword (0x6041).
    pub status: S,
    /// Active mode (0x6061), or `None` if the mode isn't part of the process data. In this case, activate the mode
    /// before the first cycle, for example with [`Drive::set_mode`](super::Drive::set_mode).
    pub mode: Option<i8>,
    /// Actual position (0x6064) as raw value. Not used in CSV and CST.
    pub actual: i32,
    /// Actual following error (0x60F4) as raw value, if it is part of the process data.
    pub following_error: Option<i32>,
}

/// The process data that a [`Cyclic`] sends to the drive in a cycle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Cycle<W> {
    /// Controlword (0x6040).
    pub control: W,
    /// Target position (0x607A), target velocity (0x60FF) or target torque (0x6071), as raw value.
    pub target: i32,
    /// True if the drive follows the command values. From the second such cycle on, `target` is the set-point of the
    /// program.
    pub is_following: bool,
}

/// Reason why a cycle of a [`Cyclic`] failed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum CycleError {
    /// A fault has occurred; the value is the state of the drive.
    Fault(State),
    /// The drive has left "Operation enabled".
    NotEnabled {
        /// State of the drive, or `None` if the statusword encodes no state.
        state: Option<State>,
    },
    /// The drive has left the mode; the value is the active mode.
    WrongMode(Mode),
    /// The drive reports a following error: bit 13 of the statusword in CSP.
    FollowingError {
        /// Actual following error as raw value, if it is part of the process data.
        error: Option<i32>,
    },
    /// The absolute value of the actual following error is above the limit of the program.
    LimitExceeded {
        /// Actual following error as raw value.
        error: i32,
        /// Limit of the program.
        limit: u32,
    },
}

impl Cyclic {
    const fn new(mode: Mode) -> Self {
        Self { mode, limit: None, has_followed: false, is_following: false }
    }

    /// Creates a monitor for mode 8, cyclic synchronous position (CSP).
    #[must_use]
    pub const fn position() -> Self {
        Self::new(Mode::CyclicSynchronousPosition)
    }

    /// Creates a monitor for mode 9, cyclic synchronous velocity (CSV).
    #[must_use]
    pub const fn velocity() -> Self {
        Self::new(Mode::CyclicSynchronousVelocity)
    }

    /// Creates a monitor for mode 10, cyclic synchronous torque (CST).
    #[must_use]
    pub const fn torque() -> Self {
        Self::new(Mode::CyclicSynchronousTorque)
    }

    /// Returns the monitor with a limit for the absolute value of the actual following error (0x60F4, raw value). The
    /// limit applies while the operation is enabled and the mode is active, and only in cycles whose inputs contain the
    /// following error. The limit applies in addition to the following error window of the drive (0x6065).
    #[must_use]
    pub const fn with_limit(self, limit: u32) -> Self {
        Self { limit: Some(limit), ..self }
    }

    /// Returns the mode to request (0x6060).
    #[must_use]
    pub const fn mode(&self) -> Mode {
        self.mode
    }

    /// Returns the set-point that doesn't move the axis: the actual position in CSP, and 0 in CSV and CST.
    #[must_use]
    pub const fn hold<S: StateWord>(&self, inputs: &Inputs<S>) -> i32 {
        match self.mode {
            Mode::CyclicSynchronousPosition => inputs.actual,
            _ => 0,
        }
    }

    /// Returns the outputs of a cycle. `control` is the controlword that the program would send, for example from a
    /// [`Walker`](crate::Walker), and `target` is the set-point of the program. When the drive starts to follow, the
    /// set-point of the first cycle is still that of [`hold`](Self::hold): start the trajectory at this set-point.
    ///
    /// # Errors
    ///
    /// Returns an error once if the drive leaves "Operation enabled" or the mode after it has followed the command
    /// values. Returns an error in each cycle in which the operation is enabled, the mode is active, and the drive
    /// reports a following error or the actual following error is above the limit.
    pub fn cycle<S: StateWord, W: StateWord>(
        &mut self,
        inputs: Inputs<S>,
        control: W,
        target: i32,
    ) -> Result<Cycle<W>, CycleError> {
        let status = inputs.status.bits() as u16;
        let state = State::from_raw(status);
        let control = W::from_bits(control.bits() & !u32::from(OF_MODE));
        let held = Cycle { control, target: self.hold(&inputs), is_following: false };
        let has_followed = core::mem::take(&mut self.has_followed);
        let was_following = core::mem::take(&mut self.is_following);
        if state != Some(State::OperationEnabled) {
            return match state {
                _ if !has_followed => Ok(held),
                Some(state) if state.is_fault() => Err(CycleError::Fault(state)),
                state => Err(CycleError::NotEnabled { state }),
            };
        }
        let active = inputs.mode.map_or(self.mode, Mode::from_raw);
        if active != self.mode {
            return if has_followed { Err(CycleError::WrongMode(active)) } else { Ok(held) };
        }
        self.check_following(status, inputs.following_error)?;
        if status & CONFIRMED == 0 {
            self.has_followed = has_followed;
            return Ok(held);
        }
        (self.has_followed, self.is_following) = (true, true);
        let target = if was_following { target } else { held.target };
        Ok(Cycle { target, is_following: true, ..held })
    }

    fn check_following(&self, status: u16, error: Option<i32>) -> Result<(), CycleError> {
        if self.mode == Mode::CyclicSynchronousPosition && status & FAILED != 0 {
            return Err(CycleError::FollowingError { error });
        }
        match (error, self.limit) {
            (Some(error), Some(limit)) if error.unsigned_abs() > limit => {
                Err(CycleError::LimitExceeded { error, limit })
            }
            _ => Ok(()),
        }
    }
}

impl fmt::Display for CycleError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Fault(state) => write!(f, "the drive has a fault: state \"{state}\""),
            Self::NotEnabled { state: Some(state) } => {
                write!(f, "the drive has left the state \"operation enabled\", and is in the state \"{state}\"")
            }
            Self::NotEnabled { state: None } => f.write_str("the statusword encodes no state"),
            Self::WrongMode(active) => {
                write!(f, "the drive has left the mode; the active mode is {}", Numbered(*active))
            }
            Self::FollowingError { error: Some(error) } => write!(f, "following error: {error}"),
            Self::FollowingError { error: None } => f.write_str("following error"),
            Self::LimitExceeded { error, limit } => {
                write!(f, "the following error {error} is above the limit {limit}")
            }
        }
    }
}

impl core::error::Error for CycleError {}

#[cfg(test)]
mod tests {
    use super::*;

    const ENABLED: u16 = 0x0237;
    const FOLLOWING: u16 = 0x1237;

    fn inputs(status: u16) -> Inputs<u16> {
        Inputs { status, mode: None, actual: 7, following_error: None }
    }

    /// Runs a cycle with the set-point 50.
    fn target(cyclic: &mut Cyclic, status: u16) -> Result<i32, CycleError> {
        cyclic.cycle(inputs(status), 0x000F_u16, 50).map(|cycle| cycle.target)
    }

    #[test]
    fn set_points_before_the_drive_follows() {
        let mut position = Cyclic::position();
        assert_eq!(
            [0, 0x40, 0x08, ENABLED, FOLLOWING, FOLLOWING].map(|status| target(&mut position, status)),
            [7, 7, 7, 7, 7, 50].map(Ok)
        );
        for mut cyclic in [Cyclic::velocity(), Cyclic::torque()] {
            let statuses = [0x40, ENABLED, FOLLOWING, FOLLOWING];
            assert_eq!(statuses.map(|status| target(&mut cyclic, status)), [0, 0, 0, 50].map(Ok));
        }
        // A drive that no longer follows, for example because of a local limit, holds its position.
        assert_eq!(target(&mut position, ENABLED), Ok(7));
        assert_eq!([FOLLOWING, FOLLOWING].map(|status| target(&mut position, status)), [7, 50].map(Ok));
    }

    #[test]
    fn set_points_after_an_error() {
        let mut cyclic = Cyclic::position();
        let targets = [FOLLOWING, FOLLOWING, 0x0218, 0x0218, FOLLOWING].map(|status| target(&mut cyclic, status).ok());
        assert_eq!(targets, [Some(7), Some(50), None, Some(7), Some(7)]);
    }

    #[test]
    fn a_drive_that_leaves_the_operation() {
        let after = |status| {
            let mut cyclic = Cyclic::position();
            target(&mut cyclic, FOLLOWING)?;
            target(&mut cyclic, status)
        };
        assert_eq!(after(0x021F), Err(CycleError::Fault(State::FaultReactionActive)));
        assert_eq!(after(0x0217), Err(CycleError::NotEnabled { state: Some(State::QuickStopActive) }));
        assert_eq!(after(0x002F & !1), Err(CycleError::NotEnabled { state: None }));
    }

    #[test]
    fn the_mode_of_the_drive() {
        let mut cyclic = Cyclic::velocity();
        let other = Inputs { mode: Some(1), ..inputs(FOLLOWING) };
        assert_eq!(cyclic.cycle(other, 0_u16, 50), Ok(Cycle { control: 0, target: 0, is_following: false }));
        let this = Inputs { mode: Some(9), ..other };
        assert_eq!(cyclic.cycle(this, 0_u16, 50), Ok(Cycle { control: 0, target: 0, is_following: true }));
        assert_eq!(cyclic.cycle(this, 0_u16, 50), Ok(Cycle { control: 0, target: 50, is_following: true }));
        assert_eq!(cyclic.cycle(other, 0_u16, 50), Err(CycleError::WrongMode(Mode::ProfilePosition)));
    }

    #[test]
    fn following_errors() {
        // Bit 13 is reserved in CSV.
        assert_eq!(target(&mut Cyclic::velocity(), FOLLOWING | FAILED), Ok(0));
        let error = Err(CycleError::FollowingError { error: None });
        assert_eq!(target(&mut Cyclic::position(), ENABLED | FAILED), error);
        let with = |error, limit| {
            let inputs = Inputs { following_error: Some(error), ..inputs(FOLLOWING) };
            Cyclic::position().with_limit(limit).cycle(inputs, 0_u16, 50).map(|cycle| cycle.target)
        };
        assert_eq!((with(-10, 10), with(10, 10)), (Ok(7), Ok(7)));
        assert_eq!(with(i32::MIN, 10), Err(CycleError::LimitExceeded { error: i32::MIN, limit: 10 }));
        assert_eq!(with(1, 0), Err(CycleError::LimitExceeded { error: 1, limit: 0 }));
    }

    #[test]
    fn only_the_bits_of_the_mode_change() {
        let cycle = Cyclic::torque().cycle(inputs(ENABLED), 0xFFFF_u16, 50);
        assert_eq!(cycle.map(|cycle| cycle.control), Ok(0xFD8F));
    }
}
