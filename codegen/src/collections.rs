//! Hash tables with a faster hash function than those of the standard library.
//!
//! The function has a random seed in each run, so that a file can hardly contain names that were chosen to collide.

pub use foldhash::{HashMap, HashSet};
