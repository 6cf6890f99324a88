    /// Gain.
    ///
    /// Modbus 0 (holding; wire 0; FC 3/6/16), UNSIGNED16, rw?.
    /// Accessor: [`gain`](super::Press::gain).
    ///
    /// Gain of the speed controller.
    ///
    /// The manual states no access rights; read-write is assumed.
    ///
    /// Chapter Movement.
    pub const GAIN: ReadWrite<u16> = ReadWriteU16::register(
        rt::Register::holding(0),
        "Gain",
        rt::Flags::NONE,
    );
    /// Gain: register 0.
    ///
    /// Gain of the speed controller.
    ///
    /// Constant: [`objects::GAIN`].
    pub fn gain(&mut self) -> objects::ReadWriteAccess<'_, C, u16> {
        objects::GAIN.at(&mut self.client)
    }
    /// Speed.
    ///
    /// Modbus 1 (holding; wire 1; FC 3), UNSIGNED16, ro.
    /// Accessor: [`speed`](super::Press::speed).
    ///
    /// Actual speed.
    ///
    /// Chapter Movement.
    pub const SPEED: ReadOnly<u16> = ReadOnlyU16::register(
        rt::Register::holding(1),
        "Speed",
        rt::Flags::NONE,
    );
