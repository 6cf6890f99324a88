//! Limits the size of the state machines of a device. A transition from a list of states is copied for each of these
//! states. The state names of a matrix are copied for each row, and a note for each cell that refers to it.

use std::fmt::Debug;

use super::at::{At, TextOr};
use super::format::{MachineTable, MatrixTable};
use super::repeats::length;
use super::states::enumeration;
use super::tree::Reader;
use crate::collections::HashMap;
use crate::diagnostics::codes;
use crate::ir::Device;
use crate::limits::{MAX_MACHINE_ROWS, ROW_BYTES_PER_ITEM};
use crate::text::brief;

/// Remaining part of [`MAX_MACHINE_ROWS`].
pub(super) struct MachineBudget(usize);

impl MachineBudget {
    pub fn new() -> Self {
        MachineBudget(MAX_MACHINE_ROWS)
    }

    /// Subtracts the size of a state machine from the budget. Returns `false` and reports the machine if the limit is exceeded.
    pub fn take(
        &mut self,
        reader: &mut Reader<'_, '_>,
        name: &At<String>,
        table: &MachineTable,
        device: &Device,
    ) -> bool {
        if let Some(left) = self.0.checked_sub(weight(table, device)) {
            self.0 = left;
            return true;
        }
        let message = format!(
            "the state machines up to `{}` have more than {MAX_MACHINE_ROWS} states, commands, transitions and rows, \
             including copies of long texts",
            brief(&name.value)
        );
        let found = codes::INPUT_TOO_LARGE.at(reader.span(name), message);
        reader.diagnostics.push(found.label("this and all later state machines are left out"));
        false
    }
}

/// Returns the size of a state machine in rows.
fn weight(table: &MachineTable, device: &Device) -> usize {
    let states = match table.states.as_ref().map(|states| &states.value) {
        Some(TextOr::Table(patterns)) => patterns.iter().count(),
        Some(TextOr::Text(name)) => enumeration(device, name).map_or(0, |(_, values)| values.iter().map(copy).sum()),
        None => 0,
    };
    let transitions = table.transitions.iter().map(|transition| {
        let from = transition.value.from.as_ref().map_or(1, |list| list.value.0.len().max(1));
        match from {
            1 => 1,
            copies => copies.saturating_mul(copy(&(
                &transition.value.to,
                &transition.value.command,
                &transition.value.doc,
                &transition.value.cite,
            ))),
        }
    });
    let matrix = table.matrix.as_ref().map_or(0, |matrix| of_matrix(&matrix.value));
    let rows = [1, states, table.commands.iter().count(), table.faults.len(), matrix];
    rows.into_iter().chain(transitions).fold(0, usize::saturating_add)
}

/// Returns the size of a state-command matrix, converted to a number of rows. The size includes the copied state names and notes.
fn of_matrix(table: &MatrixTable) -> usize {
    let rows = table.rows.iter().count().saturating_mul(copy(&table.states));
    let notes = table.notes.iter().map(|(name, text)| (name.value.as_str(), text.value.len() / ROW_BYTES_PER_ITEM));
    let long: HashMap<&str, usize> = notes.filter(|(_, length)| *length > 0).collect();
    let cells = table.rows.iter().flat_map(|(_, row)| &row.value.cells);
    let copied = cells.filter(|_| !long.is_empty()).filter_map(|cell| match &cell.value {
        TextOr::Table(cell) => long.get(cell.note.as_ref()?.value.to_string().as_str()),
        TextOr::Text(_) => None,
    });
    rows.saturating_add(table.states.len()).saturating_add(table.notes.iter().count()).saturating_add(copied.sum())
}

/// Returns the size of a copied element in rows. A long text counts as several rows.
fn copy(of: &impl Debug) -> usize {
    1 + length(of) / ROW_BYTES_PER_ITEM
}
