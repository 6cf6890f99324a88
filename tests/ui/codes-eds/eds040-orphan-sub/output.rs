    impl object_2022 {
        /// Highest sub-index: Default 1, 0x2022:00, UNSIGNED8, read-only.
        /// Accessor: [`Object2022Accessors::highest_sub_index`].
        pub const HIGHEST_SUB_INDEX: ReadOnly<u8> = ReadOnlyU8::object_with_default(
            0x2022,
            0x00,
            "Highest sub-index",
            1,
        );
        /// Speed: 0x2022:01, UNSIGNED16, read-write.
        /// Accessor: [`Object2022Accessors::speed`].
        pub const SPEED: ReadWrite<u16> = ReadWriteU16::object(0x2022, 0x01, "Speed");
    }
