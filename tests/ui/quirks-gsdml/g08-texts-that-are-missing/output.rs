        /// Inputs: data from the device to the controller.
        ///
        /// 8 bytes of user data, consistent only within each data item.
        ///
        /// | Position | Field | Type |
        /// |---|---|---|
        /// | byte 0 | [`t_speed`](Self::t_speed) | `u8` |
        /// | bytes 1 and 2 | [`field_1`](Self::field_1) | `u16` |
        /// | bytes 3 to 6 | [`t_torque`](Self::t_torque) | `f32` |
        /// | byte 7 | [`t_torque_status`](Self::t_torque_status) | `u8` |
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub struct Inputs {
            /// T\_Speed: Unsigned8, byte 0.
            pub t_speed: u8,
            /// Unsigned16, bytes 1 and 2.
            pub field_1: u16,
            /// T\_Torque: Float32, bytes 3 to 6.
            pub t_torque: f32,
            /// T\_Torque status: Unsigned8, byte 7.
            pub t_torque_status: u8,
        }
