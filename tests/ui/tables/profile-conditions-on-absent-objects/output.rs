    /// View of [`Controlword`] with the bits that apply while 0x6060 is profile position (1).
    #[derive(Clone, Copy)]
    pub struct ControlwordInProfilePosition(u16);
        /// Returns the bits that apply while 0x6060 is profile position (1).
        pub const fn in_profile_position(self) -> ControlwordInProfilePosition {
            ControlwordInProfilePosition(self.0)
        }
