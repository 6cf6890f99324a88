//! What rows inherit from `defaults`.

use toml::de::DeValue;

use super::format::Row;
use super::tree::{Node, Reader};
use crate::diagnostics::{codes, Diagnostic};
use crate::source::Span;

/// The keys of `defaults`, each with the field of a row that it fills.
macro_rules! inherited {
    ($($key:literal $field:ident)*) => {
        const INHERITED: &[&str] = &[$($key),*];

        impl Row {
            /// The row with what `defaults` say where it says nothing.
            pub(super) fn or(mut self, defaults: &Row) -> Row {
                $( if self.$field.is_none() { self.$field.clone_from(&defaults.$field); } )*
                self
            }
        }
    };
}

inherited! {
    "type" ty
    "access" access
    "pdo" pdo
    "unit" unit
    "scale" scale
    "offset" offset
    "na" na
    "save" save
    "effective" effective
    "models" models
    "since" since
    "until" until
    "needs" needs
    "buses" buses
    "per_axis" per_axis
    "hidden" hidden
    "order" order
    "swap" swap
    "length" length
    "pdi" pdi
}

/// Keys of rows that each row has for itself.
const OWN: &[&str] = &[
    "reg",
    "obj",
    "esc",
    "ascii",
    "param",
    "name",
    "code",
    "bits",
    "enum",
    "min",
    "max",
    "default",
    "fixed",
    "allowed",
    "step",
    "conversions",
    "variants",
    "when",
    "writable",
    "clears",
    "once",
    "effects",
    "replaced_by",
    "same_as",
    "upper",
    "same_quantity",
    "count",
    "max_count",
    "stride",
    "part",
    "reserved",
    "optional",
    "orig",
    "doc",
    "doc_from",
    "cite",
    "doubt",
    "doubts",
    "allow",
    "summary",
    "why",
    "add",
    "remove",
];

/// Reads `[defaults]`.
pub(super) fn read<'a>(reader: &mut Reader<'a, '_>, node: Node<'a>) -> Option<Row> {
    let mut node = node;
    check(reader, &mut node);
    reader.piece(node)
}

/// Checks the `defaults` of a chapter.
pub(super) fn of_chapter(reader: &mut Reader<'_, '_>, chapter: &mut Node<'_>) {
    if let DeValue::Table(table) = chapter.get_mut() {
        if let Some(node) = table.get_mut("defaults") {
            check(reader, node);
        }
    }
}

/// Takes out what no row would inherit, and says so.
fn check(reader: &mut Reader<'_, '_>, node: &mut Node<'_>) {
    let DeValue::Table(table) = node.get_mut() else { return };
    let is_own = |key: &str| OWN.contains(&key) && !INHERITED.contains(&key);
    let found: Vec<_> = table.keys().filter(|key| is_own(key.get_ref())).cloned().collect();
    for key in found {
        table.remove(&key);
        let (span, name) = (key.span(), key.get_ref());
        let message = format!("rows don't inherit `{name}` from `defaults`: each has its own");
        let span = Span::new(reader.file, span.start as u32, span.end as u32);
        let found = Diagnostic::new(&codes::TABLE_VALUE, span, message);
        reader.diagnostics.push(found.help(format!("inherited are {}", INHERITED.join(", "))));
    }
}
