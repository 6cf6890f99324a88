    /// Speed: Range 1 to 9, default 4, 0x2000:00, UNSIGNED8, read-write, mappable into any PDO.
    /// Accessor: [`speed`](super::Valve::speed).
    pub const SPEED: ReadWrite<u8> = ReadWriteU8::new(
        rt::OnCanOpen::canopen(0x2000, 0x00),
        "Speed",
        rt::Range::Between(1, 9),
        rt::Initial::Value(4),
        "",
        rt::Flags::PDO,
    );
