    /// Leading zero: 0x2001:00, UNSIGNED8, read-write.
    /// Accessor: [`leading_zero`](super::Pump::leading_zero).
    pub const LEADING_ZERO: ReadWrite<u8> = ReadWriteU8::object(
        0x2001,
        0x00,
        "Leading zero",
    );
    /// Prefix: 0x2002:00, UNSIGNED8, read-write.
    /// Accessor: [`prefix`](super::Pump::prefix).
    pub const PREFIX: ReadWrite<u8> = ReadWriteU8::object(0x2002, 0x00, "Prefix");
        /// Blank before sub: 0x2003:01, UNSIGNED8, read-write.
        /// Accessor: [`RecordAccessors::blank_before_sub`].
        pub const BLANK_BEFORE_SUB: ReadWrite<u8> = ReadWriteU8::object(
            0x2003,
            0x01,
            "Blank before sub",
        );
        /// Blank after sub: 0x2003:02, UNSIGNED8, read-write.
        /// Accessor: [`RecordAccessors::blank_after_sub`].
        pub const BLANK_AFTER_SUB: ReadWrite<u8> = ReadWriteU8::object(
            0x2003,
            0x02,
            "Blank after sub",
        );
        /// Zero: 0x2003:03, UNSIGNED8, read-write.
        /// Accessor: [`RecordAccessors::zero`].
        pub const ZERO: ReadWrite<u8> = ReadWriteU8::object(0x2003, 0x03, "Zero");
        /// Second: 0x2004:02, UNSIGNED16, read-write.
        /// Accessor: [`CompactAccessors::second`].
        pub const SECOND: ReadWrite<u16> = ReadWriteU16::object(0x2004, 0x02, "Second");
