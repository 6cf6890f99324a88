    /// Speed.
    ///
    /// 0x2000:00, UNSIGNED8, rw, mappable into any PDO, default 4, range 1 to 9.
    /// Accessor: [`speed`](super::Valve::speed).
    pub const SPEED: ReadWrite<u8> = ReadWriteU8::new(
        rt::OnCanOpen::canopen(0x2000, 0x00),
        "Speed",
        rt::Range::Between(1, 9),
        rt::Initial::Value(4),
        "",
        rt::Flags::PDO,
    );
