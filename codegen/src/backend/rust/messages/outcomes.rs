//! Effects of messages in each state of the device: the rows of the manual's table of commands and states.

use crate::backend::rust::code::{seq, Data, Declaration, Doc};
use crate::backend::rust::context::Context;
use crate::backend::rust::doc_table;
use crate::backend::rust::docs;
use crate::backend::rust::links::DocModule;
use crate::backend::rust::machine::{self, Variants};
use crate::backend::rust::named::Types;
use crate::collections::HashMap;
use crate::ir::{
    CommandOutcomes, Device, DeviceStateId, MessageId, Outcome, StateId, StateMachine, StateOutcome, StateRef,
};
use crate::names::{self, Case, NameRequest};

/// Returns a constant with the effects of a message in each state for each state machine, keyed by message.
pub(super) fn models(context: &Context<'_>, device: &Device, types: &Types) -> HashMap<MessageId, Vec<Declaration>> {
    let machines = || device.machines.iter().enumerate().filter(|(_, machine)| !machine.outcomes.is_empty());
    let mut all: HashMap<MessageId, Vec<Declaration>> = HashMap::default();
    for (position, machine) in machines() {
        let Some((ty, variants)) = states(context, machine, position, types) else { continue };
        let states = format!("super::types::{ty}");
        let link = |state: &StateRef| match variant(&variants, state) {
            Some(variant) => DocModule::MESSAGES.code(&format!("types::{ty}::{variant}")),
            None => docs::escape(state),
        };
        let name = match machines().count() {
            1 => "OUTCOMES".to_owned(),
            _ => constant(&machine.name),
        };
        for row in &machine.outcomes {
            for message in row.commands.iter().filter_map(|command| command.id) {
                let value = row_data(row, &states, &variants);
                let docs = documentation(context, machine, row, &link);
                let start = seq!["const ", name, ": rt::message::Outcomes<", states, ">"];
                all.entry(message).or_default().push(Declaration::new(docs, start, value));
            }
        }
    }
    all
}

/// Returns the name of the constant with the effects on one machine. This name is used only if messages have effects on
/// several machines of the device.
fn constant(machine: &str) -> String {
    let name = format!("outcomes {machine}");
    let name_request = NameRequest { name: &name, fallback: String::new(), suffix: "machine".to_owned() };
    names::unique([name_request], &[], Case::Snake).remove(0).to_ascii_uppercase()
}

fn variant<'v>(variants: &'v HashMap<u32, String>, state: &StateRef) -> Option<&'v str> {
    variants.get(&state.id?.0).map(String::as_str)
}

/// Returns the type of a machine's states, and its variants. `position` is the position of the machine in its device.
fn states(context: &Context<'_>, machine: &StateMachine, position: usize, types: &Types) -> Option<Variants> {
    let model = types.machines.get(position).and_then(|model| model.states.as_ref());
    machine::states_of(context, machine, model, &types.enumerations)
}

/// Returns the path of each state of each machine.
pub(super) fn links(context: &Context<'_>, device: &Device, types: &Types) -> HashMap<DeviceStateId, String> {
    let mut links = HashMap::default();
    for (position, machine) in device.machines.iter().enumerate() {
        let Some((ty, variants)) = states(context, machine, position, types) else { continue };
        links.extend(variants.into_iter().map(|(state, variant)| {
            let id = DeviceStateId { machine: position as u32, state: StateId(state) };
            (id, format!("types::{ty}::{variant}"))
        }));
    }
    links
}

fn row_data(row: &CommandOutcomes, states: &str, variants: &HashMap<u32, String>) -> Doc {
    let state = |state: &StateRef| Some(Doc::from(format!("{states}::{}", variant(variants, state)?)));
    let outcome = |outcome: &Outcome| match outcome {
        Outcome::Unchanged => Doc::from("rt::message::Outcome::Unchanged"),
        Outcome::Refused => Doc::from("rt::message::Outcome::Refused"),
        Outcome::States(to) => {
            let to = to.iter().filter_map(state).collect::<Vec<_>>();
            Data::call("rt::message::Outcome::States", vec![Data::slice(to)])
        }
    };
    let cells = row.cells.iter().filter(|cell| !cell.outcomes.is_empty()).filter_map(|cell| {
        let outcomes = cell.outcomes.iter().map(outcome);
        Some(Data::call("rt::message::StateOutcomes::new", vec![state(&cell.state)?, Data::slice(outcomes)]))
    });
    Data::call("rt::message::Outcomes::new", vec![Data::slice(cells)])
}

fn documentation(
    context: &Context<'_>,
    machine: &StateMachine,
    row: &CommandOutcomes,
    link: &dyn Fn(&StateRef) -> String,
) -> Vec<String> {
    let machine = docs::escape(&machine.name);
    let title = format!("Reaction to the command in each state of the state machine \"{machine}\".");
    let described = docs::described(row.documentation.as_deref(), &context.manual);
    let mut lines = docs::paragraphs([title].into_iter().chain(described));
    let one = |outcome: &Outcome| match outcome {
        Outcome::Unchanged => "state unchanged".to_owned(),
        Outcome::Refused => "refused".to_owned(),
        Outcome::States(to) => to.iter().map(link).collect::<Vec<_>>().join(", then "),
    };
    let cell = |cell: &StateOutcome| {
        let note = docs::WORDS.description(cell.documentation.as_deref());
        [cell.outcomes.iter().map(one).collect::<Vec<_>>().join(" or "), note.join(" ")]
    };
    // States with the same effect and the same note share a row of the documentation table.
    let mut rows: Vec<[String; 3]> = Vec::new();
    for state_outcome in &row.cells {
        let [outcome, note] = cell(state_outcome);
        match rows.iter_mut().find(|[_, other, words]| *other == outcome && *words == note) {
            Some([states, ..]) => states.extend([", ", &link(&state_outcome.state)]),
            None => rows.push([link(&state_outcome.state), outcome, note]),
        }
    }
    rows.retain(|[_, outcome, note]| !outcome.is_empty() || !note.is_empty());
    lines.extend(doc_table::whole(["State", "Result", "Note"], &rows));
    lines
}
