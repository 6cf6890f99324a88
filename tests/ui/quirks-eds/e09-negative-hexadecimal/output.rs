    /// Speed: Default -2000000000, 0x2000:00, INTEGER32, read-write.
    /// Accessor: [`speed`](super::Pump::speed).
    pub const SPEED: ReadWrite<i32> = ReadWriteI32::object_with_default(
        0x2000,
        0x00,
        "Speed",
        -2000000000,
    );
