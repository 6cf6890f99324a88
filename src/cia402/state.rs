//! States and modes of a CiA 402 drive.

use core::fmt;

use crate::enumeration::Enumeration;

/// State of the drive state machine (CiA 402-2 10.1.1).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum State {
    /// The drive starts.
    NotReadyToSwitchOn,
    /// The drive is ready for commands. The power stage is disabled.
    SwitchOnDisabled,
    /// The power stage can be switched on.
    ReadyToSwitchOn,
    /// The power stage is ready. The motor has no torque.
    SwitchedOn,
    /// The drive controls the motor.
    OperationEnabled,
    /// The drive stops because of the command "quick stop", or has stopped.
    QuickStopActive,
    /// A fault has occurred, and the drive stops.
    FaultReactionActive,
    /// A fault has occurred, and the power stage is disabled.
    Fault,
}

impl State {
    /// Returns the state that a statusword (0x6041) encodes, or `None` if it encodes no state (CiA 402-2 10.3.2).
    #[must_use]
    pub const fn of_status(status: u16) -> Option<Self> {
        Some(match (status & 0x4F, status & 0x20) {
            (0x00, _) => Self::NotReadyToSwitchOn,
            (0x40, _) => Self::SwitchOnDisabled,
            (0x01, 0x20) => Self::ReadyToSwitchOn,
            (0x03, 0x20) => Self::SwitchedOn,
            (0x07, 0x20) => Self::OperationEnabled,
            (0x07, _) => Self::QuickStopActive,
            (0x0F, _) => Self::FaultReactionActive,
            (0x08, _) => Self::Fault,
            _ => return None,
        })
    }

    /// Returns true for [`FaultReactionActive`](Self::FaultReactionActive) and [`Fault`](Self::Fault).
    #[must_use]
    pub const fn is_fault(self) -> bool {
        matches!(self, Self::FaultReactionActive | Self::Fault)
    }

    const fn name(self) -> &'static str {
        match self {
            Self::NotReadyToSwitchOn => "not ready to switch on",
            Self::SwitchOnDisabled => "switch on disabled",
            Self::ReadyToSwitchOn => "ready to switch on",
            Self::SwitchedOn => "switched on",
            Self::OperationEnabled => "operation enabled",
            Self::QuickStopActive => "quick stop active",
            Self::FaultReactionActive => "fault reaction active",
            Self::Fault => "fault",
        }
    }
}

impl fmt::Display for State {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// Mode of operation (CiA 402-2 10.3.8). [`Drive::set_mode`](super::Drive::set_mode) also accepts the generated
/// enumeration of a device, and an `i8`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Mode {
    /// 0: no mode.
    NoMode,
    /// 1: profile position (CiA 402-2 12).
    ProfilePosition,
    /// 2: velocity, for frequency converters.
    Velocity,
    /// 3: profile velocity (CiA 402-2 16).
    ProfileVelocity,
    /// 4: profile torque (CiA 402-2 17).
    ProfileTorque,
    /// 6: homing (CiA 402-2 13).
    Homing,
    /// 7: interpolated position (CiA 402-2 15).
    InterpolatedPosition,
    /// 8: cyclic synchronous position (CSP).
    CyclicSynchronousPosition,
    /// 9: cyclic synchronous velocity (CSV).
    CyclicSynchronousVelocity,
    /// 10: cyclic synchronous torque (CST).
    CyclicSynchronousTorque,
    /// 11: cyclic synchronous torque with commutation angle (CSTCA).
    CyclicSynchronousTorqueWithAngle,
    /// A manufacturer-specific mode (negative), or a reserved mode.
    Other(i8),
}

const MODES: [(Mode, i8, &str); 11] = [
    (Mode::NoMode, 0, "no mode"),
    (Mode::ProfilePosition, 1, "profile position"),
    (Mode::Velocity, 2, "velocity"),
    (Mode::ProfileVelocity, 3, "profile velocity"),
    (Mode::ProfileTorque, 4, "profile torque"),
    (Mode::Homing, 6, "homing"),
    (Mode::InterpolatedPosition, 7, "interpolated position"),
    (Mode::CyclicSynchronousPosition, 8, "cyclic synchronous position"),
    (Mode::CyclicSynchronousVelocity, 9, "cyclic synchronous velocity"),
    (Mode::CyclicSynchronousTorque, 10, "cyclic synchronous torque"),
    (Mode::CyclicSynchronousTorqueWithAngle, 11, "cyclic synchronous torque with commutation angle"),
];

impl Enumeration for Mode {
    type Base = i8;

    fn from_native(native: i8) -> Self {
        MODES.iter().find(|(_, number, _)| *number == native).map_or(Self::Other(native), |(mode, ..)| *mode)
    }

    fn native(self) -> i8 {
        match self {
            Self::Other(number) => number,
            mode => MODES.iter().find(|(one, ..)| *one == mode).map_or(0, |(_, number, _)| *number),
        }
    }
}

impl fmt::Display for Mode {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match MODES.iter().find(|(mode, ..)| mode == self) {
            Some((_, number, name)) => write!(f, "{number} ({name})"),
            None => self.native().fmt(f),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::string::ToString;

    #[test]
    fn states_of_all_statuswords() {
        // The patterns of CiA 402-2 10.3.2: mask, value and state.
        let patterns = [
            (0x4F, 0x00, State::NotReadyToSwitchOn),
            (0x4F, 0x40, State::SwitchOnDisabled),
            (0x6F, 0x21, State::ReadyToSwitchOn),
            (0x6F, 0x23, State::SwitchedOn),
            (0x6F, 0x27, State::OperationEnabled),
            (0x6F, 0x07, State::QuickStopActive),
            (0x4F, 0x0F, State::FaultReactionActive),
            (0x4F, 0x08, State::Fault),
        ];
        for status in 0..=u16::MAX {
            let expected = patterns.iter().find(|(mask, value, _)| status & mask == *value).map(|(.., state)| *state);
            assert_eq!(State::of_status(status), expected, "0x{status:04X}");
        }
    }

    #[test]
    fn every_number_is_a_mode() {
        for number in i8::MIN..=i8::MAX {
            assert_eq!(Mode::from_native(number).native(), number);
        }
        assert_eq!(Mode::from_native(6), Mode::Homing);
        assert_eq!(Mode::from_native(-3), Mode::Other(-3));
        assert_eq!((Mode::Homing.to_string(), Mode::Other(-3).to_string()), ("6 (homing)".into(), "-3".into()));
    }
}
