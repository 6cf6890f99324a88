//! Error conversions.

/// Implements `From` for the variants of an error type that wrap another error type.
macro_rules! from {
    ($($error:ident => $target:ident::$variant:ident $(<$parameter:ident>)?;)*) => {$(
        impl $(<$parameter>)? From<$error> for $target $(<$parameter>)? {
            fn from(error: $error) -> Self {
                Self::$variant(error)
            }
        }
    )*};
}

pub(crate) use from;
