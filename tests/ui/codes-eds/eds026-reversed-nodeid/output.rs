    /// Reversed: Default \$NODEID+0x80, 0x2000:00, UNSIGNED32, read-write.
    /// Accessor: [`reversed`](super::Pump::reversed).
    pub const REVERSED: ReadWrite<u32> = ReadWriteU32::new(
        rt::OnCanOpen::canopen(0x2000, 0x00),
        "Reversed",
        rt::Range::Full,
        rt::Initial::NodeId(0x80),
        "",
        rt::Flags::NONE,
    );
    /// Formula: Default \$NODEID+0x80, 0x2001:00, UNSIGNED32, read-write.
    /// Accessor: [`formula`](super::Pump::formula).
    pub const FORMULA: ReadWrite<u32> = ReadWriteU32::new(
        rt::OnCanOpen::canopen(0x2001, 0x00),
        "Formula",
        rt::Range::Full,
        rt::Initial::NodeId(0x80),
        "",
        rt::Flags::NONE,
    );
