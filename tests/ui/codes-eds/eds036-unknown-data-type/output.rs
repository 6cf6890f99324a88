    /// Unknown: 0x2000:00, type 0x0024, read-write.
    /// Accessor: [`unknown`](super::Pump::unknown).
    pub const UNKNOWN: ReadWrite<rt::Opaque> = ReadWriteOpaque::object(
        0x2000,
        0x00,
        "Unknown",
    );
    /// Own: 0x2001:00, UNSIGNED16, read-write.
    /// Accessor: [`own`](super::Pump::own).
    pub const OWN: ReadWrite<u16> = ReadWriteU16::object(0x2001, 0x00, "Own");
