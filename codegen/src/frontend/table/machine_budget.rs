//! How much the state machines of a device may be: what leaves any state is written for each, and what a row says is copied for
//! each state that it is about.

use std::collections::HashMap;
use std::fmt::Debug;

use super::at::{At, TextOr};
use super::format::{MachineTable, MatrixTable};
use super::repeats::length;
use super::states::enumeration;
use super::tree::Reader;
use crate::diagnostics::{codes, Diagnostic};
use crate::ir::Device;
use crate::limits::{MAX_MACHINE_ROWS, ROW_BYTES_PER_ITEM};
use crate::text::brief;

/// What is left of [`MAX_MACHINE_ROWS`].
pub(super) struct MachineBudget(usize);

impl MachineBudget {
    pub fn new() -> Self {
        MachineBudget(MAX_MACHINE_ROWS)
    }

    /// Takes a machine into account; reports it and tells so where that is too much.
    pub fn take(
        &mut self,
        reader: &mut Reader<'_, '_>,
        (name, table): (&At<String>, &MachineTable),
        device: &Device,
    ) -> bool {
        if let Some(left) = self.0.checked_sub(weight(table, device)) {
            self.0 = left;
            return true;
        }
        let message = format!(
            "with `{}`, the state machines have more than {MAX_MACHINE_ROWS} states, commands, transitions and rows, or \
             long texts for many of them",
            brief(&name.value)
        );
        let found = Diagnostic::new(&codes::INPUT_TOO_LARGE, reader.span(name), message);
        reader.diagnostics.push(found.label("this one and those behind it are left out"));
        false
    }
}

/// As how many rows a machine counts.
fn weight(table: &MachineTable, device: &Device) -> usize {
    let states = match table.states.as_ref().map(|own| &own.value) {
        Some(TextOr::Table(own)) => own.iter().count(),
        Some(TextOr::Text(name)) => enumeration(device, name).map_or(0, |(_, own)| own.iter().map(copy).sum()),
        None => 0,
    };
    let transitions = table.transitions.iter().map(|own| {
        let from = own.value.from.as_ref().map_or(1, |list| list.value.0.len().max(1));
        match from {
            1 => 1,
            copies => {
                copies.saturating_mul(copy(&(&own.value.to, &own.value.command, &own.value.doc, &own.value.cite)))
            }
        }
    });
    let matrix = table.matrix.as_ref().map_or(0, |own| of_matrix(&own.value));
    [1, states, table.commands.iter().count(), matrix].into_iter().chain(transitions).fold(0, usize::saturating_add)
}

/// The rows of a table of commands and states, with the names of states and the notes that are copied into them.
fn of_matrix(table: &MatrixTable) -> usize {
    let rows = table.rows.iter().count().saturating_mul(copy(&table.states));
    let notes = table.notes.iter().map(|(name, text)| (name.value.as_str(), text.value.len() / ROW_BYTES_PER_ITEM));
    let long: HashMap<&str, usize> = notes.filter(|(_, length)| *length > 0).collect();
    let cells = table.rows.iter().flat_map(|(_, row)| &row.value.cells);
    let copied = cells.filter(|_| !long.is_empty()).filter_map(|cell| match &cell.value {
        TextOr::Table(own) => long.get(own.note.as_ref()?.value.to_string().as_str()),
        TextOr::Text(_) => None,
    });
    rows.saturating_add(table.states.len()).saturating_add(table.notes.iter().count()).saturating_add(copied.sum())
}

/// As how many rows a copy counts.
fn copy(of: &impl Debug) -> usize {
    1 + length(of) / ROW_BYTES_PER_ITEM
}
