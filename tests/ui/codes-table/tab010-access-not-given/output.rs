    /// speed: Modbus 1 (holding; wire address 1; FC 3), UNSIGNED16, read-only.
    /// Accessor: [`speed`](super::Pump::speed).
    pub const SPEED: ReadOnly<u16> = ReadOnlyU16::register(
        rt::Register::holding(1),
        "speed",
        rt::Flags::NONE,
    );
    /// pressure: Modbus 2 (holding; wire address 2; FC 6/16), UNSIGNED16, write-only.
    /// Accessor: [`pressure`](super::Pump::pressure).
    pub const PRESSURE: WriteOnly<u16> = WriteOnlyU16::register(
        rt::Register::holding(2),
        "pressure",
        rt::Flags::NONE,
    );
