//! Error conversions.

/// Implements `From` for an error type: one implementation for each variant that wraps another error type.
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
