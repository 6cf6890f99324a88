    /// Boolean: Default 2, 0x2000:00, BOOLEAN, read-write.
    /// Accessor: [`boolean`](super::Pump::boolean).
    pub const BOOLEAN: ReadWrite<bool> = ReadWriteBool::object(0x2000, 0x00, "Boolean");
    /// Default: Default 0x10000, 0x2001:00, UNSIGNED16, read-write.
    /// Accessor: [`default`](super::Pump::default).
    pub const DEFAULT: ReadWrite<u16> = ReadWriteU16::object(0x2001, 0x00, "Default");
    /// Limit: At most 65536, 0x2002:00, UNSIGNED16, read-write.
    /// Accessor: [`limit`](super::Pump::limit).
    pub const LIMIT: ReadWrite<u16> = ReadWriteU16::object(0x2002, 0x00, "Limit");
    /// Below: At least \-129, 0x2003:00, INTEGER8, read-write.
    /// Accessor: [`below`](super::Pump::below).
    pub const BELOW: ReadWrite<i8> = ReadWriteI8::object(0x2003, 0x00, "Below");
    /// Greatest: At most 65535, default 65535, 0x2004:00, UNSIGNED16, read-write.
    /// Accessor: [`greatest`](super::Pump::greatest).
    pub const GREATEST: ReadWrite<u16> = ReadWriteU16::object_with_default(
        0x2004,
        0x00,
        "Greatest",
        65535,
    );
