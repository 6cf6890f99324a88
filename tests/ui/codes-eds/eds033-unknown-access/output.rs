    /// Read: 0x2000:00, UNSIGNED8, read-only.
    /// Accessor: [`read`](super::Pump::read).
    pub const READ: ReadOnly<u8> = ReadOnlyU8::object(0x2000, 0x00, "Read");
    /// Write: 0x2001:00, UNSIGNED8, write-only.
    /// Accessor: [`write`](super::Pump::write).
    pub const WRITE: WriteOnly<u8> = WriteOnlyU8::object(0x2001, 0x00, "Write");
    /// Both: 0x2002:00, UNSIGNED8, read-only.
    /// Accessor: [`both`](super::Pump::both).
    pub const BOTH: ReadOnly<u8> = ReadOnlyU8::object(0x2002, 0x00, "Both");
    /// Upper case: 0x2003:00, UNSIGNED8, read-write.
    /// Accessor: [`upper_case`](super::Pump::upper_case).
    pub const UPPER_CASE: ReadWrite<u8> = ReadWriteU8::object(
        0x2003,
        0x00,
        "Upper case",
    );
