//! What commands do in each state: the table of commands and states that a manual has of a machine.

use std::collections::HashSet;

use super::at::{At, TextOr};
use super::format::{MatrixCell, MatrixRow, MatrixTable};
use super::references::References;
use super::tree::{cited, Reader};
use crate::diagnostics::{codes, Diagnostic};
use crate::ir::{
    Availability, CommandOutcomes, CompactString, Device, Documentation, Doubts, Outcome, Pattern, StateOutcome,
    SubjectKind,
};
use crate::source::Span;
use crate::text::brief;

/// What transitions and cells may name: states of the machine, its commands and the device's messages.
pub(super) struct Names<'n> {
    states: HashSet<&'n str>,
    commands: HashSet<&'n str>,
    /// The same, in the order of the source.
    listed: [Vec<&'n str>; 2],
}

impl<'n> Names<'n> {
    pub fn new(states: &'n [Pattern], commands: &'n [Pattern], device: &'n Device) -> Self {
        let states: Vec<&str> = states.iter().map(|own| own.name.as_str()).collect();
        let messages = device.messages.iter().map(|own| own.name.as_str());
        let commands: Vec<&str> = commands.iter().map(|own| own.name.as_str()).chain(messages).collect();
        let set = |list: &[&'n str]| list.iter().copied().collect();
        Names { states: set(&states), commands: set(&commands), listed: [states, commands] }
    }

    /// Reports a state that there isn't.
    pub fn state(&self, reader: &mut Reader<'_, '_>, name: &str, span: Span) {
        if !self.states.contains(name) {
            reader.unresolved("state", name, span, self.listed[0].iter().copied());
        }
    }

    /// Reports a command that there isn't.
    pub fn command(&self, reader: &mut Reader<'_, '_>, name: &str, span: Span) {
        if !self.commands.contains(name) {
            reader.unresolved("command", name, span, self.listed[1].iter().copied());
        }
    }
}

/// The rows of the table.
pub(super) fn read(
    reader: &mut Reader<'_, '_>,
    table: &MatrixTable,
    names: &Names<'_>,
    references: &mut References,
) -> Vec<CommandOutcomes> {
    for state in &table.states {
        names.state(reader, &state.value, reader.span(state));
    }
    let mut rows = Vec::new();
    for (name, row) in table.rows.iter() {
        rows.push(self::row(reader, table, (name, row), names, references));
    }
    rows
}

/// The doubts of the table and of its rows, which belong to this machine.
pub(super) fn doubts(reader: &mut Reader<'_, '_>, table: &At<MatrixTable>, machine: &str) -> Doubts {
    let mut found = reader.doubts_about(&table.value, reader.origin(table), SubjectKind::Machine, machine, "");
    for (name, row) in table.value.rows.iter() {
        let origin = reader.origin(name);
        found.extend(reader.doubts_about(&row.value, origin, SubjectKind::Machine, machine, &name.value));
    }
    found
}

fn row(
    reader: &mut Reader<'_, '_>,
    table: &MatrixTable,
    (name, row): (&At<String>, &At<MatrixRow>),
    names: &Names<'_>,
    references: &mut References,
) -> CommandOutcomes {
    let own = &row.value;
    let commands = match &own.commands {
        Some(list) => list.clone(),
        None => vec![name.clone()],
    };
    for command in &commands {
        names.command(reader, &command.value, reader.span(command));
    }
    references.extend(own.models.iter().flatten().map(|model| (model.clone(), "model")));
    if own.cells.len() != table.states.len() {
        let message = format!(
            "`{}` has {} cells, and the table {} states",
            brief(&name.value),
            own.cells.len(),
            table.states.len()
        );
        reader.report(&codes::TABLE_VALUE, reader.span(name), message);
    }
    let mut cells = Vec::with_capacity(own.cells.len());
    for (state, given) in table.states.iter().zip(&own.cells) {
        let (outcomes, documentation) = cell(reader, table, given, names);
        cells.push(StateOutcome { state: state.value.as_str().into(), outcomes, documentation });
    }
    let availability = Availability {
        models: own.models.iter().flatten().map(|model| model.value.as_str().into()).collect(),
        since: own.since.as_deref().map(Into::into),
        ..Availability::default()
    };
    CommandOutcomes {
        name: name.value.as_str().into(),
        commands: commands.iter().map(|command| command.value.as_str().into()).collect(),
        availability: (availability != Availability::default()).then(|| Box::new(availability)),
        cells,
        documentation: reader.documentation_of(own),
        origin: reader.origin(name),
    }
}

/// The outcomes of a cell, and what is said of them.
fn cell(
    reader: &mut Reader<'_, '_>,
    table: &MatrixTable,
    given: &At<TextOr<MatrixCell>>,
    names: &Names<'_>,
) -> (Vec<Outcome>, Option<Box<Documentation>>) {
    let span = reader.span(given);
    let own = match &given.value {
        TextOr::Text(text) => return (outcomes(reader, text, span, names), None),
        TextOr::Table(own) => own,
    };
    let Some(to) = &own.to else {
        reader.report(&codes::TABLE_VALUE, span, "a cell says `to` what the command leads");
        return (Vec::new(), None);
    };
    let mut words: Vec<&str> = own.doc.as_deref().into_iter().collect();
    if let Some(note) = &own.note {
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
    let documentation = reader.documentation(text.as_deref(), own.cite.as_ref().map(cited));
    (outcomes(reader, &to.value, reader.span(to), names), documentation)
}

/// `same`, `refused`, `?` or states that follow each other; several of these with `or` between them.
fn outcomes(reader: &mut Reader<'_, '_>, text: &str, span: Span, names: &Names<'_>) -> Vec<Outcome> {
    if text.trim() == "?" {
        return Vec::new();
    }
    let (mut found, mut known) = (Vec::new(), HashSet::new());
    for one in text.split(" or ").map(str::trim) {
        let outcome = match one {
            "same" => Outcome::Unchanged,
            "refused" => Outcome::Refused,
            _ => {
                let chain: Vec<CompactString> = one.split('>').map(|state| state.trim().into()).collect();
                for state in &chain {
                    names.state(reader, state, span);
                }
                Outcome::States(chain)
            }
        };
        if !known.insert(outcome.clone()) {
            let message = format!("the cell says `{}` twice", brief(one));
            let help = "one of them is another outcome: compare the cell with the manual";
            reader.diagnostics.push(Diagnostic::new(&codes::TABLE_DUPLICATE, span, message).help(help));
            continue;
        }
        found.push(outcome);
    }
    found
}
