            /// Temperature: range -20.0 … 100.0 °C (raw \-200 … 1000), default 30.0 °C (raw 300). The handle for all models is [`objects::TEMPERATURE`].
            pub const TEMPERATURE: objects::ReadWrite<rt::Scaled<i16, 1, 10>> = rt::Item::of_model(
                objects::TEMPERATURE,
                rt::Range::Between(-200, 1000),
                rt::Initial::Value(300),
            );
    /// Temperature: 1 LSB = 0.1 °C, range -20.0 … 200.0 °C (raw \-200 … 2000), default 25.0 °C (raw 250), Modbus 0 (holding; wire address 0; FC 3/6/16), INTEGER16, read-write.
    /// Accessor: [`temperature`](super::Press::temperature).
    ///
    /// The device rounds to steps of 0.5 °C (raw 5).
    ///
    /// Models that are not listed below have the item's default value and range.
    ///
    /// On P2: default 30.0 °C (raw 300), range ≤ 100.0 °C (raw ≤ 1000).
    ///
    /// Chapter: Values.
    pub const TEMPERATURE: ReadWrite<rt::Scaled<i16, 1, 10>> = ReadWriteI16Times1Per10::new(
        rt::OnModbus::modbus(rt::Register::holding(0)),
        "Temperature",
        rt::Range::Between(-200, 2000),
        rt::Initial::Value(250),
        "°C",
        rt::Flags::NONE,
    );
    /// Speed: 1 LSB = -0.01 rev/s, range -100.00 … 100.00 rev/s (raw \-10000 … 10000), Modbus 1 (holding; wire address 1; FC 3/6/16), INTEGER16, read-write.
    /// Accessor: [`speed`](super::Press::speed).
    ///
    /// Chapter: Values.
    pub const SPEED: ReadWrite<rt::Scaled<i16, -1, 100>> = ReadWriteI16TimesMinus1Per100::register_within(
        rt::Register::holding(1),
        "Speed",
        rt::Range::Between(-10000, 10000),
        "rev/s",
        rt::Flags::NONE,
    );
    /// Frequency: Physical value = 1000 / raw Hz, range 250 … 1000 Hz (raw 1 … 4), default 500 Hz (raw 2), Modbus 2 (holding; wire address 2; FC 3/6/16), UNSIGNED16, read-write.
    /// Accessor: [`frequency`](super::Press::frequency).
    ///
    /// Chapter: Values.
    pub const FREQUENCY: ReadWrite<rt::Reciprocal<u16, 1000>> = ReadWriteReciprocalU16Times1000Per1::new(
        rt::OnModbus::modbus(rt::Register::holding(2)),
        "Frequency",
        rt::Range::Between(1, 4),
        rt::Initial::Value(2),
        "Hz",
        rt::Flags::NONE,
    );
    /// Time: Unit ms, at most 1000, default 250, Modbus 3 (holding; wire address 3; FC 3/6/16), UNSIGNED16, read-write.
    /// Accessor: [`time`](super::Press::time).
    ///
    /// Chapter: Values.
    pub const TIME: ReadWrite<u16> = ReadWriteU16::new(
        rt::OnModbus::modbus(rt::Register::holding(3)),
        "Time",
        rt::Range::To(1000),
        rt::Initial::Value(250),
        "ms",
        rt::Flags::NONE,
    );
    /// Level: Physical value = raw × 0.1 / [Time](TIME) V, range raw ≤ 100, default raw 10, Modbus 4 (holding; wire address 4; FC 3/6/16), UNSIGNED16, read-write.
    /// Accessor: [`level`](super::Press::level).
    ///
    /// Chapter: Values.
    pub const LEVEL: ReadWrite<rt::PerItem<u16, 1, 10>> = ReadWritePerItemU16Times1Per10::new(
        rt::OnModbus::modbus(rt::Register::holding(4)),
        "Level",
        rt::Range::To(100),
        rt::Initial::Value(10),
        "V",
        rt::Flags::NONE,
    );
    /// Steps: Physical value = raw × 0.5 − 273.15 °C, one of -273.15 °C (raw 0), -268.15 … -263.15 °C (raw 10 … 20), default -268.15 °C (raw 10), Modbus 5 (holding; wire address 5; FC 3/6/16), INTEGER16, read-write.
    /// Accessor: [`steps`](super::Press::steps).
    ///
    /// Chapter: Values.
    pub const STEPS: ReadWrite<rt::Scaled<i16, 10, 20, -5463>> = ReadWriteI16Times10Per20PlusMinus5463::new(
        rt::OnModbus::modbus(rt::Register::holding(5)),
        "Steps",
        rt::Range::OneOf(&[(0, 0), (10, 20)]),
        rt::Initial::Value(10),
        "°C",
        rt::Flags::NONE,
    );
