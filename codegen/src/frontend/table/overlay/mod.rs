//! Overlays and profiles: tables that change or complete the objects of another description.
//!
//! | file | subject |
//! |---|---|
//! | `apply` | reads an overlay, and applies it to its devices and modules |
//! | `change` | applies a row of an overlay, and records the reason for the change |
//! | `patch` | the rows and definitions of an overlay or profile |
//! | `profile` | reads a profile, in tests only: the compiler contains the result (`profiles`) |

mod apply;
mod change;
mod patch;
#[cfg(test)]
pub(crate) mod profile;

pub(crate) use apply::read;
use patch::{Overlay, PatchRow, Target};
