    /// Unknown name: Default \`\$MY\_NODE\_ID+0x200\`, 0x2000:00, UNSIGNED32, read-write.
    /// Accessor: [`unknown_name`](super::Pump::unknown_name).
    pub const UNKNOWN_NAME: ReadWrite<u32> = ReadWriteU32::object(
        0x2000,
        0x00,
        "Unknown name",
    );
    /// Alias: Default \$NODEID+0x200, 0x2001:00, UNSIGNED32, read-write.
    /// Accessor: [`alias`](super::Pump::alias).
    pub const ALIAS: ReadWrite<u32> = ReadWriteU32::new(
        rt::OnCanOpen::canopen(0x2001, 0x00),
        "Alias",
        rt::Range::Full,
        rt::Initial::NodeId(0x200),
        "",
        rt::Flags::NONE,
    );
    /// Product: Default \`\$NODEID\*2\`, 0x2002:00, UNSIGNED32, read-write.
    /// Accessor: [`product`](super::Pump::product).
    pub const PRODUCT: ReadWrite<u32> = ReadWriteU32::object(0x2002, 0x00, "Product");
