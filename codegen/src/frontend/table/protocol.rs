//! Codes, state machines, procedures, frames and messages.

use super::at::{At, Literal, TextOr};
use super::definitions::scale;
use super::format::{
    CodeTableRow, CodesTable, FieldTable, FramingTable, MachineTable, MessageTable, PatternTable, ProcedureTable,
    StepTable,
};
use super::tree::{cited, Reader};
use super::{lints, place, process, types, value};
use crate::diagnostics::codes;
use crate::ir::{
    Availability, CodeRow, CodeTable, CompactString, Completion, Device, Framing, Message, MessageField, Procedure,
    StateMachine, Step, Type, Value,
};
use crate::text::brief;

/// A table of codes.
pub(super) fn codes(reader: &mut Reader<'_, '_>, name: &At<String>, table: &CodesTable, device: &mut Device) {
    let mut rows = Vec::with_capacity(table.rows.0.len());
    for (key, row) in table.rows.iter() {
        let Some((first, last)) = place::range(&key.value).filter(|(first, last)| first <= last) else {
            let message = format!("`{}` is no code: write `0x8110` or `\"0xFF13..0xFF15\"`", brief(&key.value));
            reader.report(&codes::TABLE_PLACE, reader.span(key), message);
            continue;
        };
        let plain = CodeTableRow::default();
        let (name, row) = match &row.value {
            TextOr::Text(name) => (Some(name.as_str()), &plain),
            TextOr::Table(row) => (row.name.as_deref(), &**row),
        };
        let (origin, cite) = (reader.origin(key), row.cite.as_ref().map(cited));
        device.doubts.extend(reader.doubts([row.doubt.as_ref(), row.doubts.as_ref()], origin, cite.as_deref()));
        let cell = |literal: &Literal| value::convert(literal, Type::Opaque(None), false).unwrap_or(Value::Bool(false));
        rows.push(CodeRow {
            code: first,
            last: (last > first).then_some(last),
            name: name.unwrap_or_default().into(),
            names: reader.original(row.orig.as_deref()),
            documentation: reader.documentation(row.doc.as_deref(), cite),
            cells: row.cells.iter().map(cell).collect(),
        });
    }
    device.code_tables.push(CodeTable {
        name: name.value.as_str().into(),
        columns: table.columns.iter().map(|column| column.as_str().into()).collect(),
        rows,
        origin: reader.origin(name),
    });
}

/// A state machine. States that transitions name have to exist, and so have commands.
pub(super) fn machine(reader: &mut Reader<'_, '_>, name: &At<String>, table: &MachineTable, device: &mut Device) {
    lints::machine(reader, table);
    let (origin, cite) = (reader.origin(name), table.cite.as_ref().map(cited));
    device.doubts.extend(reader.doubts([table.doubt.as_ref(), table.doubts.as_ref()], origin, cite.as_deref()));
    let patterns = |entries: &super::at::Entries<PatternTable>| -> Vec<(CompactString, u32, u32)> {
        let pattern =
            |(key, own): &(At<String>, At<PatternTable>)| (key.value.as_str().into(), own.value.mask, own.value.value);
        entries.iter().map(pattern).collect()
    };
    let (states, commands) = (patterns(&table.states), patterns(&table.commands));
    let mut transitions = Vec::new();
    for transition in &table.transitions {
        let known = |reader: &mut Reader<'_, '_>,
                     given: Option<&At<String>>,
                     what,
                     list: &[(CompactString, u32, u32)]| {
            let given = given?;
            if !list.iter().any(|(name, ..)| *name == given.value) {
                reader.unresolved(what, &given.value, reader.span(given), list.iter().map(|(name, ..)| name.as_str()));
            }
            Some(CompactString::from(given.value.as_str()))
        };
        let from = known(reader, transition.from.as_ref(), "state", &states).unwrap_or_default();
        let to = known(reader, transition.to.as_ref(), "state", &states).unwrap_or_default();
        let command = known(reader, transition.command.as_ref(), "command", &commands);
        transitions.push((transition.number, from, to, command));
    }
    let item = |given: &Option<At<String>>| given.as_ref().map(|own| own.value.as_str().into()).unwrap_or_default();
    device.machines.push(StateMachine {
        name: name.value.as_str().into(),
        status_item: item(&table.status),
        control_item: item(&table.control),
        states,
        commands,
        transitions,
    });
}

/// A sequence of steps.
pub(super) fn procedure(
    reader: &mut Reader<'_, '_>,
    name: &At<String>,
    table: &ProcedureTable,
    device: &mut Device,
    references: &mut Vec<(At<String>, &'static str)>,
) {
    let (origin, cite) = (reader.origin(name), table.cite.as_ref().map(cited));
    device.doubts.extend(reader.doubts([table.doubt.as_ref(), table.doubts.as_ref()], origin, cite.as_deref()));
    let steps = table.steps.iter().filter_map(|given| step(reader, given, references)).collect();
    device.procedures.push(Procedure {
        name: name.value.as_str().into(),
        steps,
        documentation: reader.documentation(table.doc.as_deref(), cite),
        origin,
    });
}

fn step(
    reader: &mut Reader<'_, '_>,
    given: &At<StepTable>,
    references: &mut Vec<(At<String>, &'static str)>,
) -> Option<Step> {
    let own = &given.value;
    let number = own.value.as_ref().and_then(|literal| value::convert(literal, Type::Opaque(None), false));
    let text = |at: &At<String>| CompactString::from(at.value.as_str());
    let step = match (&own.write, &own.wait, own.delay, &own.send, &own.exchange, &own.manual) {
        (Some(item), None, None, None, None, None) => {
            references.push((item.clone(), "item"));
            Some(Step::Write(text(item), number?))
        }
        (None, Some(item), None, None, None, None) => {
            references.push((item.clone(), "item"));
            Some(Step::WaitFor(text(item), own.mask.unwrap_or(u64::MAX), number?))
        }
        (None, None, Some(milliseconds), None, None, None) => Some(Step::Delay(milliseconds)),
        (None, None, None, Some(message), None, None) => {
            references.push((message.clone(), "message"));
            Some(Step::Send(text(message)))
        }
        (None, None, None, None, Some(exchange), None) => {
            process::direction(reader, Some(exchange)).map(Step::Exchange)
        }
        (None, None, None, None, None, Some(words)) => Some(Step::Manual(words.clone())),
        _ => None,
    };
    if step.is_none() {
        let message =
            "a step has one of `write` and `value`, `wait` and `value`, `delay`, `send`, `exchange`, `manual`";
        reader.report(&codes::TABLE_VALUE, reader.span(given), message);
    }
    step
}

/// How frames are delimited and checked.
pub(super) fn framing(table: &At<FramingTable>, device: &mut Device) {
    let own = &table.value;
    device.framing = Some(Box::new(Framing {
        start: own.start,
        end: own.end,
        escape: own.escape,
        escape_xor: own.escape_xor,
        escaped: own.escaped.clone(),
        check: own.check.as_deref().unwrap_or_default().into(),
        check_seed: own.seed,
        max_data: own.max_data,
    }));
}

/// A request and its reply.
pub(super) fn message(reader: &mut Reader<'_, '_>, table: &At<MessageTable>, device: &mut Device) {
    let own = &table.value;
    let origin =
        reader.origin(own.name.as_ref().unwrap_or(&At { value: String::new(), start: table.start, end: table.end }));
    let cite = own.cite.as_ref().map(cited);
    let completion = match &own.completion {
        None => Completion::Immediate,
        Some(TextOr::Text(word)) if word == "immediate" => Completion::Immediate,
        Some(TextOr::Table(table)) => match (&table.poll, table.delay) {
            (Some(item), None) => Completion::Polled(item.as_str().into()),
            (None, Some(delay)) => Completion::Delayed(delay),
            _ => Completion::Immediate,
        },
        Some(TextOr::Text(word)) => {
            let message = format!("`{}` is no completion: `immediate`, {{ poll = … }} or {{ delay = … }}", brief(word));
            reader.report(&codes::TABLE_VALUE, origin.span, message);
            Completion::Immediate
        }
    };
    let availability = Availability {
        models: own.models.iter().flatten().map(|model| model.value.as_str().into()).collect(),
        since: own.since.as_deref().map(Into::into),
        until: own.until.as_deref().map(Into::into),
        replaced_by: own.replaced_by.as_ref().map(|name| name.value.as_str().into()),
        ..Availability::default()
    };
    let doubts = reader.doubts([own.doubt.as_ref(), own.doubts.as_ref()], origin, cite.as_deref());
    device.messages.push(Message {
        name: own.name.as_ref().map(|name| name.value.as_str().into()).unwrap_or_default(),
        request: fields(reader, &own.request),
        reply: fields(reader, &own.reply),
        completion,
        availability: (availability != Availability::default()).then(|| Box::new(availability)),
        accepted_in: own.accepted_in.iter().map(|state| state.as_str().into()).collect(),
        documentation: reader.documentation(own.doc.as_deref(), cite),
        doubts,
        origin,
    });
}

/// How deep repeated fields are read.
const MAX_DEPTH: usize = 4;

fn fields(reader: &mut Reader<'_, '_>, list: &[At<FieldTable>]) -> Vec<MessageField> {
    nested(reader, list, 0)
}

fn nested(reader: &mut Reader<'_, '_>, list: &[At<FieldTable>], depth: usize) -> Vec<MessageField> {
    list.iter().filter_map(|field| one(reader, field, depth)).collect()
}

fn one(reader: &mut Reader<'_, '_>, field: &At<FieldTable>, depth: usize) -> Option<MessageField> {
    let own = &field.value;
    let found = if let Some(name) = &own.field {
        return typed(reader, field, name);
    } else if let Some(bytes) = &own.bytes {
        Some(MessageField::Constant(bytes.clone()))
    } else if let Some(echo) = &own.echo {
        Some(MessageField::Echo(echo.value.as_str().into()))
    } else if let Some(space) = &own.code {
        Some(MessageField::ItemCode(space.as_str().into()))
    } else if let Some(count) = own.pad {
        Some(MessageField::Padding(count))
    } else if let Some(repeat) = own.repeat.as_ref().filter(|_| depth < MAX_DEPTH) {
        let count = repeat.count.as_deref().map(Into::into);
        Some(MessageField::Repeat { count, max: repeat.max, fields: nested(reader, &repeat.fields, depth + 1) })
    } else {
        own.rest.then_some(MessageField::Rest)
    };
    if found.is_none() {
        let message = "a field is one of `bytes`, `field`, `echo`, `code`, `pad`, `repeat`, `rest`";
        reader.report(&codes::TABLE_VALUE, reader.span(field), message);
    }
    found
}

/// A value in a message.
fn typed(reader: &mut Reader<'_, '_>, field: &At<FieldTable>, name: &At<String>) -> Option<MessageField> {
    let own = &field.value;
    let ty = own.ty.as_ref().and_then(|ty| types::named(&ty.value)).filter(|named| named.elements.is_none());
    let Some(named) = ty else {
        reader.report(
            &codes::TABLE_VALUE,
            reader.span(name),
            format!("the field `{}` has no `type`", brief(&name.value)),
        );
        return None;
    };
    Some(MessageField::Value {
        name: name.value.as_str().into(),
        ty: named.ty,
        byte_order: own.order.as_ref().map(|order| byte_order(reader, order)).unwrap_or_default(),
        unit: own.unit.as_ref().map(|unit| unit.value.as_str().into()).unwrap_or_default(),
        scale: scale(own.scale.as_ref().map(|scale| &scale.value), None),
    })
}

/// `CDAB`: the bytes in the order of the wire, the most significant one being `A`.
fn byte_order(reader: &mut Reader<'_, '_>, order: &At<String>) -> Vec<u8> {
    let bytes: Vec<u8> = order.value.bytes().map(|letter| letter.wrapping_sub(b'A')).collect();
    let mut sorted = bytes.clone();
    sorted.sort_unstable();
    let is_order = (1..=8).contains(&bytes.len()) && sorted.iter().zip(0u8..).all(|(own, expected)| *own == expected);
    if is_order {
        return bytes;
    }
    let message = format!("`{}` is no order of bytes: each letter from `A` on once, as in `CDAB`", brief(&order.value));
    reader.report(&codes::TABLE_VALUE, reader.span(order), message);
    Vec::new()
}
