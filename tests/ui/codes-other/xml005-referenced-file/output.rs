    /// Speed: 0x2000:00, UNSIGNED16, read-write.
    /// Accessor: [`speed`](super::Drive::speed).
    pub const SPEED: ReadWrite<u16> = ReadWriteU16::coe_object(0x2000, 0x00, "Speed");
