        /// Second: 0x2002:02, unknown type, read-only.
        /// Accessor: [`ArrayAccessors::second`].
        ///
        /// Type and access rights from the rule for missing or unknown attributes.
        pub const SECOND: ReadOnly<rt::Opaque> = ReadOnlyOpaque::object(
            0x2002,
            0x02,
            "Second",
        );
