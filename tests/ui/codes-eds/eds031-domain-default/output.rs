    /// With default: Default \`0\`, 0x2000:00, DOMAIN, read-write.
    /// Accessor: [`with_default`](super::Pump::with_default).
    pub const WITH_DEFAULT: ReadWrite<rt::Domain> = ReadWriteDomain::object(
        0x2000,
        0x00,
        "With default",
    );
    /// Without default: 0x2001:00, DOMAIN, read-write.
    /// Accessor: [`without_default`](super::Pump::without_default).
    pub const WITHOUT_DEFAULT: ReadWrite<rt::Domain> = ReadWriteDomain::object(
        0x2001,
        0x00,
        "Without default",
    );
