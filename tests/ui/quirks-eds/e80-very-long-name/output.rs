    /// very very very very very very very very very very very very very very very very very very very very very very very very very very very very very very very very very very very very very very very very very very very very very very very very very very long: 0x2000:00, UNSIGNED32, read-write.
    /// Accessor: [`very_very_very_very_very_very_very_very_very`](super::Pump::very_very_very_very_very_very_very_very_very).
    pub const VERY_VERY_VERY_VERY_VERY_VERY_VERY_VERY_VERY: ReadWrite<u32> = ReadWriteU32::object(
        0x2000,
        0x00,
        "very very very very very very very very very very very very very very very very very very very very very very very very very very very very very very very very very very very very very very very very very very very very very very very very very very long",
    );
