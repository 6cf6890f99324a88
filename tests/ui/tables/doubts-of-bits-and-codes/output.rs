    /// Control.
    ///
    /// 0 V is low.
    ///
    /// Hazard: 0: Whether an edge starts the press is not printed. Chosen: the level (nothing says otherwise). Manual, page 4.
    ///
    /// Note: The order of the bits is not printed. Chosen: bit 0 first (all tables begin so). Manual, page 3.
    ///
    /// Values of [`CONTROL`](super::objects::CONTROL).
    ///
    /// | Bits | Name |
    /// |---|---|
    /// | 0 | [`start`](Self::start) |
    #[derive(Clone, Copy, PartialEq)]
    pub struct Control(u16);
    /// Mode.
    ///
    /// Note: 0: 0 and 00. Chosen: 0 (both are the same). Manual, page 5.
    ///
    /// Values of [`MODE`](super::objects::MODE).
    ///
    /// | Value | Name |
    /// |---|---|
    /// | 0 | [`Off`](Self::Off) |
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub enum Mode {
        /// 0: off.
        Off,
        /// Any other number.
        Unknown(u16),
    }
    /// alarms.
    ///
    /// Note: 0x1: Door and gate. Chosen: door (the figure shows a door). Manual, page 6.
    ///
    /// As a type: [`Alarms`].
    pub static ALARMS: &[rt::codes::Code] = &[
        rt::codes::Code::new(1, 1, "door", "", &[]),
    ];
