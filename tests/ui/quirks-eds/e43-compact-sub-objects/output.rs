        /// Arr1: At least \-9, default 5, 0x2000:01, INTEGER16, read-write, mappable into any PDO.
        /// Accessor: [`ArrAccessors::arr1`].
        pub const ARR1: ReadWrite<i16> = ReadWriteI16::new(
            rt::OnCanOpen::canopen(0x2000, 0x01),
            "Arr1",
            rt::Range::From(-9),
            rt::Initial::Value(5),
            "",
            rt::Flags::PDO,
        );
        /// Arr2: At least \-9, default 5, 0x2000:02, INTEGER16, read-write, mappable into any PDO.
        /// Accessor: [`ArrAccessors::arr2`].
        pub const ARR2: ReadWrite<i16> = ReadWriteI16::new(
            rt::OnCanOpen::canopen(0x2000, 0x02),
            "Arr2",
            rt::Range::From(-9),
            rt::Initial::Value(5),
            "",
            rt::Flags::PDO,
        );
        /// Arr3: At least \-9, default 5, 0x2000:03, INTEGER16, read-write, mappable into any PDO.
        /// Accessor: [`ArrAccessors::arr3`].
        pub const ARR3: ReadWrite<i16> = ReadWriteI16::new(
            rt::OnCanOpen::canopen(0x2000, 0x03),
            "Arr3",
            rt::Range::From(-9),
            rt::Initial::Value(5),
            "",
            rt::Flags::PDO,
        );
