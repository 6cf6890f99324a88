    /// Quoted: 0x2000:00, UNSIGNED8, read-write.
    /// Accessor: [`quoted`](super::Pump::quoted).
    pub const QUOTED: ReadWrite<u8> = ReadWriteU8::object(0x2000, 0x00, "Quoted");
    /// Inner "quotes" stay: 0x2001:00, UNSIGNED8, read-write.
    /// Accessor: [`inner_quotes_stay`](super::Pump::inner_quotes_stay).
    pub const INNER_QUOTES_STAY: ReadWrite<u8> = ReadWriteU8::object(
        0x2001,
        0x00,
        "Inner \"quotes\" stay",
    );
