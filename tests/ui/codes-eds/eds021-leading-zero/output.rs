    /// Digit 8: Default 18, 0x2000:00, UNSIGNED16, read-write.
    /// Accessor: [`digit_8`](super::Pump::digit_8).
    pub const DIGIT_8: ReadWrite<u16> = ReadWriteU16::object_with_default(
        0x2000,
        0x00,
        "Digit 8",
        18,
    );
    /// Same number: Default 7, 0x2001:00, UNSIGNED16, read-write.
    /// Accessor: [`same_number`](super::Pump::same_number).
    pub const SAME_NUMBER: ReadWrite<u16> = ReadWriteU16::object_with_default(
        0x2001,
        0x00,
        "Same number",
        7,
    );
    /// Zeros: Default 0, 0x2002:00, UNSIGNED16, read-write.
    /// Accessor: [`zeros`](super::Pump::zeros).
    pub const ZEROS: ReadWrite<u16> = ReadWriteU16::object_with_default(
        0x2002,
        0x00,
        "Zeros",
        0,
    );
