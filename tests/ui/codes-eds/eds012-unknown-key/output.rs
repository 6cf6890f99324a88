    /// Speed: At most 100, 0x2000:00, UNSIGNED8, read-write.
    /// Accessor: [`speed`](super::Pump::speed).
    pub const SPEED: ReadWrite<u8> = ReadWriteU8::new(
        rt::OnCanOpen::canopen(0x2000, 0x00),
        "Speed",
        rt::Range::To(100),
        rt::Initial::Unknown,
        "",
        rt::Flags::NONE,
    );
