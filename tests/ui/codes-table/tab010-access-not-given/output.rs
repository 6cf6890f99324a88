    /// speed.
    ///
    /// Holding register 1, UNSIGNED16, ro.
    /// Accessor: [`speed`](super::Pump::speed).
    pub const SPEED: ReadOnly<u16> = ReadOnlyU16::register(
        rt::Register::holding(1),
        "speed",
        rt::Flags::NONE,
    );
    /// pressure.
    ///
    /// Holding register 2, UNSIGNED16, wo.
    /// Accessor: [`pressure`](super::Pump::pressure).
    pub const PRESSURE: WriteOnly<u16> = WriteOnlyU16::register(
        rt::Register::holding(2),
        "pressure",
        rt::Flags::NONE,
    );
