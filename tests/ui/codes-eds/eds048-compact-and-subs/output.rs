    impl speeds {
        /// NrOfObjects: Default 2, 0x2000:00, UNSIGNED8, read-only.
        /// Accessor: [`SpeedsAccessors::nr_of_objects`].
        ///
        /// Name, type, access rights and default from the rule for compact sub-indices.
        pub const NR_OF_OBJECTS: ReadOnly<u8> = ReadOnlyU8::object_with_default(
            0x2000,
            0x00,
            "NrOfObjects",
            2,
        );
        /// Described: 0x2000:01, UNSIGNED16, read-write.
        /// Accessor: [`SpeedsAccessors::described`].
        pub const DESCRIBED: ReadWrite<u16> = ReadWriteU16::object(
            0x2000,
            0x01,
            "Described",
        );
        /// Speeds2: 0x2000:02, UNSIGNED16, read-only.
        /// Accessor: [`SpeedsAccessors::speeds2`].
        pub const SPEEDS2: ReadOnly<u16> = ReadOnlyU16::object(0x2000, 0x02, "Speeds2");
    }
