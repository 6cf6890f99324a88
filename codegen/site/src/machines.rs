//! State machines: a diagram, lists of states, commands and transitions, and the effects of commands in each state.

use std::collections::HashMap;

use super::anchor::Names;
use super::diagram::{self, number, Diagram, ANY_STATE};
use super::entry::{self, Doubt};
use super::link::Link;
use super::words::{self, readable, PLAIN};
use lexibus_codegen::facts::machine::{fault_states, is_energized};
use lexibus_codegen::facts::{pattern, types};
use lexibus_codegen::ir::{Device, ItemRef, Manual, Outcome, Pattern, Procedure, StateMachine, Step, Transition};

/// Text in place of the command, for transitions that need no command.
const AUTOMATIC: &str = "automatic";

/// A state machine, as a page shows it.
#[derive(Debug)]
pub(super) struct Machine {
    pub anchor: String,
    pub title: String,
    pub facts: Vec<String>,
    /// Links to the item from which the state is read and to the item to which commands are written.
    pub items: Vec<Link>,
    pub doubts: Vec<Doubt>,
    pub diagram: Option<Diagram>,
    /// Name of the state after power-on.
    pub initial: Option<String>,
    pub states: Vec<Named>,
    pub commands: Vec<Named>,
    pub transitions: Vec<TransitionRow>,
    pub matrix: Option<Matrix>,
}

/// A state or a command in a list.
#[derive(Debug)]
pub(super) struct Named {
    pub anchor: String,
    /// Name in words.
    pub name: String,
    /// Name in the description.
    pub identifier: String,
    pub names: Vec<(String, String)>,
    /// Bit pattern, such as `xxxx xxxx x01x 0111`; empty if the description states no bit pattern.
    pub bits: String,
    /// `fault` for a state that the device enters because of a fault, `energized` for a state with an energized motor;
    /// otherwise empty.
    pub class: &'static str,
    pub facts: String,
}

/// A transition in the list of transitions.
#[derive(Debug)]
pub(super) struct TransitionRow {
    pub number: String,
    /// Name of the source state; `None` means any state.
    pub from: Option<String>,
    pub to: String,
    pub command: String,
    pub facts: String,
}

impl TransitionRow {
    /// Returns the name of the source state, or [`ANY_STATE`] for a transition from any state.
    pub fn source(&self) -> &str {
        self.from.as_deref().unwrap_or(ANY_STATE)
    }
}

/// A table of the effects of each command in each state.
#[derive(Debug)]
pub(super) struct Matrix {
    pub states: Vec<String>,
    pub rows: Vec<(String, Vec<String>)>,
    pub notes: Vec<String>,
}

/// A procedure with its steps.
#[derive(Debug)]
pub(super) struct Sequence {
    pub anchor: String,
    pub name: String,
    pub facts: Vec<String>,
    pub doubts: Vec<Doubt>,
    pub steps: Vec<SequenceStep>,
}

/// A step of a procedure.
#[derive(Debug)]
pub(super) struct SequenceStep {
    pub text: String,
    /// Link to the item of the step.
    pub item: Option<Link>,
}

/// The state machines and procedures of a device.
#[derive(Debug)]
pub(super) struct Behavior {
    pub machines: Vec<Machine>,
    pub sequences: Vec<Sequence>,
}

/// Returns the state machines and procedures of a device, or `None` if it has neither.
pub(super) fn behavior(device: &Device, manual: &Manual) -> Option<Behavior> {
    let mut names = Names::default();
    let machines: Vec<_> = device.machines.iter().map(|each| machine(each, device, manual, &mut names)).collect();
    let procedures = device.procedures.iter();
    let sequences: Vec<_> = procedures.map(|procedure| sequence(procedure, manual, &mut names)).collect();
    (!machines.is_empty() || !sequences.is_empty()).then_some(Behavior { machines, sequences })
}

fn machine(machine: &StateMachine, device: &Device, manual: &Manual, names: &mut Names) -> Machine {
    let width = |item: &ItemRef, patterns: &[Pattern]| {
        let item = device.referred(item);
        pattern::width(item.and_then(|item| types::basic(&device.types, item.ty).bits()), patterns)
    };
    let of_status = width(&machine.status_item, &machine.states);
    let of_control = width(&machine.control_item, &machine.commands);
    let mut facts = PLAIN.description(machine.documentation.as_deref());
    facts.extend((!machine.status_item.is_empty()).then(|| format!("The state is read from {}.", machine.status_item)));
    facts.extend(
        (!machine.control_item.is_empty()).then(|| format!("Commands are written to {}.", machine.control_item)),
    );
    let faults = fault_states(machine);
    if !faults.is_empty() {
        let states: Vec<_> = faults.iter().map(|state| readable(state)).collect();
        facts.push(format!("Fault states: {}.", states.join(", ")));
    }
    facts.extend(machine.initial.as_ref().map(|state| format!("After power-on: {}.", readable(state))));
    facts.extend(PLAIN.manual_entry(manual, "", machine.documentation.as_deref(), &[]));
    facts.extend(PLAIN.defined_by(machine.stated_by.as_deref(), machine.documentation.as_deref()));
    let anchor = names.anchor(&machine.name);
    let mut of_states = Names::within(&anchor);
    let states = machine.states.iter().map(|state| {
        let class = match faults.iter().any(|fault| **fault == state.name) {
            true => "fault",
            false if is_energized(&state.name) => "energized",
            false => "",
        };
        Named { class, ..named(state, of_status, of_states.anchor(&state.name)) }
    });
    let states: Vec<Named> = states.collect();
    let patterns: Vec<String> = states.iter().map(|state| state.bits.clone()).collect();
    let mut of_commands = Names::within(&format!("{anchor}.command"));
    let commands = machine.commands.iter().map(|command| named(command, of_control, of_commands.anchor(&command.name)));
    Machine {
        title: machine.name.to_string(),
        facts,
        items: Vec::new(),
        doubts: entry::doubts(&machine.doubts, &machine.name, manual),
        diagram: diagram::diagram(machine, &patterns),
        initial: machine.initial.as_ref().map(|state| readable(state)),
        states,
        commands: commands.collect(),
        anchor,
        transitions: machine.transitions.iter().enumerate().map(|(at, each)| transition_row(at, each)).collect(),
        matrix: matrix(machine),
    }
}

fn named(pattern: &Pattern, width: u32, anchor: String) -> Named {
    let bits = if pattern.mask == 0 { String::new() } else { pattern::text(pattern.mask, pattern.value, width) };
    Named {
        anchor,
        name: readable(&pattern.name),
        identifier: pattern.name.to_string(),
        names: words::names(&pattern.name, &pattern.names),
        bits,
        class: "",
        facts: PLAIN.description(pattern.documentation.as_deref()).join(" "),
    }
}

fn transition_row(position: usize, transition: &Transition) -> TransitionRow {
    TransitionRow {
        number: number(position, transition),
        from: transition.from.as_ref().map(|state| readable(state)),
        to: readable(&transition.to),
        command: transition.command.as_ref().map_or_else(|| AUTOMATIC.to_owned(), |command| readable(command)),
        facts: PLAIN.description(transition.documentation.as_deref()).join(" "),
    }
}

fn matrix(machine: &StateMachine) -> Option<Matrix> {
    let first = machine.outcomes.first()?;
    let states: Vec<String> = first.cells.iter().map(|cell| readable(&cell.state)).collect();
    let mut notes: Vec<String> = Vec::new();
    let mut note_numbers: HashMap<String, usize> = HashMap::new();
    let mut rows = Vec::new();
    for row in &machine.outcomes {
        let mut cells = Vec::new();
        for cell in &row.cells {
            let outcomes: Vec<String> = cell.outcomes.iter().map(outcome).collect();
            let text = PLAIN.description(cell.documentation.as_deref()).join(" ");
            let mark = if text.is_empty() {
                String::new()
            } else {
                let at = *note_numbers.entry(text).or_insert_with_key(|text| {
                    notes.push(text.clone());
                    notes.len()
                });
                format!(" ({at})")
            };
            cells.push(outcomes.join(" or ") + &mark);
        }
        rows.push((readable(&row.name), cells));
    }
    Some(Matrix { states, rows, notes })
}

fn outcome(outcome: &Outcome) -> String {
    match outcome {
        Outcome::Unchanged => "no change".to_owned(),
        Outcome::Refused => "–".to_owned(),
        Outcome::States(to) => to.iter().map(|state| format!("→ {}", readable(state))).collect::<Vec<_>>().join(" "),
    }
}

fn sequence(procedure: &Procedure, manual: &Manual, names: &mut Names) -> Sequence {
    let mut facts = PLAIN.description(procedure.documentation.as_deref());
    if !procedure.arguments.is_empty() {
        let arguments: Vec<&str> = procedure.arguments.iter().map(|argument| argument.as_str()).collect();
        facts.push(format!("Given: {}.", arguments.join(", ")));
    }
    facts.extend(PLAIN.manual_entry(manual, "", procedure.documentation.as_deref(), &procedure.names));
    let doubts = entry::doubts(&procedure.doubts, &procedure.name, manual);
    let step = |step: &Step| SequenceStep { text: PLAIN.step(step), item: None };
    Sequence {
        anchor: names.anchor(&procedure.name),
        name: readable(&procedure.name),
        facts,
        doubts,
        steps: procedure.steps.iter().map(step).collect(),
    }
}
