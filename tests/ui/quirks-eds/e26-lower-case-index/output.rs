    /// Speed: 0x200A:00, UNSIGNED8, read-write.
    /// Accessor: [`speed`](super::Pump::speed).
    pub const SPEED: ReadWrite<u8> = ReadWriteU8::object(0x200A, 0x00, "Speed");
