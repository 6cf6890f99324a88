    /// faults.
    ///
    /// Faults of the axis.
    ///
    /// Manual, page 9.
    ///
    /// The codes have the type [`Faults`].
    pub static FAULTS: &[rt::codes::Code] = &[
        rt::codes::Code::new(0x1C98, 0x1C98, "cable", "", &[]),
    ];
        fn codes() -> &'static [rt::codes::Code] {
            FAULTS
        }
