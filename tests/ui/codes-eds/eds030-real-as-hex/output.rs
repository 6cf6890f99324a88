    /// Number: Default 2, 0x2000:00, REAL32, read-write.
    /// Accessor: [`number`](super::Pump::number).
    #[allow(clippy::approx_constant)]
    pub const NUMBER: ReadWrite<f32> = ReadWriteF32::object_with_default(
        0x2000,
        0x00,
        "Number",
        2.0,
    );
    /// Bits: Default 1\.5, 0x2001:00, REAL32, read-write.
    /// Accessor: [`bits`](super::Pump::bits).
    #[allow(clippy::approx_constant)]
    pub const BITS: ReadWrite<f32> = ReadWriteF32::object_with_default(
        0x2001,
        0x00,
        "Bits",
        1.5,
    );
    /// Long number: Default 1069547520, 0x2002:00, REAL64, read-write.
    /// Accessor: [`long_number`](super::Pump::long_number).
    #[allow(clippy::approx_constant)]
    pub const LONG_NUMBER: ReadWrite<f64> = ReadWriteF64::object_with_default(
        0x2002,
        0x00,
        "Long number",
        1069547520.0,
    );
    /// Long bits: Default 1\.5, 0x2003:00, REAL64, read-write.
    /// Accessor: [`long_bits`](super::Pump::long_bits).
    #[allow(clippy::approx_constant)]
    pub const LONG_BITS: ReadWrite<f64> = ReadWriteF64::object_with_default(
        0x2003,
        0x00,
        "Long bits",
        1.5,
    );
