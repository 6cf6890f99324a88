    /// Type 20: 0x2000:00, type 0x0020, read-write.
    /// Accessor: [`type_20`](super::Pump::type_20).
    pub const TYPE_20: ReadWrite<rt::Opaque> = ReadWriteOpaque::object(
        0x2000,
        0x00,
        "Type 20",
    );
    /// Type 0E: 0x2004:00, type 0x000E, read-write.
    /// Accessor: [`type_0_e`](super::Pump::type_0_e).
    pub const TYPE_0_E: ReadWrite<rt::Opaque> = ReadWriteOpaque::object(
        0x2004,
        0x00,
        "Type 0E",
    );
