        const LAYOUT: &'static str = "Controlword switch_on:1 enable_voltage:2 !quick_stop:4 enable_operation:8 fault_reset:80 halt:100 manufacturer_specific:f800";
        const LAYOUT: &'static str = "Statusword ready_to_switch_on:1 switched_on:2 operation_enabled:4 fault:8 voltage_enabled:10 !quick_stop:20 switch_on_disabled:40 warning:80 manufacturer_specific_8:100 remote:200 target_reached:400 internal_limit_active:800 manufacturer_specific_14:c000";
        const LAYOUT: &'static str = "DigitalInputs negative_limit_switch:1 positive_limit_switch:2 home_switch:4 interlock:8 manufacturer_specific:ffff0000";
        /// All states with their names, in the order of the variants. The names are those of the description, with blanks instead of underscores.
        pub const NAMES: &'static [(Self, &'static str)] = &[
            (Self::NotReadyToSwitchOn, "not ready to switch on"),
            (Self::SwitchOnDisabled, "switch on disabled"),
            (Self::ReadyToSwitchOn, "ready to switch on"),
            (Self::SwitchedOn, "switched on"),
            (Self::OperationEnabled, "operation enabled"),
            (Self::QuickStopActive, "quick stop active"),
            (Self::FaultReactionActive, "fault reaction active"),
            (Self::Fault, "fault"),
        ];
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
            Self::NAMES[self as usize].1
        }
        /// All commands with their names, in the order of the variants. The names are those of the description, with blanks instead of underscores.
        pub const NAMES: &'static [(Self, &'static str)] = &[
            (Self::Shutdown, "shutdown"),
            (Self::SwitchOn, "switch on"),
            (Self::EnableOperation, "enable operation"),
            (Self::DisableVoltage, "disable voltage"),
            (Self::QuickStop, "quick stop"),
            (Self::DisableOperation, "disable operation"),
            (Self::FaultReset, "fault reset"),
        ];
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
