//! Codes as their source prints them.

use crate::ir::{CodeRow, Value};

/// Returns the cell of a row in an additional column, or an empty text if the row has no such cell.
pub fn cell(row: &CodeRow, column: usize) -> String {
    match (row.printed_cells.get(column).filter(|printed| !printed.is_empty()), row.cells.get(column)) {
        (Some(printed), _) => printed.to_string(),
        (None, Some(Value::Text(text))) => text.to_string(),
        (None, Some(value)) => value.to_string(),
        (None, None) => String::new(),
    }
}
