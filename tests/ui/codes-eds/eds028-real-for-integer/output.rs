    /// Zero: Default 20, 0x2000:00, UNSIGNED32, read-write.
    /// Accessor: [`zero`](super::Pump::zero).
    pub const ZERO: ReadWrite<u32> = ReadWriteU32::object_with_default(
        0x2000,
        0x00,
        "Zero",
        20,
    );
    /// Half: Default \`20.5\`, 0x2001:00, UNSIGNED32, read-write.
    /// Accessor: [`half`](super::Pump::half).
    pub const HALF: ReadWrite<u32> = ReadWriteU32::object(0x2001, 0x00, "Half");
    /// Real: Default 20\.5, 0x2002:00, REAL32, read-write.
    /// Accessor: [`real`](super::Pump::real).
    #[allow(clippy::approx_constant)]
    pub const REAL: ReadWrite<f32> = ReadWriteF32::object_with_default(
        0x2002,
        0x00,
        "Real",
        20.5,
    );
