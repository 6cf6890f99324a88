    /// Speed: Modbus 0 (holding; wire address 0; FC 3/6/16), UNSIGNED16, read-write.
    /// Accessor: [`speed`](super::Press::speed).
    ///
    /// Speed of the slide.
    ///
    /// Chapter: Movement. Manual: PARAMETRI MOVIMENTO, Speed: Velocità.
    pub const SPEED: ReadWrite<u16> = ReadWriteU16::register(
        rt::Register::holding(0),
        "Speed",
        rt::Flags::NONE,
    );
    /// Mode: Modbus 1 (holding; wire address 1; FC 3/6/16), UNSIGNED16, read-write.
    /// Accessor: [`mode`](super::Press::mode).
    ///
    /// Mode of operation.
    ///
    /// Chapter: Movement. Manual: 3\.2 Modi; Allarmi, Mode.
    ///
    /// Note: 2 modes and 3 modes. Assumed: 3 modes (the table has 3 rows). Manual: 3\.2 Modi.
    pub const MODE: ReadWrite<u16> = ReadWriteU16::register(
        rt::Register::holding(1),
        "Mode",
        rt::Flags::NONE,
    );
    /// alarms.
    ///
    /// Alarms of the press.
    ///
    /// Manual: Allarmi.
    ///
    /// The codes have the type [`Alarms`].
    pub static ALARMS: &[rt::codes::Code] = &[
        rt::codes::Code::new(0x10, 0x10, "door open", "", &[]),
    ];
