//! Error conversions.

/// Implements `From` for error types: one implementation for each listed variant, which wraps another error.
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
