//! Rust code that reads and writes the items of parameter records, for documentation.

use super::record::{self, RecordStruct};
use super::scope::Scope;
use crate::backend::rust::calls::RecordUsage;
use crate::backend::rust::RustOptions;
use crate::collections::HashMap;
use crate::ir::{Catalog, ItemId, SubmoduleId};

/// Returns the calls and default bytes for the records of each submodule for which code is generated.
pub(in crate::backend::rust) fn usage_of_records(catalog: &Catalog) -> HashMap<SubmoduleId, RecordUsage> {
    let options = RustOptions::default();
    let scope = Scope::new(catalog, &options);
    let all = scope.submodules.iter().map(|(at, (submodule, name))| {
        let mut usage = RecordUsage::default();
        for record in record::structs(&submodule.records, &scope.values) {
            usage.calls.extend(calls(&record, name));
            usage.default_bytes.insert(record.position, record.default_bytes);
        }
        (SubmoduleId(*at), usage)
    });
    all.collect()
}

/// Returns the lines of code for each item with a changeable field. A write sends the whole record. If the record has other
/// changeable fields, the code therefore reads the record first.
fn calls<'r>(record: &'r RecordStruct<'_>, submodule: &'r str) -> impl Iterator<Item = (ItemId, Vec<String>)> + 'r {
    let path = format!("submodules::{submodule}::{}", record.name);
    record.fields.iter().map(move |(item, of_item, field)| {
        let read = format!("records.read::<{path}>(address)?.{field}");
        let others = match record.fields.len() {
            1 => String::new(),
            _ => ", ..records.read(address)?".to_owned(),
        };
        let write = format!("let record = {path} {{ {field}: value{others} }}; records.write(address, &record)?");
        let lines = [(of_item.access.readable(), read), (of_item.access.writable(), write)];
        let lines = lines.into_iter().filter(|(exists, _)| *exists).map(|(_, line)| line).collect();
        (ItemId { group: record.position, item: *item }, lines)
    })
}
