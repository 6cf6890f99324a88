//! Back ends: one folder an output. None of them looks at a source format.

pub mod eds;
pub mod json;
pub mod rust;
