//! Compares state machines and procedures.

use super::change::Judgment;
use super::comparison::{
    compare_fields, fact, fact_as, list, rules, text, Comparison, Elements, COMPARED, KEY, POSITION,
};
use lexibus_codegen::facts::words::PLAIN;
use lexibus_codegen::ir::{CommandOutcomes, Outcome, Pattern, Procedure, StateMachine, StateOutcome, Step, Transition};
use lexibus_codegen::number::hex;

rules!(pub(super) fn compare(StateMachine) {
    name,
    status_item: fact("status", Judgment::API_AND_WIRE),
    control_item: fact("control", Judgment::API_AND_WIRE),
    state_type: fact("enumeration of the states", Judgment::API),
    // An added state breaks Rust code that matches all variants of the enumeration.
    states: list(patterns(|state| format!("state {}", state.name)), pattern),
    initial: fact("state after power-on", Judgment::BEHAVIOR),
    faults: fact("fault states", Judgment::BEHAVIOR),
    commands: list(patterns(|command| format!("command {}", command.name)), pattern),
    transitions: list(transitions(), transition),
    outcomes: list(
        Elements::titled(|outcomes: &CommandOutcomes| format!("command {} by state", outcomes.name))
            .judged(Judgment::BEHAVIOR_COMPATIBLE, Judgment::BEHAVIOR),
        command_outcomes,
    ),
    documentation, doubts, stated_by,
});

/// Compares states or commands. States and commands become variants of an enumeration, and Rust code can match all variants.
fn patterns(title: fn(&Pattern) -> String) -> Elements<Pattern> {
    Elements {
        name: |pattern| pattern.name.to_string(),
        position: bits,
        ..Elements::titled(title).judged(Judgment::API, Judgment::API)
    }
}

fn bits(pattern: &Pattern) -> String {
    format!("{} (mask {})", hex(pattern.value), hex(pattern.mask))
}

fn pattern(old: &Pattern, new: &Pattern, comparison: &mut Comparison<'_>) {
    comparison.texts("bits", bits(old), bits(new), Judgment::WIRE);
    compare_fields!(Pattern, old, new, comparison, {
        name, names, documentation,
    }, COMPARED => [mask, value]);
}

fn transitions() -> Elements<Transition> {
    Elements::titled(|transition: &Transition| {
        let from = transition.from.as_ref().map_or("any state", |state| state.as_str());
        let command = transition.command.as_ref();
        let command = command.map_or_else(|| "without a command".to_owned(), |command| format!("by {command}"));
        format!("transition from {from} to {} {command}", transition.to)
    })
    .judged(Judgment::BEHAVIOR, Judgment::BEHAVIOR)
}

rules!(fn transition(Transition) {
    number: text("number"),
    from: fact("from", Judgment::BEHAVIOR),
    command: fact("command", Judgment::BEHAVIOR),
    documentation,
}, KEY => [to]);

rules!(fn command_outcomes(CommandOutcomes) {
    commands: fact("commands", Judgment::BEHAVIOR),
    availability,
    cells: list(
        Elements::titled(|outcome: &StateOutcome| format!("in state {}", outcome.state))
            .judged(Judgment::BEHAVIOR, Judgment::BEHAVIOR),
        state_outcome,
    ),
    documentation,
}, KEY => [name], POSITION => [origin]);

fn state_outcome(old: &StateOutcome, new: &StateOutcome, comparison: &mut Comparison<'_>) {
    let outcome = |outcome: &Outcome| match outcome {
        Outcome::Unchanged => "state unchanged".to_owned(),
        Outcome::Refused => "refused".to_owned(),
        Outcome::States(states) => states.iter().map(|state| state.as_str()).collect::<Vec<_>>().join(", then "),
    };
    compare_fields!(StateOutcome, old, new, comparison, {
        outcomes: fact_as("outcome", Judgment::BEHAVIOR, |list: &Vec<Outcome>| {
            list.iter().map(outcome).collect::<Vec<_>>().join(" or ")
        }),
        documentation,
    }, KEY => [state]);
}

// Compares procedures. In Rust, a procedure that consists only of object writes becomes a constant.
rules!(pub(super) fn procedure(Procedure) {
    name, names,
    arguments: fact("arguments", Judgment::API),
    steps: fact_as("steps", Judgment::BEHAVIOR, |steps: &Vec<Step>| {
        steps.iter().map(step).collect::<Vec<_>>().join(" ")
    }),
    documentation, doubts,
}, POSITION => [step_spans, origin]);

/// Formats a step for reports. The text distinguishes an argument from a constant value.
fn step(step: &Step) -> String {
    match step {
        Step::WriteArgument(item, argument) => format!("Write the argument {argument} to {item}."),
        _ => PLAIN.step(step),
    }
}
