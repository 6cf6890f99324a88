//! Effects of messages in each state of the device: the rows of the manual's table of commands and states.

use std::collections::HashMap;

use crate::backend::rust::code::{Data, Doc};
use crate::backend::rust::context::Context;
use crate::backend::rust::doc_table;
use crate::backend::rust::docs;
use crate::backend::rust::links::DocModule;
use crate::backend::rust::machine::{self, Variants};
use crate::backend::rust::named::Types;
use crate::ir::{CommandOutcomes, Device, Outcome, StateMachine, StateOutcome};
use crate::names::{self, Case, NameRequest};

/// The effects of a message in each state, ready to be printed.
pub(in crate::backend::rust) struct OutcomesModel {
    /// The name of the constant with the effects.
    pub name: String,
    pub docs: Vec<String>,
    /// The type of the states.
    pub states: String,
    pub value: Doc,
}

/// Returns the effects of all messages, keyed by message name.
pub(super) fn models(context: &Context<'_>, device: &Device, types: &Types) -> HashMap<String, Vec<OutcomesModel>> {
    let machines: Vec<&StateMachine> = device.machines.iter().filter(|machine| !machine.outcomes.is_empty()).collect();
    let mut all: HashMap<String, Vec<OutcomesModel>> = HashMap::new();
    for machine in &machines {
        let Some((ty, variants)) = states(context, device, machine, types) else { continue };
        let states = format!("super::types::{ty}");
        let link = |name: &str| match variants.get(name) {
            Some(variant) => DocModule::MESSAGES.code(&format!("types::{ty}::{variant}")),
            None => docs::escape(name),
        };
        let name = match machines.len() {
            1 => "OUTCOMES".to_owned(),
            _ => constant(&machine.name),
        };
        for row in &machine.outcomes {
            for command in &row.commands {
                let value = row_data(row, &states, &variants);
                let docs = documentation(context, machine, row, &link);
                let model = OutcomesModel { name: name.clone(), docs, states: states.clone(), value };
                all.entry(command.to_string()).or_default().push(model);
            }
        }
    }
    all
}

/// Returns the name of a machine's constant, for devices with effects for several machines.
fn constant(machine: &str) -> String {
    let name = format!("outcomes {machine}");
    let name_request = NameRequest { name: &name, fallback: String::new(), suffix: "machine".to_owned() };
    names::unique(&[name_request], &[], Case::Snake).remove(0).to_ascii_uppercase()
}

/// Returns the type of a machine's states, and its variants keyed by the names of the states.
fn states(context: &Context<'_>, device: &Device, machine: &StateMachine, types: &Types) -> Option<Variants> {
    let at = device.machines.iter().position(|other| other.name == machine.name);
    let model = at.and_then(|at| types.machines.get(at)).and_then(|model| model.states.as_ref());
    machine::states_of(context, machine, model, &types.enumerations)
}

/// Returns the paths of the states of all machines, keyed by state name. If several machines have a state with the same
/// name, the path leads to the state of the first machine.
pub(super) fn links(context: &Context<'_>, device: &Device, types: &Types) -> HashMap<String, String> {
    let mut links = HashMap::new();
    for (ty, variants) in device.machines.iter().filter_map(|machine| states(context, device, machine, types)) {
        for (name, variant) in variants {
            links.entry(name).or_insert_with(|| format!("types::{ty}::{variant}"));
        }
    }
    links
}

fn row_data(row: &CommandOutcomes, states: &str, variants: &HashMap<String, String>) -> Doc {
    let state = |name: &str| Some(Doc::from(format!("{states}::{}", variants.get(name)?)));
    let outcome = |outcome: &Outcome| match outcome {
        Outcome::Unchanged => Doc::from("rt::message::Outcome::Unchanged"),
        Outcome::Refused => Doc::from("rt::message::Outcome::Refused"),
        Outcome::States(to) => {
            let to = to.iter().filter_map(|name| state(name)).collect::<Vec<_>>();
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
    link: &dyn Fn(&str) -> String,
) -> Vec<String> {
    let mut lines = vec![format!(
        "Reaction to the command in each state of the state machine \"{}\".",
        docs::escape(&machine.name)
    )];
    docs::described(row.documentation.as_deref(), &context.manual, &mut lines);
    let one = |outcome: &Outcome| match outcome {
        Outcome::Unchanged => "state unchanged".to_owned(),
        Outcome::Refused => "refused".to_owned(),
        Outcome::States(to) => to.iter().map(|name| link(name)).collect::<Vec<_>>().join(", then "),
    };
    let cell = |cell: &StateOutcome| {
        let mut words = Vec::new();
        docs::words(cell.documentation.as_deref(), &mut words);
        [cell.outcomes.iter().map(one).collect::<Vec<_>>().join(" or "), words.join(" ")]
    };
    // States in which the message has the same effect share a row of the documentation table.
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
