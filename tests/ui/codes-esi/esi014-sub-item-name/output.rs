        /// A: 0x2000:01, UNSIGNED16, read-write.
        /// Accessor: [`SetAccessors::a_1`].
        pub const A_1: ReadWrite<u16> = ReadWriteU16::coe_object(0x2000, 0x01, "A");
        /// A: 0x2000:02, UNSIGNED16, read-write.
        /// Accessor: [`SetAccessors::a_2`].
        pub const A_2: ReadWrite<u16> = ReadWriteU16::coe_object(0x2000, 0x02, "A");
