    /// status.
    ///
    /// Value type of [`STATUS`](super::objects::STATUS).
    ///
    /// | Bits | Name |
    /// |---|---|
    /// | 7 | [`running`](Self::running) |
    #[derive(Clone, Copy, PartialEq, Eq, Hash)]
    pub struct Status(u8);
