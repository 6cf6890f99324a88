        const TRANSITIONS: &'static [rt::Transition<Command>] = &[
            rt::Transition::new(
                Self::NotReadyToSwitchOn as u8,
                Self::SwitchOnDisabled as u8,
                None,
            ),
            rt::Transition::new(
                Self::SwitchOnDisabled as u8,
                Self::ReadyToSwitchOn as u8,
                Some(Command::Shutdown),
            ),
            rt::Transition::new(
                Self::ReadyToSwitchOn as u8,
                Self::SwitchedOn as u8,
                Some(Command::SwitchOn),
            ),
            rt::Transition::new(
                Self::SwitchedOn as u8,
                Self::OperationEnabled as u8,
                Some(Command::EnableOperation),
            ),
            rt::Transition::new(
                Self::OperationEnabled as u8,
                Self::SwitchedOn as u8,
                Some(Command::DisableOperation),
            ),
            rt::Transition::new(
                Self::SwitchedOn as u8,
                Self::ReadyToSwitchOn as u8,
                Some(Command::Shutdown),
            ),
            rt::Transition::new(
                Self::ReadyToSwitchOn as u8,
                Self::SwitchOnDisabled as u8,
                Some(Command::DisableVoltage),
            ),
            rt::Transition::new(
                Self::OperationEnabled as u8,
                Self::ReadyToSwitchOn as u8,
                Some(Command::Shutdown),
            ),
            rt::Transition::new(
                Self::OperationEnabled as u8,
                Self::SwitchOnDisabled as u8,
                Some(Command::DisableVoltage),
            ),
            rt::Transition::new(
                Self::SwitchedOn as u8,
                Self::SwitchOnDisabled as u8,
                Some(Command::DisableVoltage),
            ),
            rt::Transition::new(
                Self::OperationEnabled as u8,
                Self::QuickStopActive as u8,
                Some(Command::QuickStop),
            ),
            rt::Transition::new(
                Self::QuickStopActive as u8,
                Self::SwitchOnDisabled as u8,
                Some(Command::DisableVoltage),
            ),
            rt::Transition::new(
                Self::FaultReactionActive as u8,
                Self::Fault as u8,
                None,
            ),
            rt::Transition::new(
                Self::Fault as u8,
                Self::SwitchOnDisabled as u8,
                Some(Command::FaultReset),
            ),
            rt::Transition::new(
                Self::QuickStopActive as u8,
                Self::OperationEnabled as u8,
                Some(Command::EnableOperation),
            ),
        ];
    /// faults.
    ///
    /// Faults of the axis.
    ///
    /// Manual, page 9.
    ///
    /// As a type: [`Faults`].
    pub static FAULTS: &[rt::codes::Code] = &[
        rt::codes::Code::new(0x1C98, 0x1C98, "cable", "", &[]),
    ];
        fn codes() -> &'static [rt::codes::Code] {
            FAULTS
        }
    /// States of drive, as [Statusword](super::objects::STATUSWORD) tells them.
    ///
    /// From CiA 402, 10.1.1.
    ///
    /// | State | Bits |
    /// |---|---|
    /// | [`NotReadyToSwitchOn`](Self::NotReadyToSwitchOn) | `xxxx xxxx x0xx 0000` |
    /// | [`SwitchOnDisabled`](Self::SwitchOnDisabled) | `xxxx xxxx x1xx 0000` |
    /// | [`ReadyToSwitchOn`](Self::ReadyToSwitchOn) | `xxxx xxxx x01x 0001` |
    /// | [`SwitchedOn`](Self::SwitchedOn) | `xxxx xxxx x01x 0011` |
    /// | [`OperationEnabled`](Self::OperationEnabled) | `xxxx xxxx x01x 0111` |
    /// | [`QuickStopActive`](Self::QuickStopActive) | `xxxx xxxx x00x 0111` |
    /// | [`FaultReactionActive`](Self::FaultReactionActive) | `xxxx xxxx x0xx 1111` |
    /// | [`Fault`](Self::Fault) | `xxxx xxxx x0xx 1000` |
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub enum State {
        /// not ready to switch on: `xxxx xxxx x0xx 0000`.
        NotReadyToSwitchOn,
        /// switch on disabled: `xxxx xxxx x1xx 0000`.
        SwitchOnDisabled,
        /// ready to switch on: `xxxx xxxx x01x 0001`.
        ReadyToSwitchOn,
        /// switched on: `xxxx xxxx x01x 0011`.
        SwitchedOn,
        /// operation enabled: `xxxx xxxx x01x 0111`.
        OperationEnabled,
        /// quick stop active: `xxxx xxxx x00x 0111`.
        QuickStopActive,
        /// fault reaction active: `xxxx xxxx x0xx 1111`.
        FaultReactionActive,
        /// fault: `xxxx xxxx x0xx 1000`.
        Fault,
    }
    /// Commands of drive, as [Controlword](super::objects::CONTROLWORD) takes them.
    ///
    /// From CiA 402, 10.1.1.
    ///
    /// | Command | Bits |
    /// |---|---|
    /// | [`Shutdown`](Self::Shutdown) | `xxxx xxxx 0xxx x110` |
    /// | [`SwitchOn`](Self::SwitchOn) | `xxxx xxxx 0xxx 0111` |
    /// | [`EnableOperation`](Self::EnableOperation) | `xxxx xxxx 0xxx 1111` |
    /// | [`DisableVoltage`](Self::DisableVoltage) | `xxxx xxxx 0xxx xx0x` |
    /// | [`QuickStop`](Self::QuickStop) | `xxxx xxxx 0xxx x01x` |
    /// | [`DisableOperation`](Self::DisableOperation) | `xxxx xxxx 0xxx 0111` |
    /// | [`FaultReset`](Self::FaultReset) | `xxxx xxxx 1xxx xxxx` |
    ///
    /// Transitions:
    ///
    /// | No. | From | To | By | Meaning |
    /// |---|---|---|---|---|
    /// | 1 | [`NotReadyToSwitchOn`](State::NotReadyToSwitchOn) | [`SwitchOnDisabled`](State::SwitchOnDisabled) | itself |  |
    /// | 2 | [`SwitchOnDisabled`](State::SwitchOnDisabled) | [`ReadyToSwitchOn`](State::ReadyToSwitchOn) | [`Shutdown`](Command::Shutdown) |  |
    /// | 3 | [`ReadyToSwitchOn`](State::ReadyToSwitchOn) | [`SwitchedOn`](State::SwitchedOn) | [`SwitchOn`](Command::SwitchOn) |  |
    /// | 4 | [`SwitchedOn`](State::SwitchedOn) | [`OperationEnabled`](State::OperationEnabled) | [`EnableOperation`](Command::EnableOperation) |  |
    /// | 5 | [`OperationEnabled`](State::OperationEnabled) | [`SwitchedOn`](State::SwitchedOn) | [`DisableOperation`](Command::DisableOperation) |  |
    /// | 6 | [`SwitchedOn`](State::SwitchedOn) | [`ReadyToSwitchOn`](State::ReadyToSwitchOn) | [`Shutdown`](Command::Shutdown) |  |
    /// | 7 | [`ReadyToSwitchOn`](State::ReadyToSwitchOn) | [`SwitchOnDisabled`](State::SwitchOnDisabled) | [`DisableVoltage`](Command::DisableVoltage) |  |
    /// | 8 | [`OperationEnabled`](State::OperationEnabled) | [`ReadyToSwitchOn`](State::ReadyToSwitchOn) | [`Shutdown`](Command::Shutdown) |  |
    /// | 9 | [`OperationEnabled`](State::OperationEnabled) | [`SwitchOnDisabled`](State::SwitchOnDisabled) | [`DisableVoltage`](Command::DisableVoltage) |  |
    /// | 10 | [`SwitchedOn`](State::SwitchedOn) | [`SwitchOnDisabled`](State::SwitchOnDisabled) | [`DisableVoltage`](Command::DisableVoltage) |  |
    /// | 11 | [`OperationEnabled`](State::OperationEnabled) | [`QuickStopActive`](State::QuickStopActive) | [`QuickStop`](Command::QuickStop) |  |
    /// | 12 | [`QuickStopActive`](State::QuickStopActive) | [`SwitchOnDisabled`](State::SwitchOnDisabled) | [`DisableVoltage`](Command::DisableVoltage) |  |
    /// | 14 | [`FaultReactionActive`](State::FaultReactionActive) | [`Fault`](State::Fault) | itself |  |
    /// | 15 | [`Fault`](State::Fault) | [`SwitchOnDisabled`](State::SwitchOnDisabled) | [`FaultReset`](Command::FaultReset) |  |
    /// | 16 | [`QuickStopActive`](State::QuickStopActive) | [`OperationEnabled`](State::OperationEnabled) | [`EnableOperation`](Command::EnableOperation) |  |
    /// | 13 | any state | [`FaultReactionActive`](State::FaultReactionActive) | itself | After a fault. |
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub enum Command {
        /// shutdown: `xxxx xxxx 0xxx x110`.
        Shutdown,
        /// switch on: `xxxx xxxx 0xxx 0111`.
        SwitchOn,
        /// enable operation: `xxxx xxxx 0xxx 1111`.
        EnableOperation,
        /// disable voltage: `xxxx xxxx 0xxx xx0x`.
        DisableVoltage,
        /// quick stop: `xxxx xxxx 0xxx x01x`.
        QuickStop,
        /// disable operation: `xxxx xxxx 0xxx 0111`.
        DisableOperation,
        /// fault reset: `xxxx xxxx 1xxx xxxx`.
        FaultReset,
    }
    /// A code of [`FAULTS`].
    ///
    /// | Code | Name |
    /// |---|---|
    /// | F7320 | [`Cable`](Self::Cable) |
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub enum Faults {
        /// F7320: cable. Manual, page 9.
        Cable,
        /// Any other number.
        Unknown(u16),
    }
