        /// New array subitem: 0x2000:01, UNSIGNED16, read-write.
        /// Accessor: [`SetAccessors::new_array_subitem_1`].
        pub const NEW_ARRAY_SUBITEM_1: ReadWrite<u16> = ReadWriteU16::coe_object(
            0x2000,
            0x01,
            "New array subitem",
        );
        /// New array subitem: 0x2000:02, UNSIGNED16, read-write.
        /// Accessor: [`SetAccessors::new_array_subitem_2`].
        pub const NEW_ARRAY_SUBITEM_2: ReadWrite<u16> = ReadWriteU16::coe_object(
            0x2000,
            0x02,
            "New array subitem",
        );
