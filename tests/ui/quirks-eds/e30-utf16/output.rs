    /// Gerät: 0x2000:00, UNSIGNED8, read-write.
    /// Accessor: [`geraet`](super::Pump::geraet).
    pub const GERAET: ReadWrite<u8> = ReadWriteU8::object(0x2000, 0x00, "Gerät");
