    /// Swapped: Range 9 to 5, 0x2000:00, UNSIGNED8, read-write.
    /// Accessor: [`swapped`](super::Pump::swapped).
    pub const SWAPPED: ReadWrite<u8> = ReadWriteU8::object(0x2000, 0x00, "Swapped");
    /// Equal: Range 5 to 5, 0x2001:00, UNSIGNED8, read-write.
    /// Accessor: [`equal`](super::Pump::equal).
    pub const EQUAL: ReadWrite<u8> = ReadWriteU8::new(
        rt::OnCanOpen::canopen(0x2001, 0x00),
        "Equal",
        rt::Range::Between(5, 5),
        rt::Initial::Unknown,
        "",
        rt::Flags::NONE,
    );
