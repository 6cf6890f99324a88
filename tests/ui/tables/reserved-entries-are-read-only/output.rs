        /// Reserved: 0x1800:04, UNSIGNED8, read-only.
        /// Accessor: [`Tpdo1Accessors::reserved`].
        pub const RESERVED: ReadOnly<u8> = ReadOnlyU8::object(0x1800, 0x04, "Reserved");
