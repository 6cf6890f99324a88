//! Prints the static table of all objects and registers.

use crate::backend::rust::code::{line, open, Code, Data, Doc};
use crate::backend::rust::model::Model;
use crate::backend::rust::table::EntryModel;
use crate::number::{hex16, hex8};

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
    table.iter().for_each(|entry| self::entry(code, entry));
    code.close("];");
}

fn entry(code: &mut Code, entry: &EntryModel) {
    open!(code, "rt::table::Entry {");
    match entry.object {
        Some((index, sub_index)) => {
            line!(code, format_args!("object: Some(rt::Object::new({}, {})),", hex16(index), hex8(sub_index)));
        }
        None => line!(code, "object: None,"),
    }
    line!(code, "register: ", Data::optional(entry.register.as_deref().map(Doc::from)), ",");
    line!(code, "name: ", entry.name, ",");
    line!(code, "data_type: rt::DataType::", entry.data_type, ",");
    line!(code, "access: rt::AccessRights::", entry.access, ",");
    line!(code, "flags: ", entry.flags, ",");
    line!(code, "initial: ", entry.initial, ",");
    line!(code, "configured: ", Data::optional(entry.configured.clone()), ",");
    line!(code, "low: ", entry.low, ",");
    line!(code, "high: ", entry.high, ",");
    line!(code, "unit: ", entry.unit, ",");
    code.close("},");
}
