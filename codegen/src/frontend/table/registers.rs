//! Converts rows of `[chapters.registers]` to items.

use super::at::At;
use super::bindings::{read_only_table, words_without_register};
use super::definitions::unfilled;
use super::format::Row;
use super::notation;
use super::rows::{Named, Rows};
use super::tree::Reader;
use crate::diagnostics::codes;
use crate::ir::Item;
use crate::text::brief;

/// Returns the items that a row of `[chapters.registers]` describes.
pub(super) fn items(
    reader: &mut Reader<'_, '_>,
    rows: &mut Rows,
    space: Option<usize>,
    key: &At<String>,
    row: &At<Row>,
    chapter: Option<&Row>,
) -> Vec<Item> {
    let complete = rows.complete(reader, key, &row.value, chapter);
    rows.allow(reader, key, row);
    let repeat = rows.repetition(reader, &key.value, &complete, space);
    if row.value.count.is_none() && key.value.contains("{n") {
        let message = format!("`{}` needs a `count` for `{{n}}`", brief(&key.value));
        reader.report(&codes::TABLE_VALUE, reader.span(key), message);
    }
    rows.each_has_one(reader, key, &complete, repeat.count);
    let mut items: Vec<Item> = Vec::new();
    for number in 0..repeat.count {
        let name = notation::filled(&key.value, number, None);
        if number == 0 {
            unfilled(reader, key, Some(&name));
        }
        if items.first().is_some_and(|first| first.name == name) {
            break;
        }
        let named = Named { name: &name, key, number, end: row.end };
        let ty = rows.ty(reader, named, &complete);
        let before = reader.diagnostics.total();
        let bindings = rows.bindings(reader, space, named, &complete, repeat, ty);
        if bindings.is_empty() {
            // An invalid address was already reported.
            if reader.diagnostics.total() > before {
                break;
            }
            rows.no_address(reader, space, named, &complete);
            break;
        }
        let mut item = Item::new(bindings[0].clone());
        item.bindings = bindings;
        rows.fill(reader, &mut item, named, &complete, ty);
        if number == 0 && complete.access.is_none() && complete.fixed.is_none() {
            rows.no_access(reader, named);
        }
        read_only_table(reader, &item);
        items.push(item);
    }
    words_without_register(reader, &row.value, &items);
    items
}
