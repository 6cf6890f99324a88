    /// Last: 0x2000:00, UNSIGNED16, read-only.
    /// Accessor: [`last`](super::Pump::last).
    pub const LAST: ReadOnly<u16> = ReadOnlyU16::object(0x2000, 0x00, "Last");
        /// Last sub: 0x2001:01, UNSIGNED16, read-write.
        /// Accessor: [`RecordAccessors::last_sub`].
        pub const LAST_SUB: ReadWrite<u16> = ReadWriteU16::object(
            0x2001,
            0x01,
            "Last sub",
        );
