    /// Details: user structure 0x0002 of 5 bytes.
    ///
    /// | Position | Field | Type |
    /// |---|---|---|
    /// | bytes 2 and 3 | [`cause`](Self::cause) | [`V`](values::V) |
    /// | bit 5 of byte 4 | [`stopped`](Self::stopped) | `bool` |
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct DetailsDiagnosis {
        /// Cause: Unsigned16, bytes 2 and 3.
        pub cause: values::V,
        /// Stopped: bit 5 of byte 4.
        pub stopped: bool,
    }
