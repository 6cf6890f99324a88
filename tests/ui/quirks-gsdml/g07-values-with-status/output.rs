        /// Inputs: data from the device to the controller.
        ///
        /// 29 bytes of user data, consistent only within each data item.
        ///
        /// | Position | Field | Type |
        /// |---|---|---|
        /// | byte 0 | [`mode`](Self::mode) | `u8` |
        /// | bytes 1 to 4 | [`value_1`](Self::value_1) | `f32` |
        /// | byte 5 | [`value_1_status`](Self::value_1_status) | `u8` |
        /// | bytes 6 to 9 | [`value_2`](Self::value_2) | `f32` |
        /// | byte 10 | [`value_2_status`](Self::value_2_status) | `u8` |
        /// | byte 11 | [`value_3`](Self::value_3) | `u8` |
        /// | byte 12 | [`value_3_2`](Self::value_3_2) | `u8` |
        /// | bytes 13 and 14 | [`value_4`](Self::value_4) | `[u8; 2]` |
        /// | byte 15 | [`value_4_status`](Self::value_4_status) | `u8` |
        /// | bytes 16 and 17 | [`value_5`](Self::value_5) | `u16` |
        /// | byte 18 | [`value_5_status`](Self::value_5_status) | `u8` |
        /// | bytes 19 and 20 | [`value_6`](Self::value_6) | `i16` |
        /// | byte 21 | [`value_6_status`](Self::value_6_status) | `u8` |
        /// | byte 22 | [`value_7`](Self::value_7) | `u8` |
        /// | byte 23 | [`value_7_status`](Self::value_7_status) | `u8` |
        /// | bytes 24 to 27 | [`value_8`](Self::value_8) | `[u8; 4]` |
        /// | byte 28 | [`value_8_status`](Self::value_8_status) | `u8` |
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub struct Inputs {
            /// Mode: Unsigned8, byte 0.
            pub mode: u8,
            /// Value 1: Float32, bytes 1 to 4.
            pub value_1: f32,
            /// Value 1 status: Unsigned8, byte 5.
            pub value_1_status: u8,
            /// Value 2: Float32, bytes 6 to 9.
            pub value_2: f32,
            /// Value 2 status: Unsigned8, byte 10.
            pub value_2_status: u8,
            /// Value 3: Unsigned8, byte 11.
            pub value_3: u8,
            /// Value 3 2: Unsigned8, byte 12.
            pub value_3_2: u8,
            /// Value 4: OctetString, bytes 13 and 14.
            pub value_4: [u8; 2],
            /// Value 4 status: Unsigned8, byte 15.
            pub value_4_status: u8,
            /// Value 5: Unsigned16, bytes 16 and 17.
            pub value_5: u16,
            /// Value 5 status: Unsigned8, byte 18.
            pub value_5_status: u8,
            /// Value 6: Integer16, bytes 19 and 20.
            pub value_6: i16,
            /// Value 6 status: Unsigned8, byte 21.
            pub value_6_status: u8,
            /// Value 7: Unsigned8, byte 22.
            pub value_7: u8,
            /// Value 7 status: Unsigned8, byte 23.
            pub value_7_status: u8,
            /// Value 8: OctetString, bytes 24 to 27.
            pub value_8: [u8; 4],
            /// Value 8 status: Unsigned8, byte 28.
            pub value_8_status: u8,
        }
