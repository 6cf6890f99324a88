== lines.eds
    /// Speed \#2: 0x2000:00, UNSIGNED8, read-write.
    /// Accessor: [`speed_2`](super::Pump::speed_2).
    pub const SPEED_2: ReadWrite<u8> = ReadWriteU8::object(0x2000, 0x00, "Speed #2");
== values.eds
    /// Speed \#2: Default 5, 0x2000:00, UNSIGNED8, read-write.
    /// Accessor: [`speed_2`](super::Pump::speed_2).
    pub const SPEED_2: ReadWrite<u8> = ReadWriteU8::object_with_default(
        0x2000,
        0x00,
        "Speed #2",
        5,
    );
