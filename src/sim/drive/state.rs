//! States of a simulated drive, and the ramps on which an axis stops.

pub(super) use crate::cia402::State;

impl State {
    /// Returns the state that the controlword `word` commands, or `None` if the state doesn't change. `may_resume`
    /// allows the transition from "Quick stop active" to "Operation enabled". The fault reset isn't included, because
    /// it needs a rising edge.
    pub(super) fn after(self, word: u16, may_resume: bool) -> Option<Self> {
        let is = |mask: u16, value: u16| word & mask == value;
        let (shutdown, switch_on, enable) = (is(0x87, 0x06), is(0x8F, 0x07), is(0x8F, 0x0F));
        let (disable_voltage, quick_stop) = (is(0x82, 0x00), is(0x86, 0x02));
        match self {
            Self::SwitchOnDisabled if shutdown => Some(Self::ReadyToSwitchOn),
            // With the command "enable operation", the next step continues to "Operation enabled".
            Self::ReadyToSwitchOn if switch_on || enable => Some(Self::SwitchedOn),
            Self::SwitchedOn if enable => Some(Self::OperationEnabled),
            Self::SwitchedOn | Self::OperationEnabled if shutdown => Some(Self::ReadyToSwitchOn),
            Self::OperationEnabled if switch_on => Some(Self::SwitchedOn),
            Self::OperationEnabled if quick_stop => Some(Self::QuickStopActive),
            Self::QuickStopActive if enable && may_resume => Some(Self::OperationEnabled),
            Self::ReadyToSwitchOn | Self::SwitchedOn if quick_stop => Some(Self::SwitchOnDisabled),
            Self::ReadyToSwitchOn | Self::SwitchedOn | Self::OperationEnabled | Self::QuickStopActive => {
                disable_voltage.then_some(Self::SwitchOnDisabled)
            }
            _ => None,
        }
    }

    /// Returns the bits of the statusword for the state, including the bits "voltage enabled" and "remote".
    pub(super) const fn bits(self) -> u16 {
        match self {
            Self::NotReadyToSwitchOn => 0x0000,
            Self::SwitchOnDisabled => 0x0240,
            Self::ReadyToSwitchOn => 0x0231,
            Self::SwitchedOn => 0x0233,
            Self::OperationEnabled => 0x0237,
            Self::QuickStopActive => 0x0217,
            Self::FaultReactionActive => 0x021F,
            Self::Fault => 0x0208,
        }
    }
}

/// Ramp on which an axis stops.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Stop {
    /// The power stage is disabled. The axis decelerates with a quarter of the profile deceleration.
    Coast,
    /// The profile deceleration (0x6084), or the deceleration 0x6049 in the mode "velocity".
    Ramp,
    /// The quick-stop deceleration (0x6085), or the quick-stop deceleration 0x604A in the mode "velocity".
    QuickRamp,
}

impl Stop {
    /// Returns the ramp for the value of an option code (0x605A to 0x605E). Stops at the current or voltage limit use
    /// the quick-stop ramp.
    pub const fn of_option(option: i64) -> Self {
        match option {
            0 => Self::Coast,
            1 | 5 => Self::Ramp,
            _ => Self::QuickRamp,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::State::{OperationEnabled, QuickStopActive, ReadyToSwitchOn, SwitchOnDisabled, SwitchedOn};
    use super::*;

    #[test]
    fn transitions() {
        let rows = [
            (SwitchOnDisabled, 0x06, Some(ReadyToSwitchOn)),
            (SwitchOnDisabled, 0x0F, None),
            (SwitchOnDisabled, 0x86, None),
            (ReadyToSwitchOn, 0x07, Some(SwitchedOn)),
            (ReadyToSwitchOn, 0x02, Some(SwitchOnDisabled)),
            (ReadyToSwitchOn, 0x00, Some(SwitchOnDisabled)),
            (SwitchedOn, 0x0F, Some(OperationEnabled)),
            (SwitchedOn, 0x06, Some(ReadyToSwitchOn)),
            (SwitchedOn, 0x02, Some(SwitchOnDisabled)),
            (SwitchedOn, 0x00, Some(SwitchOnDisabled)),
            (OperationEnabled, 0x07, Some(SwitchedOn)),
            (OperationEnabled, 0x06, Some(ReadyToSwitchOn)),
            (OperationEnabled, 0x00, Some(SwitchOnDisabled)),
            (OperationEnabled, 0x02, Some(QuickStopActive)),
            (OperationEnabled, 0x0F, None),
            (QuickStopActive, 0x00, Some(SwitchOnDisabled)),
            (QuickStopActive, 0x0F, Some(OperationEnabled)),
            (QuickStopActive, 0x06, None),
            (State::NotReadyToSwitchOn, 0x06, None),
            (State::FaultReactionActive, 0x00, None),
            (State::Fault, 0x80, None),
        ];
        for (state, word, next) in rows {
            assert_eq!(state.after(word, true), next, "{state:?} 0x{word:02X}");
        }
        assert_eq!(QuickStopActive.after(0x0F, false), None);
    }
}
