    /// Boolean.
    ///
    /// 0x2000:00, BOOLEAN, rw, default 2.
    /// Accessor: [`boolean`](super::Pump::boolean).
    pub const BOOLEAN: ReadWrite<bool> = ReadWriteBool::object(0x2000, 0x00, "Boolean");
    /// Default.
    ///
    /// 0x2001:00, UNSIGNED16, rw, default 0x10000.
    /// Accessor: [`default`](super::Pump::default).
    pub const DEFAULT: ReadWrite<u16> = ReadWriteU16::object(0x2001, 0x00, "Default");
    /// Limit.
    ///
    /// 0x2002:00, UNSIGNED16, rw, at most 65536.
    /// Accessor: [`limit`](super::Pump::limit).
    pub const LIMIT: ReadWrite<u16> = ReadWriteU16::object(0x2002, 0x00, "Limit");
    /// Below.
    ///
    /// 0x2003:00, INTEGER8, rw, at least \-129.
    /// Accessor: [`below`](super::Pump::below).
    pub const BELOW: ReadWrite<i8> = ReadWriteI8::object(0x2003, 0x00, "Below");
    /// Greatest.
    ///
    /// 0x2004:00, UNSIGNED16, rw, default 65535, at most 65535.
    /// Accessor: [`greatest`](super::Pump::greatest).
    pub const GREATEST: ReadWrite<u16> = ReadWriteU16::object_with_default(
        0x2004,
        0x00,
        "Greatest",
        65535,
    );
