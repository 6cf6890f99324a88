    /// Ramp: 0x2000:00, UNSIGNED16, read-write.
    /// Accessor: [`ramp`](super::Pump::ramp).
    ///
    /// Changed by an overlay: the data sheet states the access rights.
    ///
    /// Access rights from overlay pump.overlay.toml:9.
    pub const RAMP: ReadWrite<u16> = ReadWriteU16::object(0x2000, 0x00, "Ramp");
    /// Gain: 0x2001:00, UNSIGNED16, read-only.
    /// Accessor: [`gain`](super::Pump::gain).
    ///
    /// Changed by an overlay: the data sheet states the access rights.
    ///
    /// Access rights from overlay pump.overlay.toml:10.
    pub const GAIN: ReadOnly<u16> = ReadOnlyU16::object(0x2001, 0x00, "Gain");
    /// Level: 0x2002:00, UNSIGNED16, read-write.
    /// Accessor: [`level`](super::Pump::level).
    ///
    /// Changed by an overlay: the data sheet states the access rights.
    ///
    /// Manual, 4\.2.
    pub const LEVEL: ReadWrite<u16> = ReadWriteU16::object(0x2002, 0x00, "Level");
