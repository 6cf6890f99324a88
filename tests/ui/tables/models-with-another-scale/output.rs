            /// Level: range -2.0 … 200.0 °C (raw \-20 … 2000), default 5.0 °C (raw 50). The handle for all models is [`objects::LEVEL`].
            pub const LEVEL: objects::ReadWrite<i16> = rt::Item::of_model(
                objects::LEVEL,
                rt::Range::Between(-20, 2000),
                rt::Initial::Value(50),
            );
            /// Level: range \-30 to 2000, default 7. The handle for all models is [`objects::LEVEL`].
            pub const LEVEL: objects::ReadWrite<i16> = rt::Item::of_model(
                objects::LEVEL,
                rt::Range::Between(-30, 2000),
                rt::Initial::Value(7),
            );
    /// Level: 1 LSB = 0.1 °C, range -2.0 … 200.0 °C (raw \-20 … 2000), default 5.0 °C (raw 50), Modbus 0 (holding; wire address 0; FC 3/6/16), INTEGER16, read-write.
    /// Accessor: [`level`](super::Press::level).
    ///
    /// Models that are not listed below have the item's default value and range.
    ///
    /// On P2: default 7, at least \-30, 1 LSB = 1 °C.
    ///
    /// Generated code checks written values against the widest range of all models and buses: -3.0 … 200.0 °C (raw \-30 … 2000).
    ///
    /// Chapter: Values.
    pub const LEVEL: ReadWrite<i16> = ReadWriteI16::new(
        rt::OnModbus::modbus(rt::Register::holding(0)),
        "Level",
        rt::Range::Between(-30, 2000),
        rt::Initial::Value(50),
        "°C",
        rt::Flags::NONE,
    );
    /// P2.
    #[allow(clippy::approx_constant)]
    pub mod p2 {
        /// Handles of items whose range or initial value differs between models.
        pub mod objects {
            use ::lexibus as rt;
            use super::super::super::objects;
            /// Level: range \-30 to 2000, default 7. The handle for all models is [`objects::LEVEL`].
            pub const LEVEL: objects::ReadWrite<i16> = rt::Item::of_model(
                objects::LEVEL,
                rt::Range::Between(-30, 2000),
                rt::Initial::Value(7),
            );
        }
    }
