//! Handwritten enumerations for modes of operation. The enumerations accept all numbers.

macro_rules! modes {
    ($(#[$attribute:meta])* $name:ident { $($mode:ident = $number:literal),* }) => {
        $(#[$attribute])*
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub enum $name {
            $(
                #[doc = concat!(stringify!($number), ".")]
                $mode,
            )*
            /// Any other number.
            Other(i8),
        }

        impl $name {
            /// Returns the mode with this number.
            #[inline]
            pub fn from_raw(raw: i8) -> Self {
                match raw {
                    $($number => Self::$mode,)*
                    other => Self::Other(other),
                }
            }

            /// Returns the number of the mode.
            #[inline]
            pub fn raw(self) -> i8 {
                match self {
                    $(Self::$mode => $number,)*
                    Self::Other(other) => other,
                }
            }
        }
    };
}

modes! {
    /// Modes of operation of the Vector Step.
    StepMode { Velocity = -1, Reserved = 0, Profile = 1, Homing = 6, Interpolated = 7, Position = 8, Speed = 9 }
}

modes! {
    /// Modes of operation of CiA 402.
    AxisMode {
        None = 0, Profile = 1, Velocity = 2, ProfileVelocity = 3, ProfileTorque = 4, Homing = 6, Interpolated = 7,
        Position = 8, Speed = 9, Torque = 10, TorqueWithAngle = 11
    }
}
