        /// Inputs: data from the device to the controller.
        ///
        /// 3 bytes of user data, consistent only within each data item.
        ///
        /// | Position | Field | Type |
        /// |---|---|---|
        /// | bit 1 of byte 0 | [`one`](Self::one) | `bool` |
        /// | bit 1 of byte 1 | [`two`](Self::two) | `bool` |
        /// | bit 1 of byte 2 | [`three`](Self::three) | `bool` |
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub struct Inputs {
            /// One: bit 1 of byte 0.
            pub one: bool,
            /// Two: bit 1 of byte 1.
            pub two: bool,
            /// Three: bit 1 of byte 2.
            pub three: bool,
        }
