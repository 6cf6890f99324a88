        /// Settings: parameter record 0x000A of 6 bytes.
        ///
        /// | Position | Field | Type | Default |
        /// |---|---|---|---|
        /// | byte 0 | [`first_mode`](Self::first_mode) | [`VModeU8`](values::VModeU8) | 0 |
        /// | byte 1 | [`second_mode`](Self::second_mode) | [`VModeU8`](values::VModeU8) | 0 |
        /// | bit 0 of byte 2 | [`enabled`](Self::enabled) | [`VModeU1`](values::VModeU1) | false |
        /// | bytes 4 and 5 | [`state`](Self::state) | [`VModeI16`](values::VModeI16) | 0 |
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub struct SettingsRecord {
            /// First mode: Unsigned8, byte 0, default 0.
            pub first_mode: values::VModeU8,
            /// Second mode: Unsigned8, byte 1, default 0.
            pub second_mode: values::VModeU8,
            /// Enabled: bit 0 of byte 2, default false.
            pub enabled: values::VModeU1,
            /// State: Integer16, bytes 4 and 5, default 0.
            pub state: values::VModeI16,
        }
    /// V\_Mode, 16 bits.
    ///
    /// How it runs
    ///
    /// | Value | Name |
    /// |---|---|
    /// | 0 | [`Off`](Self::Off) |
    /// | -1 | [`Fault`](Self::Fault) |
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub enum VModeI16 {
        /// 0: Off.
        Off,
        /// -1: Fault.
        Fault,
        /// A number that is not in the device description.
        Unknown(i16),
    }
