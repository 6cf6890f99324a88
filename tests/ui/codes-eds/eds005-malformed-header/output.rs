    /// Unclosed: 0x2000:00, UNSIGNED8, read-write.
    /// Accessor: [`unclosed`](super::Pump::unclosed).
    pub const UNCLOSED: ReadWrite<u8> = ReadWriteU8::object(0x2000, 0x00, "Unclosed");
    /// Followed: 0x2001:00, UNSIGNED8, read-write.
    /// Accessor: [`followed`](super::Pump::followed).
    pub const FOLLOWED: ReadWrite<u8> = ReadWriteU8::object(0x2001, 0x00, "Followed");
    /// Commented: 0x2002:00, UNSIGNED8, read-write.
    /// Accessor: [`commented`](super::Pump::commented).
    pub const COMMENTED: ReadWrite<u8> = ReadWriteU8::object(0x2002, 0x00, "Commented");
