//! JSON output: the complete IR, and the summary that `lexibus info` prints.

mod info;

pub use info::{
    info, DapInfo, DeviceInfo, DictionaryInfo, Info, ModuleContent, ModuleInfo, PdoInfo, RecordInfo, SubmoduleInfo,
};

use lexibus_codegen::ir::Catalog;

/// Returns the IR of `catalog` as indented JSON.
pub fn dump(catalog: &Catalog) -> String {
    serde_json::to_string_pretty(catalog).unwrap_or_else(|error| format!("\"{error}\""))
}
