    /// Prefix: 0x2000:00, UNSIGNED16, read-write.
    /// Accessor: [`prefix`](super::Pump::prefix).
    pub const PREFIX: ReadWrite<u16> = ReadWriteU16::object(0x2000, 0x00, "Prefix");
    /// Prefix of the index: 0x2001:00, UNSIGNED8, read-write.
    /// Accessor: [`prefix_of_the_index`](super::Pump::prefix_of_the_index).
    pub const PREFIX_OF_THE_INDEX: ReadWrite<u8> = ReadWriteU8::object(
        0x2001,
        0x00,
        "Prefix of the index",
    );
    /// Mapping: 0x2002:00, UNSIGNED8, read-write.
    /// Accessor: [`mapping`](super::Pump::mapping).
    pub const MAPPING: ReadWrite<u8> = ReadWriteU8::object(0x2002, 0x00, "Mapping");
