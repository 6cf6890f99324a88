        /// Inputs: data from the device to the controller.
        ///
        /// 19 bytes of user data, consistent only within each data item.
        ///
        /// | Position | Field | Type |
        /// |---|---|---|
        /// | bit 0 of byte 0 | [`byte_0`](Self::byte_0) | `bool` |
        /// | bit 3 of byte 0 | [`byte_3`](Self::byte_3) | `bool` |
        /// | bit 7 of byte 0 | [`byte_7`](Self::byte_7) | `bool` |
        /// | bit 0 of byte 1 | [`word_8`](Self::word_8) | `bool` |
        /// | bit 7 of byte 1 | [`word_15`](Self::word_15) | `bool` |
        /// | bit 0 of byte 2 | [`word_0`](Self::word_0) | `bool` |
        /// | bit 7 of byte 2 | [`word_7`](Self::word_7) | `bool` |
        /// | bit 7 of byte 3 | [`long_31`](Self::long_31) | `bool` |
        /// | bit 0 of byte 6 | [`long_0`](Self::long_0) | `bool` |
        /// | bit 7 of byte 7 | [`very_long_63`](Self::very_long_63) | `bool` |
        /// | bit 0 of byte 14 | [`very_long_0`](Self::very_long_0) | `bool` |
        /// | bit 0 of byte 15 | [`octets_0`](Self::octets_0) | `bool` |
        /// | bit 1 of byte 16 | [`octets_9`](Self::octets_9) | `bool` |
        /// | bytes 17 and 18 | [`number`](Self::number) | `u16` |
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub struct Inputs {
            /// Byte 0: bit 0 of byte 0.
            pub byte_0: bool,
            /// Byte 3: bit 3 of byte 0.
            pub byte_3: bool,
            /// Byte 7: bit 7 of byte 0.
            pub byte_7: bool,
            /// Word 8: bit 0 of byte 1.
            pub word_8: bool,
            /// Word 15: bit 7 of byte 1.
            pub word_15: bool,
            /// Word 0: bit 0 of byte 2.
            pub word_0: bool,
            /// Word 7: bit 7 of byte 2.
            pub word_7: bool,
            /// Long 31: bit 7 of byte 3.
            pub long_31: bool,
            /// Long 0: bit 0 of byte 6.
            pub long_0: bool,
            /// Very long 63: bit 7 of byte 7.
            pub very_long_63: bool,
            /// Very long 0: bit 0 of byte 14.
            pub very_long_0: bool,
            /// Octets 0: bit 0 of byte 15.
            pub octets_0: bool,
            /// Octets 9: bit 1 of byte 16.
            pub octets_9: bool,
            /// Number: Unsigned16, bytes 17 and 18.
            pub number: u16,
        }
