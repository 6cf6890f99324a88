//! What messages do in each state of a device: the rows of its table of commands and states.

use std::collections::HashMap;

use crate::backend::rust::data::Data;
use crate::backend::rust::docs;
use crate::backend::rust::named::Types;
use crate::backend::rust::scope::Scope;
use crate::backend::rust::value_type;
use crate::ir::{CommandOutcomes, Device, Outcome, Shape, StateMachine};
use crate::passes::names_unique::{self, Case, Wish};

/// A row, ready to be written.
pub(in crate::backend::rust) struct OutcomesModel {
    /// The name of the constant.
    pub name: String,
    pub docs: Vec<String>,
    /// The type of the states.
    pub states: String,
    value: Data,
}

impl OutcomesModel {
    /// The expression of the constant, in a text that is moved so far to the right.
    pub(in crate::backend::rust) fn value(&self, nest: &usize) -> String {
        const INDENT: usize = 8;
        let start = format!("pub const {}: rt::message::Outcomes<{}> = ", self.name, self.states).len();
        self.value.render(INDENT, INDENT + start, 1, *nest)
    }
}

/// The rows of each message, by its name.
pub(super) fn models(scope: &Scope<'_>, device: &Device, types: &Types) -> HashMap<String, Vec<OutcomesModel>> {
    let machines: Vec<&StateMachine> = device.machines.iter().filter(|own| !own.outcomes.is_empty()).collect();
    let mut all: HashMap<String, Vec<OutcomesModel>> = HashMap::new();
    for machine in &machines {
        let Some((states, variants)) = states(scope, device, machine, types) else { continue };
        let name = match machines.len() {
            1 => "OUTCOMES".to_owned(),
            _ => constant(&machine.name),
        };
        for row in &machine.outcomes {
            for command in &row.commands {
                let value = row_data(row, &states, &variants);
                let docs = documentation(scope, machine, row);
                let model = OutcomesModel { name: name.clone(), docs, states: states.clone(), value };
                all.entry(command.to_string()).or_default().push(model);
            }
        }
    }
    all
}

/// The name of the constant where several machines have such tables.
fn constant(machine: &str) -> String {
    let name = format!("outcomes {machine}");
    let wish = Wish { name: &name, fallback: String::new(), suffix: "machine".to_owned() };
    names_unique::unique(&[wish], &[], Case::Snake).remove(0).to_ascii_uppercase()
}

/// The type of a machine's states, and its variants by the names of the states.
fn states(
    scope: &Scope<'_>,
    device: &Device,
    machine: &StateMachine,
    types: &Types,
) -> Option<(String, HashMap<String, String>)> {
    let Some(name) = &machine.state_type else {
        let at = device.machines.iter().position(|own| own.name == machine.name)?;
        let own = types.machines.get(at)?.states.as_ref()?;
        return Some((format!("super::types::{}", own.name), own.by_name()));
    };
    let is_own = |at: &u32| scope.types.get(*at as usize).is_some_and(|own| own.name == *name);
    let (at, own) = types.enumerations.iter().find(|(at, _)| is_own(at))?;
    let Shape::Enumeration { values, .. } = &scope.types.get(*at as usize)?.shape else { return None };
    let variant = |number: i128| {
        let number = value_type::number(number, number > 0);
        own.variants.iter().find(|variant| variant.value == number).map(|variant| variant.name.clone())
    };
    let named = values.iter().filter_map(|value| Some((value.name.to_string(), variant(value.value)?)));
    Some((format!("super::types::{}", own.name), named.collect()))
}

fn row_data(row: &CommandOutcomes, states: &str, variants: &HashMap<String, String>) -> Data {
    let state = |name: &str| Some(Data::text(format!("{states}::{}", variants.get(name)?)));
    let outcome = |own: &Outcome| match own {
        Outcome::Unchanged => Data::text("rt::message::Outcome::Unchanged"),
        Outcome::Refused => Data::text("rt::message::Outcome::Refused"),
        Outcome::States(to) => {
            let to = to.iter().filter_map(|name| state(name)).collect();
            Data::Call("rt::message::Outcome::States", vec![Data::Slice(to)])
        }
    };
    let cells = row.cells.iter().filter(|cell| !cell.outcomes.is_empty()).filter_map(|cell| {
        let outcomes = cell.outcomes.iter().map(outcome).collect();
        Some(Data::Call("rt::message::StateOutcomes::new", vec![state(&cell.state)?, Data::Slice(outcomes)]))
    });
    Data::Call("rt::message::Outcomes::new", vec![Data::Slice(cells.collect())])
}

fn documentation(scope: &Scope<'_>, machine: &StateMachine, row: &CommandOutcomes) -> Vec<String> {
    let mut lines = vec![format!("What it does in each state of {}.", docs::escape(&machine.name))];
    let mut sentences = Vec::new();
    docs::words(row.documentation.as_deref(), &mut sentences);
    sentences.extend(scope.manual.place(row.documentation.as_deref(), &[]));
    for cell in &row.cells {
        let mut words = Vec::new();
        docs::words(cell.documentation.as_deref(), &mut words);
        if !words.is_empty() {
            sentences.push(format!("In {}: {}", docs::escape(&cell.state), words.join(" ")));
        }
    }
    lines.extend(sentences.into_iter().flat_map(|sentence| [String::new(), sentence]));
    lines
}
