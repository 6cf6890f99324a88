        /// Settings: parameter record 0x000A of 10 bytes.
        ///
        /// | Position | Field | Type | Default |
        /// |---|---|---|---|
        /// | byte 0 | [`fraction`](Self::fraction) | `u8` | 0 |
        /// | byte 1 | [`word`](Self::word) | `u8` | 0 |
        /// | byte 2 | [`reversed`](Self::reversed) | `u8` | 0 |
        /// | byte 3 | [`whole`](Self::whole) | [`VWhole`](values::VWhole) | 0 |
        /// | byte 4 | [`none`](Self::none) | `u8` | 0 |
        /// | bytes 5 to 8 | [`float`](Self::float) | `f32` | 0 |
        /// | byte 9 | [`nowhere`](Self::nowhere) | `u8` | 0 |
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub struct SettingsRecord {
            /// Fraction: Unsigned8, byte 0, default 0.
            pub fraction: u8,
            /// Word: Unsigned8, byte 1, default 0.
            pub word: u8,
            /// Reversed: Unsigned8, byte 2, default 0.
            pub reversed: u8,
            /// Whole: Unsigned8, byte 3, default 0.
            pub whole: values::VWhole,
            /// None: Unsigned8, byte 4, default 0.
            pub none: u8,
            /// Float: Float32, bytes 5 to 8, default 0.
            pub float: f32,
            /// Nowhere: V\_Nowhere, byte 9, default 0.
            pub nowhere: u8,
        }
