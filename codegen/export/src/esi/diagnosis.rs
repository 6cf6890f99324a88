//! Writes diagnosis messages.

use super::text::{documentation, hex, names};
use crate::note::Subject;
use crate::xml::Xml;
use lexibus_codegen::ir::{CodeRow, CodeTable, Value};

/// Names of the flags of a diagnosis message, in the order of the columns of the code table.
const FLAGS: [&str; 4] = ["DiagClass", "DiagReset", "DiagReaction", "DiagType"];

/// Returns whether the DiagMessages element contains the rows of a code table.
pub(super) fn is_list(table: &CodeTable) -> bool {
    table.name == "DiagMessages" || FLAGS.iter().skip(1).any(|name| table.name == *name)
}

/// Writes the DiagMessages element unless it is empty.
pub(super) fn write(xml: &mut Xml, tables: &[CodeTable]) {
    let rows = |name: &'static str| tables.iter().filter(move |table| table.name == name).flat_map(|table| &table.rows);
    if rows("DiagMessages").next().is_none() {
        return;
    }
    xml.open("DiagMessages");
    for name in FLAGS.iter().skip(1) {
        for row in rows(name) {
            let subject = Subject::Named(&row.name);
            xml.open(*name);
            names(xml, "Text", &row.name, &row.names, subject);
            xml.leaf("Enum", row.code);
            documentation(xml, "Comment", row.documentation.as_deref(), subject);
            xml.close();
        }
    }
    rows("DiagMessages").for_each(|row| message(xml, row));
    xml.close();
}

fn message(xml: &mut Xml, row: &CodeRow) {
    let subject = Subject::Named(&row.name);
    xml.open("DiagMessage");
    match u32::try_from(row.code) {
        Ok(code) => xml.leaf("TextId", hex(code, 4)),
        Err(_) => xml.leaf("TextId", row.code),
    }
    names(xml, "MessageText", &row.name, &row.names, subject);
    documentation(xml, "Description", row.documentation.as_deref(), subject);
    let text = |value: &Value| match value {
        Value::Text(text) if !text.is_empty() => Some(text.clone()),
        _ => None,
    };
    let cells: Vec<_> = FLAGS.iter().zip(row.cells.iter().map(text)).collect();
    if cells.iter().any(|(_, cell)| cell.is_some()) {
        xml.open("Flags");
        for (name, cell) in cells {
            if let Some(cell) = cell {
                xml.leaf(*name, cell);
            }
        }
        xml.close();
    }
    xml.close();
}
