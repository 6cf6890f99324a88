    /// Speed: Range 5 to 65536, 0x2000:00, UNSIGNED16, read-write.
    /// Accessor: [`speed`](super::Pump::speed).
    pub const SPEED: ReadWrite<u16> = ReadWriteU16::new(
        rt::OnCanOpen::canopen(0x2000, 0x00),
        "Speed",
        rt::Range::From(5),
        rt::Initial::Unknown,
        "",
        rt::Flags::NONE,
    );
