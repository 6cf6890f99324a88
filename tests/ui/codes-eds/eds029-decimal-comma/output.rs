    /// Comma: Default 1\.5, 0x2000:00, REAL32, read-write.
    /// Accessor: [`comma`](super::Pump::comma).
    #[allow(clippy::approx_constant)]
    pub const COMMA: ReadWrite<f32> = ReadWriteF32::object_with_default(
        0x2000,
        0x00,
        "Comma",
        1.5,
    );
    /// Point: Default 1\.5, 0x2001:00, REAL32, read-write.
    /// Accessor: [`point`](super::Pump::point).
    #[allow(clippy::approx_constant)]
    pub const POINT: ReadWrite<f32> = ReadWriteF32::object_with_default(
        0x2001,
        0x00,
        "Point",
        1.5,
    );
