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
        const FAULTS: &'static [u8] = &[
            Self::FaultReactionActive as u8,
            Self::Fault as u8,
        ];
        const ENERGIZED: &'static [u8] = &[Self::OperationEnabled as u8];
        fn name(self) -> &'static str {
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
    /// faults.
    ///
    /// Faults of the axis.
    ///
    /// Manual, page 9.
    ///
    /// The codes have the type [`Faults`].
    pub static FAULTS: &[rt::codes::Code] = &[
        rt::codes::Code::new(0x1C98, 0x1C98, "cable", "", &[]),
    ];
        fn codes() -> &'static [rt::codes::Code] {
            FAULTS
        }
