    /// Both sides: Default \$NODEID+0x40000180, 0x2000:00, UNSIGNED32, read-write.
    /// Accessor: [`both_sides`](super::Pump::both_sides).
    pub const BOTH_SIDES: ReadWrite<u32> = ReadWriteU32::new(
        rt::OnCanOpen::canopen(0x2000, 0x00),
        "Both sides",
        rt::Range::Full,
        rt::Initial::NodeId(0x40000180),
        "",
        rt::Flags::NONE,
    );
    /// Left side: Default \$NODEID+0x200, 0x2001:00, UNSIGNED32, read-write.
    /// Accessor: [`left_side`](super::Pump::left_side).
    pub const LEFT_SIDE: ReadWrite<u32> = ReadWriteU32::new(
        rt::OnCanOpen::canopen(0x2001, 0x00),
        "Left side",
        rt::Range::Full,
        rt::Initial::NodeId(0x200),
        "",
        rt::Flags::NONE,
    );
