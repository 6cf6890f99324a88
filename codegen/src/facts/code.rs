//! Codes as their source prints them.

use crate::ir::{CodeRow, Value};

/// `0x8110`, `F125`, `0xFF13 to 0xFF15`: the code of a row, or its codes. Decimal if the source has no other notation.
pub fn text(row: &CodeRow) -> String {
    row.printed_code()
}

/// A cell next to the code; empty if the row has none in this column.
pub fn cell(row: &CodeRow, column: usize) -> String {
    match (row.printed_cells.get(column).filter(|printed| !printed.is_empty()), row.cells.get(column)) {
        (Some(printed), _) => printed.to_string(),
        (None, Some(Value::Text(text))) => text.to_string(),
        (None, Some(value)) => value.to_string(),
        (None, None) => String::new(),
    }
}
