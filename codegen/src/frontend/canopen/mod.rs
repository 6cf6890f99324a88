//! What EDS, DCF, XDD and XDC share: the number grammar, the conversion of text to typed values, what objects and
//! networks have in common.

mod deftype;
pub mod network;
pub mod number;
pub mod object;
pub mod value;
