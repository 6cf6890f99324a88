    /// Enumerations of named values.
    pub mod types {
        use ::lexibus as rt;
        /// DT0800EN08.
        ///
        /// Value type of [`MODE`](super::objects::MODE).
        ///
        /// | Value | Name |
        /// |---|---|
        /// | 0 | [`Off`](Self::Off) |
        #[derive(Clone, Copy, Debug)]
        pub enum Dt0800En08 {
            /// 0: Off.
            Off,
            /// A number that no other variant represents.
            Unknown(u8),
        }
        impl Dt0800En08 {
            /// All values with names.
            pub const ALL: [Self; 1] = [Self::Off];
            /// Returns the variant for this number.
            pub const fn from_raw(raw: u8) -> Self {
                match raw {
                    0 => Self::Off,
                    other => Self::Unknown(other),
                }
            }
            /// Returns the number of the variant.
            pub const fn raw(self) -> u8 {
                match self {
                    Self::Off => 0,
                    Self::Unknown(other) => other,
                }
            }
        }
        impl rt::Enumeration for Dt0800En08 {
            type Base = u8;
            fn from_native(native: u8) -> Self {
                Self::from_raw(native)
            }
            fn native(self) -> u8 {
                self.raw()
            }
        }
        impl core::convert::From<Dt0800En08> for u8 {
            fn from(value: Dt0800En08) -> Self {
                value.raw()
            }
        }
        impl core::convert::From<u8> for Dt0800En08 {
            fn from(raw: u8) -> Self {
                Self::from_raw(raw)
            }
        }
        impl core::cmp::PartialEq for Dt0800En08 {
            fn eq(&self, other: &Self) -> bool {
                self.raw() == other.raw()
            }
        }
        impl core::cmp::Eq for Dt0800En08 {}
        impl core::hash::Hash for Dt0800En08 {
            fn hash<H: core::hash::Hasher>(&self, state: &mut H) {
                core::hash::Hash::hash(&self.raw(), state);
            }
        }
        impl rt::Named for Dt0800En08 {
            const NAMES: &'static [(Self, &'static str)] = &[(Self::Off, "Off")];
        }
        impl core::fmt::Display for Dt0800En08 {
            fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
                rt::display_name(*self, f)
            }
        }
        impl core::str::FromStr for Dt0800En08 {
            type Err = rt::UnknownName;
            fn from_str(text: &str) -> Result<Self, rt::UnknownName> {
                rt::parse_name(text)
            }
        }
    }
    /// Enumerations of named values.
    pub mod types {
        pub use super::super::d1::types::Dt0800En08;
    }
    /// Enumerations of named values.
    pub mod types {
        use ::lexibus as rt;
        /// DT0800EN08.
        ///
        /// Value type of [`MODE`](super::objects::MODE).
        ///
        /// | Value | Name |
        /// |---|---|
        /// | 0 | [`Stopped`](Self::Stopped) |
        #[derive(Clone, Copy, Debug)]
        pub enum Dt0800En08 {
            /// 0: Stopped.
            Stopped,
            /// A number that no other variant represents.
            Unknown(u8),
        }
        impl Dt0800En08 {
            /// All values with names.
            pub const ALL: [Self; 1] = [Self::Stopped];
            /// Returns the variant for this number.
            pub const fn from_raw(raw: u8) -> Self {
                match raw {
                    0 => Self::Stopped,
                    other => Self::Unknown(other),
                }
            }
            /// Returns the number of the variant.
            pub const fn raw(self) -> u8 {
                match self {
                    Self::Stopped => 0,
                    Self::Unknown(other) => other,
                }
            }
        }
        impl rt::Enumeration for Dt0800En08 {
            type Base = u8;
            fn from_native(native: u8) -> Self {
                Self::from_raw(native)
            }
            fn native(self) -> u8 {
                self.raw()
            }
        }
        impl core::convert::From<Dt0800En08> for u8 {
            fn from(value: Dt0800En08) -> Self {
                value.raw()
            }
        }
        impl core::convert::From<u8> for Dt0800En08 {
            fn from(raw: u8) -> Self {
                Self::from_raw(raw)
            }
        }
        impl core::cmp::PartialEq for Dt0800En08 {
            fn eq(&self, other: &Self) -> bool {
                self.raw() == other.raw()
            }
        }
        impl core::cmp::Eq for Dt0800En08 {}
        impl core::hash::Hash for Dt0800En08 {
            fn hash<H: core::hash::Hasher>(&self, state: &mut H) {
                core::hash::Hash::hash(&self.raw(), state);
            }
        }
        impl rt::Named for Dt0800En08 {
            const NAMES: &'static [(Self, &'static str)] = &[(Self::Stopped, "Stopped")];
        }
        impl core::fmt::Display for Dt0800En08 {
            fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
                rt::display_name(*self, f)
            }
        }
        impl core::str::FromStr for Dt0800En08 {
            type Err = rt::UnknownName;
            fn from_str(text: &str) -> Result<Self, rt::UnknownName> {
                rt::parse_name(text)
            }
        }
    }
    /// Enumerations of named values.
    pub mod types {
        pub use super::super::d3::types::Dt0800En08;
    }
        pub use super::super::d1::types::Dt0800En08;
        pub use super::super::d1::pdo::Sensors;
        pub use super::super::d1::view::Sensors;
        pub use super::super::d1::image::{Inputs, InputsView};
        pub use super::super::d3::types::Dt0800En08;
        pub use super::super::d3::pdo::Sensors;
        pub use super::super::d3::view::Sensors;
        pub use super::super::d3::image::{Inputs, InputsView};
        /// TxPDO 0x1A00: Sensors.
        ///
        /// Mapping object 0x1A00, 8 bits.
        ///
        /// | Bytes | Field | Object | Type |
        /// |---|---|---|---|
        /// | 0 | [`mode`](Self::mode) | [0x2000:00](super::objects::MODE) | [`Dt0800En08`](super::types::Dt0800En08) |
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub struct Sensors {
            /// Mode: [0x2000:00](super::objects::MODE), 8 bits at bit offset 0.
            pub mode: super::types::Dt0800En08,
        }
