//! Prints the static table of all objects and registers.

use crate::backend::rust::code::{line, open, Code};
use crate::backend::rust::model::Model;

pub(super) fn write(code: &mut Code, model: &Model) {
    let Some(table) = &model.table else { return };
    code.doc("All items of the device. Items that are only registers come first, sorted by address. Objects follow, sorted by index and sub-index.");
    if let Some(feature) = &model.table_feature {
        line!(code, "#[cfg(feature = ", feature, ")]");
    }
    line!(code, "#[allow(clippy::approx_constant)]");
    if table.is_empty() {
        line!(code, "pub static ENTRIES: &[rt::table::Entry] = &[];");
        return;
    }
    open!(code, "pub static ENTRIES: &[rt::table::Entry] = &[");
    for entry in table {
        line!(code, entry, ",");
    }
    code.close("];");
}
