    /// Torque actual value: 1 LSB = 0.01 %, 0x6077:00, INTEGER16, read-only.
    /// Accessor: [`torque_actual_value`](super::Axis::torque_actual_value).
    ///
    /// Changed by an overlay: the data sheet has other values.
    ///
    /// Unit from overlay pump.overlay.toml:10.
    pub const TORQUE_ACTUAL_VALUE: ReadOnly<rt::Scaled<i16, 1, 100>> = ReadOnlyI16Times1Per100::new(
        rt::OnCanOpen::canopen(0x6077, 0x00),
        "Torque actual value",
        rt::Range::Full,
        rt::Initial::Unknown,
        "%",
        rt::Flags::NONE,
    );
    /// Ramp: Unit ms, range 1 to 200, default 10, 0x2000:00, UNSIGNED16, read-write.
    /// Accessor: [`ramp`](super::Axis::ramp).
    ///
    /// Changed by an overlay: the data sheet has other values.
    ///
    /// Default and range from overlay pump.overlay.toml:9 instead of the description.
    ///
    /// Unit from overlay pump.overlay.toml:9.
    pub const RAMP: ReadWrite<u16> = ReadWriteU16::new(
        rt::OnCanOpen::canopen(0x2000, 0x00),
        "Ramp",
        rt::Range::Between(1, 200),
        rt::Initial::Value(10),
        "ms",
        rt::Flags::NONE,
    );
    /// Pump mode: 0x7000:00, UNSIGNED8, read-write.
    /// Accessor: [`pump_mode`](super::Axis::pump_mode). Value type: [`PumpMode`](super::types::PumpMode).
    ///
    /// Changed by an overlay: the data sheet has other values.
    ///
    /// Bits and values from overlay pump.overlay.toml:11.
    pub const PUMP_MODE: ReadWrite<super::types::PumpMode> = ReadWriteNamedPumpMode::object(
        0x7000,
        0x00,
        "Pump mode",
    );
    /// PumpMode.
    ///
    /// Definition from overlay pump.overlay.toml:13.
    ///
    /// Value type of [`PUMP_MODE`](super::objects::PUMP_MODE).
    ///
    /// | Value | Name |
    /// |---|---|
    /// | 0 | [`Off`](Self::Off) |
    /// | 1 | [`On`](Self::On) |
    #[derive(Clone, Copy, Debug)]
    pub enum PumpMode {
        /// 0: off.
        Off,
        /// 1: on.
        On,
        /// A number that no other variant represents.
        Unknown(u8),
    }
