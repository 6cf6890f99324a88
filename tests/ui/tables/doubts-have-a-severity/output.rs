    /// Torque: 1 LSB = 0.1 Nm, Modbus 0 (holding; wire address 0; FC 3/6/16), INTEGER16, read-write.
    /// Accessor: [`torque`](super::Press::torque).
    ///
    /// Torque limit.
    ///
    /// Chapter: Movement. Manual, page 12.
    ///
    /// Hazard: Nm and Ncm. Assumed: Nm (the example computes with Nm). Manual, pages 12, 40.
    ///
    /// Note: No limit is printed. Assumed: none (nothing says otherwise). Manual, page 13.
    ///
    /// Note: 0\.1 Nm and 0,1Nm. Assumed: 0\.1 Nm (both are the same). Manual, page 12.
    pub const TORQUE: ReadWrite<rt::Scaled<i16, 1, 10>> = ReadWriteI16Times1Per10::register_within(
        rt::Register::holding(0),
        "Torque",
        rt::Range::Full,
        "Nm",
        rt::Flags::NONE,
    );
