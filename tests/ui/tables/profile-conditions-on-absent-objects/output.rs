    /// View of [`Controlword`] with the bits that are defined while 0x6060 is "profile position" (1).
    #[derive(Clone, Copy)]
    pub struct ControlwordInProfilePosition(u16);
        /// Returns a view of the bits that are defined while 0x6060 is "profile position" (1).
        pub const fn in_profile_position(self) -> ControlwordInProfilePosition {
            ControlwordInProfilePosition(self.0)
        }
