//! Error conversions.

/// Implements `From` for each error type that a variant of another error type holds.
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
