//! Reads a description and the files that it refers to.

use super::budget::Budget;
use super::description::Description;
use super::document::document;
use super::{modules, references};
use crate::diagnostics::Diagnostics;
use crate::ir::Catalog;
use crate::source::{FileId, References, Source};

/// Reads the devices and modules that `source` describes, and the files that it refers to. Reports repairs to
/// `diagnostics`.
///
/// Returns `None` and reports one error if `source` is not well-formed or not an ESI file.
pub fn read(
    source: &Source,
    file: FileId,
    references: &mut References<'_>,
    diagnostics: &mut Diagnostics,
) -> Option<Catalog> {
    let mut description = Description::default();
    let mut budget = Budget::new(source.text().len());
    if let Err(stop) = document(source, file, &mut description, diagnostics, &mut budget) {
        diagnostics.push(*stop);
        return None;
    }
    references::follow(source, &mut description, references, diagnostics, &mut budget);
    modules::plug(&mut description.catalog, diagnostics);
    Some(description.catalog)
}
