//! EtherCAT slave information (ETG.2000) to IR.

use crate::diagnostics::Diagnostics;
use crate::ir::Catalog;
use crate::source::{FileId, References, Source};

/// Reads the devices and modules that `source` describes.
pub fn read(_: &Source, _: FileId, _: &mut References<'_>, _: &mut Diagnostics) -> Option<Catalog> {
    None
}
