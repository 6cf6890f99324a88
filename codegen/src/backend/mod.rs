//! Back ends of the compiler. No back end depends on the format of the description file.

pub mod rust;
