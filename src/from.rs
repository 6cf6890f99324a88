//! Conversions of errors.

/// Implements `From` for each error that is a variant of a wider one.
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
