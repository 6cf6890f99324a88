    /// Speed: Default 26, 0x2000:00, UNSIGNED16, read-write.
    /// Accessor: [`speed`](super::Pump::speed).
    pub const SPEED: ReadWrite<u16> = ReadWriteU16::object_with_default(
        0x2000,
        0x00,
        "Speed",
        26,
    );
