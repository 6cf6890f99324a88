    /// Octal.
    ///
    /// 0x2000:00, UNSIGNED16, rw, default 10.
    /// Accessor: [`octal`](super::Pump::octal).
    pub const OCTAL: ReadWrite<u16> = ReadWriteU16::object_with_default(
        0x2000,
        0x00,
        "Octal",
        10,
    );
    /// Decimal.
    ///
    /// 0x2001:00, UNSIGNED16, rw, default 12.
    /// Accessor: [`decimal`](super::Pump::decimal).
    pub const DECIMAL: ReadWrite<u16> = ReadWriteU16::object_with_default(
        0x2001,
        0x00,
        "Decimal",
        12,
    );
    /// Hexadecimal.
    ///
    /// 0x2002:00, UNSIGNED16, rw, default 18.
    /// Accessor: [`hexadecimal`](super::Pump::hexadecimal).
    pub const HEXADECIMAL: ReadWrite<u16> = ReadWriteU16::object_with_default(
        0x2002,
        0x00,
        "Hexadecimal",
        18,
    );
    /// Zero.
    ///
    /// 0x2003:00, UNSIGNED16, rw, default 0.
    /// Accessor: [`zero`](super::Pump::zero).
    pub const ZERO: ReadWrite<u16> = ReadWriteU16::object_with_default(
        0x2003,
        0x00,
        "Zero",
        0,
    );
