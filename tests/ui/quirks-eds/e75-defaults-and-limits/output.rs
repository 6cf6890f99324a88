    /// Swapped: Range 9 to 5, default 7, 0x2002:00, INTEGER16, read-write.
    /// Accessor: [`swapped`](super::Pump::swapped).
    pub const SWAPPED: ReadWrite<i16> = ReadWriteI16::object_with_default(
        0x2002,
        0x00,
        "Swapped",
        7,
    );
    /// No default: Range 5 to 9, 0x2005:00, INTEGER16, read-write.
    /// Accessor: [`no_default`](super::Pump::no_default).
    pub const NO_DEFAULT: ReadWrite<i16> = ReadWriteI16::new(
        rt::OnCanOpen::canopen(0x2005, 0x00),
        "No default",
        rt::Range::Between(5, 9),
        rt::Initial::Unknown,
        "",
        rt::Flags::NONE,
    );
