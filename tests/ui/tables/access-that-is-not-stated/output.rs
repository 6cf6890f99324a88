    /// Gain: Modbus 0 (holding; wire address 0; FC 3/6/16), UNSIGNED16, read-write (assumed).
    /// Accessor: [`gain`](super::Press::gain).
    ///
    /// Gain of the speed controller.
    ///
    /// The access rights (read-write) are an assumption, because the manual states none.
    ///
    /// Chapter: Movement.
    pub const GAIN: ReadWrite<u16> = ReadWriteU16::register(
        rt::Register::holding(0),
        "Gain",
        rt::Flags::NONE,
    );
    /// Gain of the speed controller.
    ///
    /// Gain: Modbus 0 (holding; wire address 0; FC 3/6/16), UNSIGNED16, read-write (assumed).
    /// Constant: [`objects::GAIN`].
    #[doc(alias("0"))]
    pub fn gain(&mut self) -> objects::ReadWriteAccess<'_, C, u16> {
        objects::GAIN.at(&mut self.client)
    }
    /// Speed: Modbus 1 (holding; wire address 1; FC 3), UNSIGNED16, read-only.
    /// Accessor: [`speed`](super::Press::speed).
    ///
    /// Actual speed.
    ///
    /// Chapter: Movement.
    pub const SPEED: ReadOnly<u16> = ReadOnlyU16::register(
        rt::Register::holding(1),
        "Speed",
        rt::Flags::NONE,
    );
