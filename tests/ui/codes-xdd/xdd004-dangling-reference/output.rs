    /// Speed: 0x2000:00, UNSIGNED16, read-write.
    /// Accessor: [`speed`](super::Pump::speed).
    pub const SPEED: ReadWrite<u16> = ReadWriteU16::object(0x2000, 0x00, "Speed");
    /// Gone: 0x2001:00, UNSIGNED8, read-write.
    /// Accessor: [`gone`](super::Pump::gone).
    pub const GONE: ReadWrite<u8> = ReadWriteU8::object(0x2001, 0x00, "Gone");
