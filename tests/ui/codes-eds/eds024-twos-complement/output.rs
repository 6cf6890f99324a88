    /// Bits: Default -32768, 0x2000:00, INTEGER16, read-write.
    /// Accessor: [`bits`](super::Pump::bits).
    pub const BITS: ReadWrite<i16> = ReadWriteI16::object_with_default(
        0x2000,
        0x00,
        "Bits",
        -32768,
    );
    /// Minus one: Default -1, 0x2001:00, INTEGER32, read-write.
    /// Accessor: [`minus_one`](super::Pump::minus_one).
    pub const MINUS_ONE: ReadWrite<i32> = ReadWriteI32::object_with_default(
        0x2001,
        0x00,
        "Minus one",
        -1,
    );
    /// Negative: Default -32768, 0x2002:00, INTEGER16, read-write.
    /// Accessor: [`negative`](super::Pump::negative).
    pub const NEGATIVE: ReadWrite<i16> = ReadWriteI16::object_with_default(
        0x2002,
        0x00,
        "Negative",
        -32768,
    );
    /// Positive: Default 32767, 0x2003:00, INTEGER16, read-write.
    /// Accessor: [`positive`](super::Pump::positive).
    pub const POSITIVE: ReadWrite<i16> = ReadWriteI16::object_with_default(
        0x2003,
        0x00,
        "Positive",
        32767,
    );
