//! Back ends of the compiler. They do not depend on a source format.

pub mod rust;
