    /// Default: Default 0x11170, 0x2000:00, UNSIGNED16, read-only.
    /// Accessor: [`default`](super::D1::default).
    pub const DEFAULT: ReadOnly<u16> = ReadOnlyU16::coe_object(0x2000, 0x00, "Default");
    /// Minimum: Range \-5 to 9, 0x2001:00, UNSIGNED16, read-only.
    /// Accessor: [`minimum`](super::D1::minimum).
    pub const MINIMUM: ReadOnly<u16> = ReadOnlyU16::new(
        rt::OnCoE::coe(0x2001, 0x00),
        "Minimum",
        rt::Range::To(9),
        rt::Initial::Unknown,
        "",
        rt::Flags::NONE,
    );
    /// Largest: Default 65535, 0x2002:00, UNSIGNED16, read-only.
    /// Accessor: [`largest`](super::D1::largest).
    pub const LARGEST: ReadOnly<u16> = ReadOnlyU16::coe_object_with_default(
        0x2002,
        0x00,
        "Largest",
        65535,
    );
