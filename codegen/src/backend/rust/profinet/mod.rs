//! PROFINET devices: submodules, parameter records, diagnosis, and the plan of what is plugged where.

use super::RustOptions;
use crate::ir::{Catalog, FileInfo};

/// The Rust module for all device access points of `catalog`; `None` where there is none.
pub(super) fn emit(_: &Catalog, _: &FileInfo, _: &RustOptions) -> Option<String> {
    None
}
