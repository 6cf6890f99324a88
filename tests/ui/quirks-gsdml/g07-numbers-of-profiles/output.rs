        /// Inputs: data from the device to the controller.
        ///
        /// 36 bytes of user data, consistent only within each data item.
        ///
        /// | Position | Field | Type |
        /// |---|---|---|
        /// | bytes 0 and 1 | [`n2`](Self::n2) | `i16` |
        /// | bytes 2 and 3 | [`n2_again`](Self::n2_again) | `i16` |
        /// | bytes 4 to 7 | [`n4`](Self::n4) | `i32` |
        /// | bytes 8 and 9 | [`e2`](Self::e2) | `i16` |
        /// | bytes 10 to 13 | [`c4`](Self::c4) | `i32` |
        /// | bytes 14 and 15 | [`x2`](Self::x2) | `i16` |
        /// | bytes 16 and 17 | [`x2_again`](Self::x2_again) | `i16` |
        /// | bytes 18 to 21 | [`x4`](Self::x4) | `i32` |
        /// | bytes 22 and 23 | [`t2`](Self::t2) | `u16` |
        /// | bytes 24 to 27 | [`t4`](Self::t4) | `u32` |
        /// | bytes 28 and 29 | [`d2`](Self::d2) | `u16` |
        /// | bytes 30 and 31 | [`r2`](Self::r2) | `u16` |
        /// | bytes 32 and 33 | [`unipolar2_16`](Self::unipolar2_16) | `u16` |
        /// | bytes 34 and 35 | [`unipolar2_16_again`](Self::unipolar2_16_again) | `u16` |
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub struct Inputs {
            /// N2: N2, 1 LSB = 0.006103515625, bytes 0 and 1.
            pub n2: i16,
            /// N2 again: N2, 1 LSB = 0.006103515625, bytes 2 and 3.
            pub n2_again: i16,
            /// N4: N4, 1 LSB = 0.00000009313225746154785, bytes 4 to 7.
            pub n4: i32,
            /// E2: E2, 1 LSB = 0.0078125, bytes 8 and 9.
            pub e2: i16,
            /// C4: C4, 1 LSB = 0.0001, bytes 10 to 13.
            pub c4: i32,
            /// X2: X2, bytes 14 and 15.
            pub x2: i16,
            /// X2 again: X2, bytes 16 and 17.
            pub x2_again: i16,
            /// X4: X4, bytes 18 to 21.
            pub x4: i32,
            /// T2: T2, bytes 22 and 23.
            pub t2: u16,
            /// T4: T4, bytes 24 to 27.
            pub t4: u32,
            /// D2: D2, bytes 28 and 29.
            pub d2: u16,
            /// R2: R2, bytes 30 and 31.
            pub r2: u16,
            /// Unipolar2 16: Unipolar2.16, bytes 32 and 33.
            pub unipolar2_16: u16,
            /// Unipolar2 16 again: Unipolar2.16, bytes 34 and 35.
            pub unipolar2_16_again: u16,
        }
