        /// Arr1.
        ///
        /// 0x2000:01, INTEGER16, rw, mappable into any PDO, default 5, at least \-9.
        /// Accessor: [`Accessors::arr1`].
        pub const ARR1: super::ReadWrite<i16> = super::ReadWriteI16::new(
            rt::OnCanOpen::canopen(0x2000, 0x01),
            "Arr1",
            rt::Range::From(-9),
            rt::Initial::Value(5),
            "",
            rt::Flags::PDO,
        );
        /// Arr2.
        ///
        /// 0x2000:02, INTEGER16, rw, mappable into any PDO, default 5, at least \-9.
        /// Accessor: [`Accessors::arr2`].
        pub const ARR2: super::ReadWrite<i16> = super::ReadWriteI16::new(
            rt::OnCanOpen::canopen(0x2000, 0x02),
            "Arr2",
            rt::Range::From(-9),
            rt::Initial::Value(5),
            "",
            rt::Flags::PDO,
        );
        /// Arr3.
        ///
        /// 0x2000:03, INTEGER16, rw, mappable into any PDO, default 5, at least \-9.
        /// Accessor: [`Accessors::arr3`].
        pub const ARR3: super::ReadWrite<i16> = super::ReadWriteI16::new(
            rt::OnCanOpen::canopen(0x2000, 0x03),
            "Arr3",
            rt::Range::From(-9),
            rt::Initial::Value(5),
            "",
            rt::Flags::PDO,
        );
