    impl speeds {
        /// Highest sub-index: Default 1, 0x2000:00, UNSIGNED8, read-only.
        /// Accessor: [`SpeedsAccessors::highest_sub_index`].
        pub const HIGHEST_SUB_INDEX: ReadOnly<u8> = ReadOnlyU8::object_with_default(
            0x2000,
            0x00,
            "Highest sub-index",
            1,
        );
        /// First: 0x2000:01, UNSIGNED16, read-write.
        /// Accessor: [`SpeedsAccessors::first`].
        pub const FIRST: ReadWrite<u16> = ReadWriteU16::object(0x2000, 0x01, "First");
    }
