//! What EDS, DCF, XDD and XDC share: the number grammar, the conversion of text to typed values, defined types.

pub mod deftype;
pub mod number;
pub mod value;
