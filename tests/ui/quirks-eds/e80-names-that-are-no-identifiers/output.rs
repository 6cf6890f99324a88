    /// Gerätetemperatur: 0x2000:00, UNSIGNED32, read-write.
    /// Accessor: [`geraetetemperatur`](super::Pump::geraetetemperatur).
    pub const GERAETETEMPERATUR: ReadWrite<u32> = ReadWriteU32::object(
        0x2000,
        0x00,
        "Gerätetemperatur",
    );
    /// Zeit µs: 0x2001:00, UNSIGNED32, read-write.
    /// Accessor: [`zeit_us`](super::Pump::zeit_us).
    pub const ZEIT_US: ReadWrite<u32> = ReadWriteU32::object(0x2001, 0x00, "Zeit µs");
    /// Winkel °: 0x2002:00, UNSIGNED32, read-write.
    /// Accessor: [`winkel_deg`](super::Pump::winkel_deg).
    pub const WINKEL_DEG: ReadWrite<u32> = ReadWriteU32::object(
        0x2002,
        0x00,
        "Winkel °",
    );
    /// Ein/Aus: 0x2003:00, UNSIGNED32, read-write.
    /// Accessor: [`ein_aus`](super::Pump::ein_aus).
    pub const EIN_AUS: ReadWrite<u32> = ReadWriteU32::object(0x2003, 0x00, "Ein/Aus");
    /// 50% duty: 0x2004:00, UNSIGNED32, read-write.
    /// Accessor: [`_50_percent_duty`](super::Pump::_50_percent_duty).
    pub const _50_PERCENT_DUTY: ReadWrite<u32> = ReadWriteU32::object(
        0x2004,
        0x00,
        "50% duty",
    );
    /// 2nd encoder: 0x2005:00, UNSIGNED32, read-write.
    /// Accessor: [`_2nd_encoder`](super::Pump::_2nd_encoder).
    pub const _2ND_ENCODER: ReadWrite<u32> = ReadWriteU32::object(
        0x2005,
        0x00,
        "2nd encoder",
    );
    /// type: 0x2006:00, UNSIGNED32, read-write.
    /// Accessor: [`type`](super::Pump::type).
    pub const TYPE: ReadWrite<u32> = ReadWriteU32::object(0x2006, 0x00, "type");
    /// self: 0x2007:00, UNSIGNED32, read-write.
    /// Accessor: [`self_2007`](super::Pump::self_2007).
    pub const SELF_2007: ReadWrite<u32> = ReadWriteU32::object(0x2007, 0x00, "self");
    /// ?!: 0x2008:00, UNSIGNED32, read-write.
    /// Accessor: [`object_2008`](super::Pump::object_2008).
    pub const OBJECT_2008: ReadWrite<u32> = ReadWriteU32::object(0x2008, 0x00, "?!");
    /// 0x2009:00, UNSIGNED32, read-write.
    /// Accessor: [`object_2009`](super::Pump::object_2009).
    pub const OBJECT_2009: ReadWrite<u32> = ReadWriteU32::object(0x2009, 0x00, "");
