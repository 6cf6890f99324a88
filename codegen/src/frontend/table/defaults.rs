//! Applies the table `defaults` to rows.

use super::document::{Node, Value};
use super::format::{key, Row};
use super::tree::Reader;
use crate::diagnostics::codes;

/// Declares the keys of `defaults`. A field of a row has the key after `=` if this key is not its name.
macro_rules! inherited {
    ($($field:ident $(= $key:literal)?)*) => {
        const INHERITED: &[&str] = &[$(key!($field $($key)?)),*];

        impl Row {
            /// Returns the row, with the keys of `defaults` in place of missing keys.
            pub(super) fn or(mut self, defaults: &Row) -> Row {
                $( if self.$field.is_none() { self.$field.clone_from(&defaults.$field); } )*
                self
            }
        }
    };
}

inherited! {
    ty = "type" access pdo unit scale offset na save effective models since until needs buses per_axis hidden order swap
    length pdi
}

/// Reads the table `[defaults]`.
pub(super) fn read<'a>(reader: &mut Reader<'a, '_>, node: Node<'a>) -> Option<Row> {
    let mut node = node;
    check(reader, &mut node);
    reader.piece(node)
}

/// Checks the `defaults` table of a chapter.
pub(super) fn of_chapter(reader: &mut Reader<'_, '_>, chapter: &mut Node<'_>) {
    if let Value::Table(table) = &mut chapter.value {
        if let Some(node) = table.get_mut("defaults") {
            check(reader, node);
        }
    }
}

/// Reports and removes keys that rows do not inherit from `defaults`.
fn check(reader: &mut Reader<'_, '_>, node: &mut Node<'_>) {
    let Value::Table(table) = &mut node.value else { return };
    let is_excluded = |key: &str| Row::KEYS.contains(&key) && !INHERITED.contains(&key);
    let found: Vec<_> = table.iter().map(|(key, _)| key).filter(|key| is_excluded(&key.value)).cloned().collect();
    for key in found {
        table.remove(&key.value);
        let name = &key.value;
        let message = format!("rows do not inherit `{name}` from `defaults`");
        let found = codes::TABLE_VALUE.at(reader.span(&key), message);
        let help = format!("write `{name}` in each row; rows inherit only {}", INHERITED.join(", "));
        reader.diagnostics.push(found.help(help));
    }
}
