    /// COB-ID: Default \$NODEID+0x200, 0x2000:00, UNSIGNED32, read-write.
    /// Accessor: [`cob_id`](super::Pump::cob_id).
    pub const COB_ID: ReadWrite<u32> = ReadWriteU32::new(
        rt::OnCanOpen::canopen(0x2000, 0x00),
        "COB-ID",
        rt::Range::Full,
        rt::Initial::NodeId(0x200),
        "",
        rt::Flags::NONE,
    );
