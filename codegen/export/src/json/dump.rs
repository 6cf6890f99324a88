//! The complete IR as JSON.

use lexibus_codegen::ir::Catalog;

/// Returns the IR of `catalog` as indented JSON.
pub fn dump(catalog: &Catalog) -> String {
    serde_json::to_string_pretty(catalog).unwrap_or_else(|error| format!("\"{error}\""))
}
