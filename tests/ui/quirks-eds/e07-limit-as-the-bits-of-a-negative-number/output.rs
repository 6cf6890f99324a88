    /// Speed: Range \-2147483648 to 2147483647, 0x2000:00, INTEGER32, read-write.
    /// Accessor: [`speed`](super::Pump::speed).
    pub const SPEED: ReadWrite<i32> = ReadWriteI32::object(0x2000, 0x00, "Speed");
