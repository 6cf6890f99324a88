    /// DT0800EN08.
    ///
    /// Value type of [`MODE`](super::objects::MODE).
    ///
    /// | Value | Name |
    /// |---|---|
    /// | 0 | [`Off`](Self::Off) |
    /// | 16 | [`On`](Self::On) |
    #[derive(Clone, Copy, Debug)]
    pub enum Dt0800En08 {
        /// 0: Off.
        Off,
        /// 16: On.
        On,
        /// A number that no other variant represents.
        Unknown(u8),
    }
    /// Mode: Default 16, 0x2000:00, UNSIGNED8, read-only, mappable into TPDOs.
    /// Accessor: [`mode`](super::D1::mode). Value type: [`Dt0800En08`](super::types::Dt0800En08). Mapped in [`Sensors`](super::pdo::Sensors).
    pub const MODE: ReadOnly<super::types::Dt0800En08> = ReadOnlyNamedDt0800En08::flagged_coe_object_with_default(
        0x2000,
        0x00,
        "Mode",
        rt::Flags::TPDO,
        super::types::Dt0800En08::from_raw(16),
    );
    /// TxPDO 0x1A00: Sensors.
    ///
    /// Mapping object 0x1A00, 8 bits.
    ///
    /// | Bytes | Field | Object | Type |
    /// |---|---|---|---|
    /// | 0 | [`mode`](Self::mode) | [0x2000:00](super::objects::MODE) | [`Dt0800En08`](super::types::Dt0800En08) |
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct Sensors {
        /// Mode: [0x2000:00](super::objects::MODE), 8 bits at bit offset 0.
        pub mode: super::types::Dt0800En08,
    }
