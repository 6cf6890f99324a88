//! Hash tables whose hash function is faster than that of the standard library.
//!
//! The seed of the function is random in each run, so that no author of a file can predict which names collide.

pub use foldhash::{HashMap, HashMapExt, HashSet};
