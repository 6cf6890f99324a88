    /// Octal: Default 10, 0x2000:00, UNSIGNED16, read-write.
    /// Accessor: [`octal`](super::Pump::octal).
    pub const OCTAL: ReadWrite<u16> = ReadWriteU16::object_with_default(
        0x2000,
        0x00,
        "Octal",
        10,
    );
    /// Decimal: Default 12, 0x2001:00, UNSIGNED16, read-write.
    /// Accessor: [`decimal`](super::Pump::decimal).
    pub const DECIMAL: ReadWrite<u16> = ReadWriteU16::object_with_default(
        0x2001,
        0x00,
        "Decimal",
        12,
    );
    /// Hexadecimal: Default 18, 0x2002:00, UNSIGNED16, read-write.
    /// Accessor: [`hexadecimal`](super::Pump::hexadecimal).
    pub const HEXADECIMAL: ReadWrite<u16> = ReadWriteU16::object_with_default(
        0x2002,
        0x00,
        "Hexadecimal",
        18,
    );
    /// Zero: Default 0, 0x2003:00, UNSIGNED16, read-write.
    /// Accessor: [`zero`](super::Pump::zero).
    pub const ZERO: ReadWrite<u16> = ReadWriteU16::object_with_default(
        0x2003,
        0x00,
        "Zero",
        0,
    );
