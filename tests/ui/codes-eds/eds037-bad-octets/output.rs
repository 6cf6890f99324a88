    /// Odd: Default \`012\`, 0x2000:00, OCTET_STRING, read-write.
    /// Accessor: [`odd`](super::Pump::odd).
    pub const ODD: ReadWrite<rt::OctetString> = ReadWriteOctetString::object(
        0x2000,
        0x00,
        "Odd",
    );
    /// Letters: Default \`xyz\`, 0x2001:00, OCTET_STRING, read-write.
    /// Accessor: [`letters`](super::Pump::letters).
    pub const LETTERS: ReadWrite<rt::OctetString> = ReadWriteOctetString::object(
        0x2001,
        0x00,
        "Letters",
    );
    /// Pairs: Default 01021F, 0x2002:00, OCTET_STRING, read-write.
    /// Accessor: [`pairs`](super::Pump::pairs).
    pub const PAIRS: ReadWrite<rt::OctetString> = ReadWriteOctetString::new(
        rt::OnCanOpen::canopen(0x2002, 0x00),
        "Pairs",
        rt::Range::Full,
        rt::Initial::bytes(b"\x01\x02\x1f"),
        "",
        rt::Flags::NONE,
    );
