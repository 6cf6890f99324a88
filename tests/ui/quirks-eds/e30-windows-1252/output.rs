== byte-order-mark.eds
    /// Gerät: Default "5 €", 0x2000:00, VISIBLE_STRING, read-write.
    /// Accessor: [`geraet`](super::Pump::geraet).
    pub const GERAET: ReadWrite<rt::VisibleString> = ReadWriteVisibleString::object_with_default(
        0x2000,
        0x00,
        "Gerät",
        "5 €",
    );
== input.eds
    /// Gerät: Default "5 €", 0x2000:00, VISIBLE_STRING, read-write.
    /// Accessor: [`geraet`](super::Pump::geraet).
    pub const GERAET: ReadWrite<rt::VisibleString> = ReadWriteVisibleString::object_with_default(
        0x2000,
        0x00,
        "Gerät",
        "5 €",
    );
