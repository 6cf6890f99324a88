    /// No access: 0x2000:00, UNSIGNED8, read-only.
    /// Accessor: [`no_access`](super::Pump::no_access).
    ///
    /// Access rights from the rule for missing or unknown attributes.
    pub const NO_ACCESS: ReadOnly<u8> = ReadOnlyU8::object(0x2000, 0x00, "No access");
    /// No type: Default \`0x12\`, 0x2001:00, unknown type, read-only.
    /// Accessor: [`no_type`](super::Pump::no_type).
    ///
    /// Type and access rights from the rule for missing or unknown attributes.
    pub const NO_TYPE: ReadOnly<rt::Opaque> = ReadOnlyOpaque::object(
        0x2001,
        0x00,
        "No type",
    );
    /// Empty type: Default \`0x12\`, 0x2002:00, unknown type, read-only.
    /// Accessor: [`empty_type`](super::Pump::empty_type).
    ///
    /// Type and access rights from the rule for missing or unknown attributes.
    pub const EMPTY_TYPE: ReadOnly<rt::Opaque> = ReadOnlyOpaque::object(
        0x2002,
        0x00,
        "Empty type",
    );
        /// Count: 0x2003:00, unknown type, read-only.
        /// Accessor: [`SubWithoutTypeAccessors::count`].
        ///
        /// Type from the rule for missing or unknown attributes.
        pub const COUNT: ReadOnly<rt::Opaque> = ReadOnlyOpaque::object(
            0x2003,
            0x00,
            "Count",
        );
