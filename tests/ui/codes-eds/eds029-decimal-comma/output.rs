    /// Comma.
    ///
    /// 0x2000:00, REAL32, rw, default 1\.5.
    /// Accessor: [`comma`](super::Pump::comma).
    #[allow(clippy::approx_constant)]
    pub const COMMA: ReadWrite<f32> = ReadWriteF32::object_with_default(
        0x2000,
        0x00,
        "Comma",
        1.5,
    );
    /// Point.
    ///
    /// 0x2001:00, REAL32, rw, default 1\.5.
    /// Accessor: [`point`](super::Pump::point).
    #[allow(clippy::approx_constant)]
    pub const POINT: ReadWrite<f32> = ReadWriteF32::object_with_default(
        0x2001,
        0x00,
        "Point",
        1.5,
    );
