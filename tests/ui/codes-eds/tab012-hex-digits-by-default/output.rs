    /// Eight digits: At most 100, 0x2000:00, UNSIGNED16, read-write.
    /// Accessor: [`eight_digits`](super::Pump::eight_digits).
    pub const EIGHT_DIGITS: ReadWrite<u16> = ReadWriteU16::new(
        rt::OnCanOpen::canopen(0x2000, 0x00),
        "Eight digits",
        rt::Range::To(100),
        rt::Initial::Unknown,
        "",
        rt::Flags::NONE,
    );
