    /// Speed.
    ///
    /// 0x2000:00, UNSIGNED8, rw.
    /// Accessor: [`speed`](super::Pump::speed).
    pub const SPEED: ReadWrite<u8> = ReadWriteU8::object(0x2000, 0x00, "Speed");
