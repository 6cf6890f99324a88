    /// Missing: 0x2000:00, unknown type, read-only.
    /// Accessor: [`missing`](super::Pump::missing).
    ///
    /// Type and access rights from the rule for missing or unknown attributes.
    pub const MISSING: ReadOnly<rt::Opaque> = ReadOnlyOpaque::object(
        0x2000,
        0x00,
        "Missing",
    );
    /// Empty: 0x2001:00, unknown type, read-only.
    /// Accessor: [`empty`](super::Pump::empty).
    ///
    /// Type and access rights from the rule for missing or unknown attributes.
    pub const EMPTY: ReadOnly<rt::Opaque> = ReadOnlyOpaque::object(
        0x2001,
        0x00,
        "Empty",
    );
