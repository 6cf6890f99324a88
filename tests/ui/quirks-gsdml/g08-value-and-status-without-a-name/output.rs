        /// Inputs: data from the device to the controller.
        ///
        /// 5 bytes of user data, consistent only within each data item.
        ///
        /// | Position | Field | Type |
        /// |---|---|---|
        /// | byte 0 | [`mode`](Self::mode) | `u8` |
        /// | byte 1 | [`speed`](Self::speed) | `u8` |
        /// | byte 2 | [`ready`](Self::ready) | `u8` |
        /// | byte 3 | [`field_3`](Self::field_3) | `u8` |
        /// | byte 4 | [`_2`](Self::_2) | `u8` |
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub struct Inputs {
            /// Mode: Unsigned8, byte 0.
            pub mode: u8,
            /// Speed: Unsigned8, byte 1.
            pub speed: u8,
            /// Ready: Unsigned8, byte 2.
            pub ready: u8,
            /// Unsigned8, byte 3.
            pub field_3: u8,
            /// 2: Unsigned8, byte 4.
            pub _2: u8,
        }
