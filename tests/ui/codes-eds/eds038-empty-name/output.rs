    /// 0x2000:00, UNSIGNED8, read-write.
    /// Accessor: [`object_2000`](super::Pump::object_2000).
    pub const OBJECT_2000: ReadWrite<u8> = ReadWriteU8::object(0x2000, 0x00, "");
    /// 0x2001:00, UNSIGNED8, read-write.
    /// Accessor: [`object_2001`](super::Pump::object_2001).
    pub const OBJECT_2001: ReadWrite<u8> = ReadWriteU8::object(0x2001, 0x00, "");
