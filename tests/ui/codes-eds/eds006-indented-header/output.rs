    /// Blank: 0x2000:00, UNSIGNED8, read-write.
    /// Accessor: [`blank`](super::Pump::blank).
    pub const BLANK: ReadWrite<u8> = ReadWriteU8::object(0x2000, 0x00, "Blank");
    /// Tab: 0x2001:00, UNSIGNED8, read-write.
    /// Accessor: [`tab`](super::Pump::tab).
    pub const TAB: ReadWrite<u8> = ReadWriteU8::object(0x2001, 0x00, "Tab");
