    /// Empty: 0x2000:00, UNSIGNED8, read-only.
    /// Accessor: [`empty`](super::Pump::empty).
    ///
    /// Access rights from the rule for missing or unknown attributes.
    pub const EMPTY: ReadOnly<u8> = ReadOnlyU8::object(0x2000, 0x00, "Empty");
    /// Missing: 0x2001:00, UNSIGNED8, read-only.
    /// Accessor: [`missing`](super::Pump::missing).
    ///
    /// Access rights from the rule for missing or unknown attributes.
    pub const MISSING: ReadOnly<u8> = ReadOnlyU8::object(0x2001, 0x00, "Missing");
    /// Domain: 0x2002:00, DOMAIN, read-write.
    /// Accessor: [`domain`](super::Pump::domain).
    ///
    /// Access rights from the rule for missing or unknown attributes.
    pub const DOMAIN: ReadWrite<rt::Domain> = ReadWriteDomain::object(
        0x2002,
        0x00,
        "Domain",
    );
