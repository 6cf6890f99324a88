    /// Semicolon: 0x2000:00, UNSIGNED8, read-write.
    /// Accessor: [`semicolon`](super::Pump::semicolon).
    pub const SEMICOLON: ReadWrite<u8> = ReadWriteU8::object(0x2000, 0x00, "Semicolon");
    /// Suffix of C: Default 50, 0x2001:00, UNSIGNED8, read-write.
    /// Accessor: [`suffix_of_c`](super::Pump::suffix_of_c).
    pub const SUFFIX_OF_C: ReadWrite<u8> = ReadWriteU8::object_with_default(
        0x2001,
        0x00,
        "Suffix of C",
        50,
    );
    /// Comment: Default 50, 0x2002:00, UNSIGNED8, read-write.
    /// Accessor: [`comment`](super::Pump::comment).
    pub const COMMENT: ReadWrite<u8> = ReadWriteU8::object_with_default(
        0x2002,
        0x00,
        "Comment",
        50,
    );
