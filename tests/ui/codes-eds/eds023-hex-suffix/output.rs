    /// Suffix: Default 31, 0x2000:00, UNSIGNED8, read-write.
    /// Accessor: [`suffix`](super::Pump::suffix).
    pub const SUFFIX: ReadWrite<u8> = ReadWriteU8::object_with_default(
        0x2000,
        0x00,
        "Suffix",
        31,
    );
    /// Prefix: Default 31, 0x2001:00, UNSIGNED8, read-write.
    /// Accessor: [`prefix`](super::Pump::prefix).
    pub const PREFIX: ReadWrite<u8> = ReadWriteU8::object_with_default(
        0x2001,
        0x00,
        "Prefix",
        31,
    );
