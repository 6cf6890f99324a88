    /// TxPDO 0x1A00.
    ///
    /// Mapping object 0x1A00, 96 bits.
    ///
    /// | Bytes | Field | Object | Type |
    /// |---|---|---|---|
    /// | 0–3 | [`position`](Self::position) |  | `i32` |
    /// | 4–5 | [`inputs`](Self::inputs) |  | `u16` |
    /// | 6–9 | [`temperature`](Self::temperature) |  | `f32` |
    /// | 10–11 | [`statusword`](Self::statusword) | [0x6041:00](super::objects::STATUSWORD) | `u16` |
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct Txpdo1a00 {
        /// Position: an object with an unknown index, 32 bits at bit offset 0.
        pub position: i32,
        /// Inputs: an object with an unknown index, 16 bits at bit offset 32.
        pub inputs: u16,
        /// Temperature: an object with an unknown index, 32 bits at bit offset 48.
        pub temperature: f32,
        /// Statusword: [0x6041:00](super::objects::STATUSWORD), 16 bits at bit offset 80.
        pub statusword: u16,
    }
    /// TxPDO 0x1A00.
    ///
    /// The view has the fields of [`pdo::Txpdo1a00`](super::pdo::Txpdo1a00).
    pub struct Txpdo1a00<B> {
        pub(super) data: B,
        pub(super) bit: usize,
    }
