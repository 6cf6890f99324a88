        /// Settings: parameter record 0x000A of 16 bytes.
        ///
        /// | Position | Field | Type | Default |
        /// |---|---|---|---|
        /// | bytes 1 and 2 | [`speed`](Self::speed) | `u16` | 5 |
        /// | bit 6 of byte 9 | [`start`](Self::start) | `bool` | true |
        /// | bits 1 to 4 of byte 9 | [`mode`](Self::mode) | `u8` | 1 |
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub struct SettingsRecord {
            /// Speed: Unsigned16, bytes 1 and 2, default 5.
            pub speed: u16,
            /// Start: bit 6 of byte 9, default true.
            pub start: bool,
            /// Mode: bits 1 to 4 of byte 9, default 1.
            pub mode: u8,
        }
            /// Index of the record.
            pub const INDEX: u16 = 0x000A;
            const INDEX: u16 = Self::INDEX;
            /// Position of the record among the start-up records of the submodule; 0 means any position.
            pub const TRANSFER_SEQUENCE: u16 = 0;
            const TRANSFER_SEQUENCE: u16 = Self::TRANSFER_SEQUENCE;
            /// Default content of the record.
            pub const DEFAULT_BYTES: [u8; 16] = *b"\x01\x00\x05\x00\x00\x00\x00\x00\xaa\x42\x00\x00\x00\x00\x00\x00";
