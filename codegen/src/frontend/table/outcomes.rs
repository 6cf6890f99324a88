//! Reads the state-command matrix of a state machine: the outcome of each command in each state.

use std::sync::Arc;

use super::at::{At, TextOr};
use super::conditions;
use super::format::{MatrixCell, MatrixRow, MatrixTable};
use super::tree::{cited, Reader};
use crate::collections::HashSet;
use crate::diagnostics::codes;
use crate::ir::{CommandOutcomes, Device, Documentation, Doubts, Outcome, Pattern, Reference, StateOutcome, StateRef};
use crate::source::Span;
use crate::text::{brief, count_of};

/// Names that transitions and cells may use: states and commands of the machine, and messages of the device.
pub(super) struct Names<'n> {
    states: HashSet<&'n str>,
    commands: HashSet<&'n str>,
    /// Two lists from which diagnostics suggest names: the states, and the commands followed by the messages. The lists
    /// keep the order of the file.
    listed: [Vec<&'n str>; 2],
}

impl<'n> Names<'n> {
    pub fn new(states: &'n [Pattern], commands: &'n [Pattern], device: &'n Device) -> Self {
        let states: Vec<&str> = states.iter().map(|state| state.name.as_str()).collect();
        let messages = device.messages.iter().map(|message| message.name.as_str());
        let commands: Vec<&str> = commands.iter().map(|command| command.name.as_str()).chain(messages).collect();
        let set = |list: &[&'n str]| list.iter().copied().collect();
        Names { states: set(&states), commands: set(&commands), listed: [states, commands] }
    }

    /// Reports a name that is not a state of the machine.
    pub fn state(&self, reader: &mut Reader<'_, '_>, name: &str, span: Span) {
        if !self.states.contains(name) {
            reader.unresolved("state", name, span, self.listed[0].iter().copied());
        }
    }

    /// Reports a name that is neither a command of the machine nor a message of the device.
    pub fn command(&self, reader: &mut Reader<'_, '_>, name: &str, span: Span) {
        if !self.commands.contains(name) {
            reader.unresolved("command", name, span, self.listed[1].iter().copied());
        }
    }
}

/// Reads the rows of a state-command matrix.
pub(super) fn read(reader: &mut Reader<'_, '_>, table: &MatrixTable, names: &Names<'_>) -> Vec<CommandOutcomes> {
    for state in &table.states {
        names.state(reader, &state.value, reader.span(state));
    }
    table.rows.iter().map(|(name, row)| self::row(reader, table, name, row, names)).collect()
}

/// Returns the ambiguities of a state-command matrix and of its rows.
pub(super) fn doubts(reader: &mut Reader<'_, '_>, table: &At<MatrixTable>) -> Doubts {
    let mut found = reader.doubts_of(&table.value, reader.origin(table));
    for (name, row) in table.value.rows.iter() {
        found.extend(reader.doubts_of_part(&row.value, name));
    }
    found
}

fn row(
    reader: &mut Reader<'_, '_>,
    table: &MatrixTable,
    name: &At<String>,
    row: &At<MatrixRow>,
    names: &Names<'_>,
) -> CommandOutcomes {
    let cells_row = &row.value;
    let commands = cells_row.commands.clone().unwrap_or_else(|| vec![name.clone()]);
    for command in &commands {
        names.command(reader, &command.value, reader.span(command));
    }
    let availability = conditions::availability(reader, &cells_row.models, [&cells_row.since, &None], None, None);
    if cells_row.cells.len() != table.states.len() {
        let (cells, states) = (count_of(cells_row.cells.len(), "cell"), count_of(table.states.len(), "state"));
        let message = format!("`{}` has {cells}, but the matrix has {states}", brief(&name.value));
        reader.report(&codes::TABLE_VALUE, reader.span(name), message);
    }
    let mut cells = Vec::with_capacity(cells_row.cells.len());
    for (state, given) in table.states.iter().zip(&cells_row.cells) {
        let (outcomes, documentation) = cell(reader, table, given, names);
        cells.push(StateOutcome { state: reader.reference(state), outcomes, documentation });
    }
    CommandOutcomes {
        name: name.value.as_str().into(),
        commands: commands.iter().map(|command| reader.reference(command)).collect(),
        availability,
        cells,
        documentation: reader.documentation_of(cells_row),
        origin: reader.origin(name),
    }
}

/// Reads the outcomes in a cell, and their documentation.
fn cell(
    reader: &mut Reader<'_, '_>,
    table: &MatrixTable,
    given: &At<TextOr<MatrixCell>>,
    names: &Names<'_>,
) -> (Vec<Outcome>, Option<Arc<Documentation>>) {
    let span = reader.span(given);
    let cell = match &given.value {
        TextOr::Text(text) => return (outcomes(reader, text, span, names), None),
        TextOr::Table(cell) => cell,
    };
    let Some(to) = &cell.to else {
        reader.report(&codes::TABLE_VALUE, span, "a cell needs `to`, the effect of the command");
        return (Vec::new(), None);
    };
    let mut words: Vec<&str> = cell.doc.as_deref().into_iter().collect();
    if let Some(note) = &cell.note {
        let key = note.value.to_string();
        match table.notes.iter().find(|(name, _)| name.value == key) {
            Some((_, text)) => words.push(&text.value),
            None => {
                let notes = table.notes.iter().map(|(name, _)| name.value.as_str());
                reader.unresolved("note", &key, reader.span(note), notes);
            }
        }
    }
    let text = (!words.is_empty()).then(|| words.join(". "));
    let documentation = reader.documentation(text.as_deref(), cell.cite.as_ref().map(cited));
    (outcomes(reader, &to.value, reader.span(to), names), documentation)
}

/// Reads the outcomes in a cell: `same`, `refused`, or a sequence of states. The word `or` separates alternatives. Returns no
/// outcome for `?`, which means that the manual does not state the outcome.
fn outcomes(reader: &mut Reader<'_, '_>, text: &str, span: Span, names: &Names<'_>) -> Vec<Outcome> {
    if text.trim() == "?" {
        return Vec::new();
    }
    let alternatives = text.matches(" or ").count() + 1;
    let (mut found, mut known) = (Vec::with_capacity(alternatives), HashSet::default());
    for one in text.split(" or ").map(str::trim) {
        let outcome = match one {
            "same" => Outcome::Unchanged,
            "refused" => Outcome::Refused,
            _ => {
                let chain: Vec<StateRef> = one.split('>').map(|state| Reference::new(state.trim(), span)).collect();
                for state in &chain {
                    names.state(reader, state, span);
                }
                Outcome::States(chain)
            }
        };
        if !known.insert(outcome.clone()) {
            let message = format!("the cell contains `{}` twice", brief(one));
            let help = "compare the cell with the manual, and correct one of the two effects";
            reader.diagnostics.push(codes::TABLE_DUPLICATE.at(span, message).help(help));
            continue;
        }
        found.push(outcome);
    }
    found
}
