//! What the compiler emits. No back end looks at a source format.

pub mod rust;
