        /// Inputs: data from the device to the controller.
        ///
        /// 2 bytes of user data, consistent only within each data item.
        ///
        /// | Position | Field | Type |
        /// |---|---|---|
        /// | bytes 0 and 1 | [`torque`](Self::torque) | `u16` |
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub struct Inputs {
            /// Torque: Unsigned16, bytes 0 and 1.
            pub torque: u16,
        }
