    /// Speed: At most 102, 0x2000:00, UNSIGNED8, read-write.
    /// Accessor: [`speed`](super::Pump::speed).
    pub const SPEED: ReadWrite<u8> = ReadWriteU8::new(
        rt::OnCanOpen::canopen(0x2000, 0x00),
        "Speed",
        rt::Range::To(102),
        rt::Initial::Unknown,
        "",
        rt::Flags::NONE,
    );
