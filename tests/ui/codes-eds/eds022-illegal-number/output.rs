    /// Word: Default \`fifty\`, 0x2000:00, UNSIGNED8, read-write.
    /// Accessor: [`word`](super::Pump::word).
    pub const WORD: ReadWrite<u8> = ReadWriteU8::object(0x2000, 0x00, "Word");
    /// Number: Default 50, 0x2001:00, UNSIGNED8, read-write.
    /// Accessor: [`number`](super::Pump::number).
    pub const NUMBER: ReadWrite<u8> = ReadWriteU8::object_with_default(
        0x2001,
        0x00,
        "Number",
        50,
    );
