//! Code that the EDS, DCF, XDD and XDC readers share: number grammar, typed values, objects and network settings.

mod deftype;
pub mod network;
pub mod number;
pub mod object;
pub mod value;
