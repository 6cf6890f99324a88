//! Errors of drive operations.

use core::fmt;

use super::{Mode, State};
use crate::access_error::AccessError;
use crate::error::Error;

/// Reason why an operation of a [`Drive`](super::Drive) failed. `E` is the error type of the client.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum MotionError<E> {
    /// An access to an object failed. The drive may still execute a command that it has received.
    Access(AccessError<E>),
    /// The client failed to wait between two accesses.
    Wait(Error<E>),
    /// The drive has a fault.
    Fault {
        /// State of the drive: [`State::FaultReactionActive`] or [`State::Fault`].
        state: State,
        /// Error code of the drive (0x603F, or 0x1003:01 without the additional information), if it can be read.
        code: Option<u16>,
    },
    /// The drive isn't in the state [`State::OperationEnabled`], or has left this state. No operation enables a drive:
    /// use the generated method `walk`.
    NotEnabled {
        /// State of the drive, or `None` if the statusword encodes no state.
        state: Option<State>,
        /// Statusword of the drive.
        status: u16,
    },
    /// The "halt" bit of the controlword is 1, so the axis wouldn't move.
    Halted,
    /// The operation is enabled, but the controlword isn't "enable operation": the drive takes its commands from another
    /// source, such as terminals or process data. A write of the controlword would disable the drive.
    OtherSource {
        /// Controlword (0x6040).
        control: u16,
    },
    /// The operation isn't possible in the active mode.
    WrongMode {
        /// Active mode (0x6061).
        active: Mode,
    },
    /// The drive hasn't activated the requested mode before the deadline. A drive that doesn't support a mode usually
    /// keeps the active mode.
    ModeNotConfirmed {
        /// Requested mode.
        requested: Mode,
        /// Active mode (0x6061).
        active: Mode,
    },
    /// The drive reports a homing error: bit 13 of the statusword in homing mode.
    Homing,
    /// The drive reports a following error: bit 13 of the statusword in profile position mode.
    FollowingError {
        /// Raw value of the actual following error (0x60F4), if it can be read.
        error: Option<i64>,
    },
    /// The drive reports that the maximum slippage is exceeded: bit 13 of the statusword in profile velocity mode.
    Slippage,
    /// The operation hasn't ended before the deadline.
    Deadline {
        /// Statusword of the drive.
        status: u16,
    },
}

impl<E> MotionError<E> {
    /// Returns true for [`Fault`](Self::Fault).
    pub const fn is_fault(&self) -> bool {
        matches!(self, Self::Fault { .. })
    }
}

impl<E> From<AccessError<E>> for MotionError<E> {
    fn from(error: AccessError<E>) -> Self {
        Self::Access(error)
    }
}

impl<E: fmt::Display> fmt::Display for MotionError<E> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Access(error) => error.fmt(f),
            Self::Wait(error) => error.fmt(f),
            Self::Fault { state, code } => {
                write!(f, "the drive has a fault: state \"{state}\"")?;
                code.map_or(Ok(()), |code| write!(f, ", error code 0x{code:04X}"))
            }
            Self::NotEnabled { state: Some(state), .. } => {
                write!(f, "the operation is not enabled: the drive is in the state \"{state}\"")
            }
            Self::NotEnabled { state: None, status } => {
                write!(f, "the operation is not enabled: the statusword 0x{status:04X} encodes no state")
            }
            Self::Halted => f.write_str("the bit \"halt\" of the controlword is 1"),
            Self::OtherSource { control } => {
                write!(
                    f,
                    "the controlword 0x{control:04X} doesn't enable the operation: another source commands the drive"
                )
            }
            Self::WrongMode { active } => {
                write!(f, "the operation is not possible in the active mode {}", Numbered(*active))
            }
            Self::ModeNotConfirmed { requested, active } => {
                let (requested, active) = (Numbered(*requested), Numbered(*active));
                write!(f, "timeout: the drive has not activated the mode {requested}; the active mode is {active}")
            }
            Self::Homing => f.write_str("homing error"),
            Self::FollowingError { error } => {
                f.write_str("following error")?;
                error.map_or(Ok(()), |error| write!(f, ": {error}"))
            }
            Self::Slippage => f.write_str("the maximum slippage is exceeded"),
            Self::Deadline { status } => {
                write!(f, "timeout: the operation has not ended; the statusword is 0x{status:04X}")
            }
        }
    }
}

impl<E: core::error::Error> core::error::Error for MotionError<E> {
    fn source(&self) -> Option<&(dyn core::error::Error + 'static)> {
        match self {
            Self::Access(error) => error.source(),
            Self::Wait(error) => error.source(),
            _ => None,
        }
    }
}

/// A mode that is shown with its number: `6 (homing)`. A mode without a name is shown as a number.
pub(super) struct Numbered(pub Mode);

impl fmt::Display for Numbered {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self(mode) = self;
        match mode {
            Mode::Unknown(number) => number.fmt(f),
            named => write!(f, "{} ({named})", named.raw()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::string::ToString;

    #[test]
    fn messages() {
        type Motion = MotionError<crate::TextError>;
        let text = |error: Motion| error.to_string();
        let fault = Motion::Fault { state: State::Fault, code: Some(0x8611) };
        assert!(fault.is_fault());
        assert_eq!(text(fault), "the drive has a fault: state \"fault\", error code 0x8611");
        let disabled = Motion::NotEnabled { state: Some(State::SwitchedOn), status: 0x33 };
        assert_eq!(text(disabled), "the operation is not enabled: the drive is in the state \"switched on\"");
        let refused = Motion::ModeNotConfirmed { requested: Mode::Homing, active: Mode::Unknown(-3) };
        assert_eq!(text(refused), "timeout: the drive has not activated the mode 6 (homing); the active mode is -3");
        assert_eq!(text(Motion::FollowingError { error: Some(-7) }), "following error: -7");
    }
}
