    /// Speed: 0x2000:00, UNSIGNED8, read-write.
    /// Accessor: [`speed`](super::Pump::speed).
    pub const SPEED: ReadWrite<u8> = ReadWriteU8::object(0x2000, 0x00, "Speed");
