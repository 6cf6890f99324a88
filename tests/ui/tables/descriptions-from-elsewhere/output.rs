        /// Torque: 0x2000:01, INTEGER16, read-only.
        /// Accessor: [`LimitsAccessors::torque`].
        ///
        /// Actual torque.
        ///
        /// Description from CiA 402, 17.3.7. Manual, page 7.
        pub const TORQUE: ReadOnly<i16> = ReadOnlyI16::object(0x2000, 0x01, "Torque");
        /// Reserve 2: 0x2000:02, INTEGER16, read-only.
        /// Accessor: [`LimitsAccessors::reserve_2`].
        ///
        /// Second reserve.
        ///
        /// Description derived from the name in the manual. Manual, page 8.
        pub const RESERVE_2: ReadOnly<i16> = ReadOnlyI16::object(
            0x2000,
            0x02,
            "Reserve 2",
        );
