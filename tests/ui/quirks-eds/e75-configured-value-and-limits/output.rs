    /// Speed: Range 5 to 9, configured to 10, 0x2000:00, INTEGER16, read-write.
    /// Accessor: [`speed`](super::Pump::speed).
    pub const SPEED: ReadWrite<i16> = ReadWriteI16::new(
        rt::OnCanOpen::canopen(0x2000, 0x00),
        "Speed",
        rt::Range::Between(5, 9),
        rt::Initial::Unknown,
        "",
        rt::Flags::NONE,
    );
