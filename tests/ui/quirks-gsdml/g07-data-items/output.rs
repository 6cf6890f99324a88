        /// Inputs: data from the device to the controller.
        ///
        /// 967 bytes of user data, consistent only within each data item.
        ///
        /// | Position | Field | Type |
        /// |---|---|---|
        /// | bytes 0 to 949 | [`octets`](Self::octets) | `[u8; 950]` |
        /// | bytes 950 to 953 | [`speed`](Self::speed) | `f32` |
        /// | bytes 954 to 957 | [`torque`](Self::torque) | `i32` |
        /// | bytes 958 to 965 | [`energy`](Self::energy) | `f64` |
        /// | byte 966 | [`ready`](Self::ready) | `bool` |
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub struct Inputs {
            /// Octets: OctetString, bytes 0 to 949.
            pub octets: [u8; 950],
            /// Speed: Float32, bytes 950 to 953.
            pub speed: f32,
            /// Torque: Integer32, bytes 954 to 957.
            pub torque: i32,
            /// Energy: Float64, bytes 958 to 965.
            pub energy: f64,
            /// Ready: Boolean, byte 966.
            pub ready: bool,
        }
            /// Returns the bytes of the user data. Bits without a field are 0.
            #[inline]
            pub fn pack(&self) -> [u8; 967] {
                let mut data = [0; 967];
                rt::profinet::be::put(&mut data, 0, &self.octets);
                rt::profinet::be::put(&mut data, 950, &self.speed.to_be_bytes());
                rt::profinet::be::put(&mut data, 954, &self.torque.to_be_bytes());
                rt::profinet::be::put(&mut data, 958, &self.energy.to_be_bytes());
                data[966] = self.ready as u8;
                data
            }
            const TRAILER_LEN: usize = 0;
