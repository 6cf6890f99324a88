== utf-8.eds
    /// Kühlung: 0x2000:00, UNSIGNED8, read-write.
    /// Accessor: [`kuehlung`](super::Pump::kuehlung).
    pub const KUEHLUNG: ReadWrite<u8> = ReadWriteU8::object(0x2000, 0x00, "Kühlung");
== windows-1252.eds
    /// Kühlung: 0x2000:00, UNSIGNED8, read-write.
    /// Accessor: [`kuehlung`](super::Pump::kuehlung).
    pub const KUEHLUNG: ReadWrite<u8> = ReadWriteU8::object(0x2000, 0x00, "Kühlung");
