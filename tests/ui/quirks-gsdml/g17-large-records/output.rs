        /// Settings: parameter record 0x0001 of 5000 bytes.
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub struct SettingsRecord {}
