    /// TxPDO 0x1A00: Sensors.
    ///
    /// Mapping object 0x1A00, 72 bits.
    ///
    /// | Bytes | Field | Object | Type |
    /// |---|---|---|---|
    /// | 0 | [`alias`](Self::alias) | [0x6000:01](super::objects::object_6000::ALIAS) | `u8` |
    /// | 1 | [`enumeration`](Self::enumeration) | [0x6000:02](super::objects::object_6000::ENUMERATION) | [`Mode`](super::types::Mode) |
    /// | 2–3 | [`enumeration_of_another_length`](Self::enumeration_of_another_length) | [0x6000:03](super::objects::object_6000::ENUMERATION_OF_ANOTHER_LENGTH) | `u16` |
    /// | 4 | [`unknown`](Self::unknown) | [0x6000:04](super::objects::object_6000::UNKNOWN) | `u8` |
    /// | 5–6 | [`basic_type`](Self::basic_type) | [0x6000:05](super::objects::object_6000::BASIC_TYPE) | `u16` |
    /// | 7–8 | [`not_a_guess`](Self::not_a_guess) | [0x6000:06](super::objects::object_6000::NOT_A_GUESS) | [`UintMode`](super::types::UintMode) |
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct Sensors {
        /// Alias: [0x6000:01](super::objects::object_6000::ALIAS), 8 bits at bit offset 0.
        pub alias: u8,
        /// Enumeration: [0x6000:02](super::objects::object_6000::ENUMERATION), 8 bits at bit offset 8.
        pub enumeration: super::types::Mode,
        /// Enumeration of another length: [0x6000:03](super::objects::object_6000::ENUMERATION_OF_ANOTHER_LENGTH), 16 bits at bit offset 16.
        pub enumeration_of_another_length: u16,
        /// Unknown: [0x6000:04](super::objects::object_6000::UNKNOWN), 8 bits at bit offset 32.
        pub unknown: u8,
        /// Basic type: [0x6000:05](super::objects::object_6000::BASIC_TYPE), 16 bits at bit offset 40.
        pub basic_type: u16,
        /// Not a guess: [0x6000:06](super::objects::object_6000::NOT_A_GUESS), 16 bits at bit offset 56.
        pub not_a_guess: super::types::UintMode,
    }
