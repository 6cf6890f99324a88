    /// Faults.
    ///
    /// Definition from overlay pump.overlay.toml:6.
    ///
    /// The codes have the type [`Faults`].
    pub static FAULTS: &[rt::codes::Code] = &[
        rt::codes::Code::new(0x2310, 0x2310, "pump blocked", "", &[]),
    ];
