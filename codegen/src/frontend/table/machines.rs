//! Reads state machines and procedures.

use super::at::At;
use super::format::{MachineTable, ProcedureTable, StepTable, TransitionTable};
use super::machine_budget::MachineBudget;
use super::outcomes::Names;
use super::states::{patterns, states};
use super::tree::Reader;
use super::{lints, outcomes, process, value};
use crate::diagnostics::codes;
use crate::ir::{CompactString, Device, ItemRef, MessageField, Procedure, StateMachine, Step, Transition, Type, Value};

fn text(at: &At<String>) -> CompactString {
    at.value.as_str().into()
}

/// Reads a state machine. Reports unknown names of states and commands. A message of the device may serve as a command.
/// Returns `false` if the machine exceeds `budget`. In this case, the caller must ignore all further machines.
pub(super) fn machine(
    reader: &mut Reader<'_, '_>,
    name: &At<String>,
    table: &MachineTable,
    device: &mut Device,
    budget: &mut MachineBudget,
) -> bool {
    if !budget.take(reader, name, table, device) {
        return false;
    }
    lints::machine(reader, table);
    let mut doubts = reader.doubts_of(table, reader.origin(name));
    let (state_type, states) = states(reader, table, device);
    let commands = patterns(reader, &table.commands);
    let names = Names::new(&states, &commands, device);
    let transitions: Vec<Transition> =
        table.transitions.iter().flat_map(|given| transition(reader, given, &names)).collect();
    for item in [&table.status, &table.control].into_iter().flatten() {
        if !is_field_of_reply(device, &item.value) {
            reader.mention([item], "item");
        }
    }
    if let Some(initial) = &table.initial {
        names.state(reader, &initial.value, reader.span(initial));
    }
    for fault in &table.faults {
        names.state(reader, &fault.value, reader.span(fault));
    }
    let mut rows = Vec::new();
    if let Some(matrix) = &table.matrix {
        rows = outcomes::read(reader, &matrix.value, &names);
        doubts.extend(outcomes::doubts(reader, matrix));
    }
    device.machines.push(StateMachine {
        name: text(name),
        status_item: table.status.as_ref().map(|name| reader.reference(name)).unwrap_or_default(),
        control_item: table.control.as_ref().map(|name| reader.reference(name)).unwrap_or_default(),
        state_type,
        states: states.into(),
        initial: table.initial.as_ref().map(|name| reader.reference(name)),
        faults: table.faults.iter().map(|name| reader.reference(name)).collect(),
        commands: commands.into(),
        transitions: transitions.into(),
        outcomes: rows,
        documentation: reader.documentation_of(table),
        doubts,
        stated_by: None,
    });
    true
}

/// Returns whether a text names a field in the reply to a message, as in `Message.field`.
fn is_field_of_reply(device: &Device, text: &str) -> bool {
    text.rsplit_once('.').is_some_and(|(message, field)| {
        let reply = device.messages.iter().find(|known| known.name == message).map(|known| known.reply.as_slice());
        reply.unwrap_or_default().iter().any(|reply_field| match reply_field {
            MessageField::Value(value) => value.item.name == field,
            _ => false,
        })
    })
}

/// Reads a row of transitions. Returns one transition for each state that the row names as `from`, or one transition
/// from any state if the row names none.
fn transition(reader: &mut Reader<'_, '_>, given: &At<TransitionTable>, names: &Names<'_>) -> Vec<Transition> {
    let row = &given.value;
    let from: Vec<&String> = row.from.iter().flat_map(|list| &list.value.0).collect();
    if let Some(list) = &row.from {
        from.iter().for_each(|name| names.state(reader, name, reader.span(list)));
    }
    if let Some(to) = &row.to {
        names.state(reader, &to.value, reader.span(to));
    }
    if let Some(command) = &row.command {
        names.command(reader, &command.value, reader.span(command));
    }
    if row.to.is_none() {
        reader.report(&codes::TABLE_VALUE, reader.span(given), "a transition needs `to`, the next state");
    }
    let one = |from: Option<&String>| Transition {
        number: row.number,
        from: from.map(|name| name.as_str().into()),
        to: row.to.as_ref().map(|name| reader.reference(name)).unwrap_or_default(),
        command: row.command.as_ref().map(|command| reader.reference(command)),
        documentation: reader.documentation_of(row),
    };
    match from.is_empty() {
        true => vec![one(None)],
        false => from.into_iter().map(|name| one(Some(name))).collect(),
    }
}

/// Reads a procedure, which is a sequence of steps.
pub(super) fn procedure(reader: &mut Reader<'_, '_>, name: &At<String>, table: &ProcedureTable, device: &mut Device) {
    let origin = reader.origin(name);
    let doubts = reader.doubts_of(table, origin);
    for argument in table.steps.iter().filter_map(|step| step.value.argument.as_ref()) {
        if !table.arguments.iter().any(|known| known.value == argument.value) {
            let known = table.arguments.iter().map(|known| known.value.as_str());
            reader.unresolved("argument", &argument.value, reader.span(argument), known);
        }
    }
    let mut steps = Vec::with_capacity(table.steps.len());
    let mut step_spans = Vec::with_capacity(table.steps.len());
    for given in &table.steps {
        if let Some(step) = step(reader, given) {
            steps.push(step);
            step_spans.push(reader.span(given));
        }
    }
    device.procedures.push(Procedure {
        name: text(name),
        names: reader.original(table.orig.as_deref()),
        arguments: table.arguments.iter().map(text).collect(),
        steps,
        step_spans,
        documentation: reader.documentation_of(table),
        doubts,
        origin,
    });
}

/// Message for a step with an invalid combination of keys.
const STEP: &str =
    "a step must be one of: `write` with `value` (and `mask`) or `argument`; `read`; `wait` with `value` (and \
                    `mask`, `timeout`); `delay`; `send`; `exchange`; `manual`";

fn step(reader: &mut Reader<'_, '_>, given: &At<StepTable>) -> Option<Step> {
    let row = &given.value;
    let number = row.value.as_ref().and_then(|literal| value::convert(literal, Type::Opaque(None), false));
    let given_keys = [
        row.write.is_some(),
        row.read.is_some(),
        row.wait.is_some(),
        row.delay.is_some(),
        row.send.is_some(),
        row.exchange.is_some(),
        row.manual.is_some(),
    ];
    let is_one = given_keys.iter().filter(|is_given| **is_given).count() == 1;
    let has_value = row.value.is_some() || row.mask.is_some() || row.timeout.is_some() || row.argument.is_some();
    let found = if !is_one {
        None
    } else if let Some(item) = &row.write {
        reader.mention([item], "item");
        written(row, reader.reference(item), number)
    } else if let Some(item) = &row.wait {
        reader.mention([item], "item");
        let mask = row.mask.as_ref().map_or(u64::MAX, |mask| mask.value);
        let timeout = row.timeout.as_ref().map(|timeout| timeout.value);
        number
            .filter(|_| row.argument.is_none())
            .map(|value| Step::WaitFor(reader.reference(item), mask, value, timeout))
    } else if has_value {
        None
    } else if let Some(item) = &row.read {
        reader.mention([item], "item");
        Some(Step::Read(reader.reference(item)))
    } else if let Some(message) = &row.send {
        reader.mention([message], "message");
        Some(Step::Send(reader.reference(message)))
    } else if let Some(exchange) = &row.exchange {
        return process::direction(reader, Some(exchange)).map(Step::Exchange);
    } else if let Some(words) = &row.manual {
        Some(Step::Manual(words.clone()))
    } else {
        row.delay.map(Step::Delay)
    };
    if found.is_none() {
        reader.report(&codes::TABLE_VALUE, reader.span(given), STEP);
    }
    found
}

fn written(step: &StepTable, item: ItemRef, number: Option<Value>) -> Option<Step> {
    match (number, &step.argument, &step.mask, &step.timeout) {
        (Some(value), None, None, None) => Some(Step::Write(item, value)),
        (Some(value), None, Some(mask), None) => Some(Step::WriteBits(item, mask.value, value)),
        (None, Some(argument), None, None) => Some(Step::WriteArgument(item, text(argument))),
        _ => None,
    }
}
