        /// Inputs: data from the device to the controller.
        ///
        /// 6 bytes of user data, consistent only within each data item, followed by an F-message trailer of 4 bytes.
        ///
        /// | Position | Field | Type |
        /// |---|---|---|
        /// | bytes 0 to 3 | [`safety`](Self::safety) | `[u8; 4]` |
        /// | bytes 4 and 5 | [`speed`](Self::speed) | `u16` |
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub struct Inputs {
            /// Safety: OctetString, bytes 0 to 3.
            pub safety: [u8; 4],
            /// Speed: Unsigned16, bytes 4 and 5.
            pub speed: u16,
        }
            const TRAILER_LEN: usize = 4;
