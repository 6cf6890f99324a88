    /// Address: Default \$NODEID, 0x2000:00, UNSIGNED8, read-write.
    /// Accessor: [`address`](super::Pump::address).
    pub const ADDRESS: ReadWrite<u8> = ReadWriteU8::new(
        rt::OnCanOpen::canopen(0x2000, 0x00),
        "Address",
        rt::Range::Full,
        rt::Initial::NodeId(0x0),
        "",
        rt::Flags::NONE,
    );
