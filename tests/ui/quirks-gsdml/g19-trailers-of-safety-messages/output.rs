        /// Inputs: data from the device to the controller.
        ///
        /// 2 bytes of user data, consistent as a whole, followed by an F-message trailer of 4 bytes.
        ///
        /// | Position | Field | Type |
        /// |---|---|---|
        /// | bytes 0 and 1 | [`speed`](Self::speed) | `u16` |
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub struct Inputs {
            /// Speed: Unsigned16, bytes 0 and 1.
            pub speed: u16,
        }
        /// Inputs: data from the device to the controller.
        ///
        /// 2 bytes of user data, consistent as a whole, followed by an F-message trailer of 5 bytes.
        ///
        /// | Position | Field | Type |
        /// |---|---|---|
        /// | bytes 0 and 1 | [`speed`](Self::speed) | `u16` |
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub struct Inputs {
            /// Speed: Unsigned16, bytes 0 and 1.
            pub speed: u16,
        }
            const TRAILER_LEN: usize = 4;
            const TRAILER_LEN: usize = 5;
