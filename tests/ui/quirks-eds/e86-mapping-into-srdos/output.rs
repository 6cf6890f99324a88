    /// Stop: 0x2000:00, UNSIGNED8, read-only, mappable into TPDOs.
    /// Accessor: [`stop`](super::StopButton::stop).
    ///
    /// Mappable into SRDOs. The inverted data are in 0x2001:00.
    pub const STOP: ReadOnly<u8> = ReadOnlyU8::flagged_object(
        0x2000,
        0x00,
        "Stop",
        rt::Flags::TPDO,
    );
