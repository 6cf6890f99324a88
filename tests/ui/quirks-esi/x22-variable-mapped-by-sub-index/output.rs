        /// Temperature: 0x2000:00, UNSIGNED32, read-only, mappable into TPDOs.
        /// Accessor: [`TemperatureAccessors::temperature`]. Mapped in [`Values`](super::pdo::Values).
        pub const TEMPERATURE: ReadOnly<u32> = ReadOnlyU32::flagged_coe_object(
            0x2000,
            0x00,
            "Temperature",
            rt::Flags::TPDO,
        );
        /// Peak: 0x2000:01, UNSIGNED16, read-only, mappable into TPDOs.
        /// Accessor: [`TemperatureAccessors::peak`]. Mapped in [`Values`](super::pdo::Values).
        ///
        /// Access rights and PDO mapping from the rule for objects that occur only in PDOs.
        pub const PEAK: ReadOnly<u16> = ReadOnlyU16::flagged_coe_object(
            0x2000,
            0x01,
            "Peak",
            rt::Flags::TPDO,
        );
