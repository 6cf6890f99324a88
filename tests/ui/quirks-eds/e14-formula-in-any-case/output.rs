    /// Lower case: Default \$NODEID+0x180, 0x2000:00, UNSIGNED32, read-write.
    /// Accessor: [`lower_case`](super::Pump::lower_case).
    pub const LOWER_CASE: ReadWrite<u32> = ReadWriteU32::new(
        rt::OnCanOpen::canopen(0x2000, 0x00),
        "Lower case",
        rt::Range::Full,
        rt::Initial::NodeId(0x180),
        "",
        rt::Flags::NONE,
    );
    /// Mixed case: Default \$NODEID+0x180, 0x2001:00, UNSIGNED32, read-write.
    /// Accessor: [`mixed_case`](super::Pump::mixed_case).
    pub const MIXED_CASE: ReadWrite<u32> = ReadWriteU32::new(
        rt::OnCanOpen::canopen(0x2001, 0x00),
        "Mixed case",
        rt::Range::Full,
        rt::Initial::NodeId(0x180),
        "",
        rt::Flags::NONE,
    );
