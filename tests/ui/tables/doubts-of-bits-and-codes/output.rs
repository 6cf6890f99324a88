    /// Control.
    ///
    /// 0 V is low.
    ///
    /// Hazard for 0: Whether an edge starts the press is not printed. Assumed: the level (nothing says otherwise). Manual, page 4.
    ///
    /// Note: The order of the bits is not printed. Assumed: bit 0 first (all tables begin so). Manual, page 3.
    ///
    /// Value type of [`CONTROL`](super::objects::CONTROL).
    ///
    /// | Bits | Name |
    /// |---|---|
    /// | 0 | [`start`](Self::start) |
    #[derive(Clone, Copy, PartialEq, Eq, Hash)]
    pub struct Control(u16);
    /// Mode.
    ///
    /// Note for 0: 0 and 00. Assumed: 0 (both are the same). Manual, page 5.
    ///
    /// Value type of [`MODE`](super::objects::MODE).
    ///
    /// | Value | Name |
    /// |---|---|
    /// | 0 | [`Off`](Self::Off) |
    #[derive(Clone, Copy, Debug)]
    pub enum Mode {
        /// 0: off.
        Off,
        /// A number that no other variant represents.
        Unknown(u16),
    }
    /// alarms.
    ///
    /// Note for 0x1: Door and gate. Assumed: door (the figure shows a door). Manual, page 6.
    ///
    /// The codes have the type [`Alarms`].
    pub static ALARMS: &[rt::codes::Code] = &[
        rt::codes::Code::new(1, 1, "door", "", &[]),
    ];
