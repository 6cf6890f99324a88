//! Compares command protocols: messages, parameter spaces and framing.

use super::change::{Effect, Judgment};
use super::comparison::{
    compare_fields, each, each_positioned, fact, fact_as, list, rules, Comparison, Elements, KEY, POSITION,
};
use super::conditions::{conditions, restricted};
use super::item;
use super::names::identifier;
use super::texts::described;
use lexibus_codegen::facts::words::PLAIN;
use lexibus_codegen::ir::{
    CompactString, Completion, Framing, Message, MessageExample, MessageField, MessageValue, ParameterSpace,
};
use lexibus_codegen::number::{bytes, hex, hex8};

pub(super) fn compare(old: &[Message], new: &[Message], comparison: &mut Comparison<'_>) {
    let elements = Elements::titled(|message: &Message| format!("message {}", message.name))
        .paired_by(|message| identifier(&message.name));
    super::comparison::slices(old, new, &elements, message, comparison);
}

rules!(fn message(Message) {
    name,
    request: frame("request"),
    reply: frame("reply"),
    completion: fact_as("completion", Judgment::BEHAVIOR, completion),
    reply_time: fact("time of the reply in ms", Judgment::BEHAVIOR),
    after: fact("after the message", Judgment::API),
    by_default: fact("default after power-on", Judgment::BEHAVIOR),
    error: fact("error reply", Judgment::API_AND_WIRE),
    side_effects: each("side effects", Judgment::BEHAVIOR, CompactString::to_string),
    accepted_when: conditions("accepted while"),
    names, availability,
    accepted_in: restricted("accepted in"),
    examples: each_positioned("examples", example),
    documentation, doubts,
}, "follows from the framing" => [address, check_from], POSITION => [origin]);

/// Formats the example frames of a message without their source positions.
pub(super) fn example(example: &MessageExample) -> String {
    let text = described(example.documentation.as_deref());
    format!("{} → {} {text}", bytes(&example.request), bytes(&example.reply)).trim_end().to_owned()
}

fn completion(completion: &Completion) -> String {
    match completion {
        Completion::Immediate => "before the reply".to_owned(),
        Completion::Reply => "when the reply comes".to_owned(),
        Completion::Polled { item, mask, value, in_reply } => {
            let mask = mask.map(|mask| format!(" & {}", hex(mask))).unwrap_or_default();
            let value = value.as_ref().map_or_else(|| "not 0".to_owned(), |value| PLAIN.value(value));
            let reply = if *in_reply { ", from the reply on" } else { "" };
            format!("when {item}{mask} is {value}{reply}")
        }
        Completion::Delayed(milliseconds) => format!("after {milliseconds} ms"),
    }
}

/// Returns a rule that compares the layout and the values of a frame.
fn frame(name: &'static str) -> impl Fn(&Vec<MessageField>, &Vec<MessageField>, &mut Comparison<'_>) {
    let title = |value: &&MessageValue| value.item.name.to_string();
    move |old, new, comparison| {
        comparison.texts(name, layout(old, true), layout(new, true), frame_effects(old, new));
        for (old, new) in super::pairing::pairs(&values(old), &values(new), title, |_| String::new()) {
            // Added and removed values are part of the layout, which was compared above.
            if let (Some(old), Some(new)) = (old, new) {
                comparison.within(&format!("{name} {}", new.item.name), |comparison| value(old, new, comparison));
            }
        }
    }
}

fn values(fields: &[MessageField]) -> Vec<&MessageValue> {
    let mut all = Vec::new();
    for field in fields {
        match field {
            MessageField::Value(value) => all.push(value.as_ref()),
            MessageField::Repeat { fields, .. } => all.extend(values(fields)),
            _ => {}
        }
    }
    all
}

rules!(fn value(MessageValue) {
    item: item::compare,
    byte_order: fact("order of the bytes", Judgment::WIRE),
    counts: fact("byte count starts at", Judgment::WIRE),
}, "follows from the completion of messages" => [completes]);

/// Returns the effects of a changed layout. The fields become fields of a Rust struct with the same names. The types of the
/// values are compared separately, together with the values.
fn frame_effects(old: &[MessageField], new: &[MessageField]) -> Judgment {
    let names = |fields| values(fields).iter().map(|value| identifier(&value.item.name)).collect::<Vec<_>>();
    let effect = |breaks: bool| if breaks { Effect::Breaking } else { Effect::Unaffected };
    let is_wire = layout(old, false) != layout(new, false);
    Judgment { api: effect(names(old) != names(new)), wire: effect(is_wire), behavior: Effect::Unaffected }
}

/// Formats the fields of a frame in their order.
fn layout(fields: &[MessageField], with_names: bool) -> String {
    fields.iter().map(|one| field(one, with_names)).collect::<Vec<_>>().join(", ")
}

fn field(field: &MessageField, with_names: bool) -> String {
    match field {
        MessageField::Constant(constant) => bytes(constant),
        MessageField::FixedBits { bits, value } => format!("{value} in {bits} bits"),
        MessageField::Value(value) if with_names => value.item.name.to_string(),
        MessageField::Value(_) => "a value".to_owned(),
        MessageField::Echo { field, bytes } => match bytes {
            Some((first, last)) => format!("bytes {first} to {last} of {field}"),
            None => format!("{field} of the request"),
        },
        MessageField::Copy { first, last } => format!("bytes {first} to {last} of the request"),
        MessageField::ItemCode { space, bits } => format!("number of {space} in {bits} bits"),
        MessageField::ItemValue { space } => format!("value of {space}"),
        MessageField::ItemPadding { space } => format!("zeros of {space}"),
        MessageField::Padding(bytes) => format!("{bytes} bytes without meaning"),
        MessageField::Repeat { count, max, fields } => {
            let max = max.map(|max| format!(", at most {max}")).unwrap_or_default();
            format!(
                "{} times{max} ({})",
                count.as_ref().map_or("any", |count| count.as_str()),
                layout(fields, with_names)
            )
        }
        MessageField::Rest => "the rest".to_owned(),
    }
}

// Compares parameter spaces: the ranges of numbers with which the protocol addresses items.
rules!(pub(super) fn space(ParameterSpace) {
    read: fact("read by", Judgment::WIRE),
    write: fact("written by", Judgment::WIRE),
    store: fact("stored by", Judgment::WIRE),
    byte_order: fact("order of the bytes", Judgment::WIRE),
    documentation,
}, KEY => [name], POSITION => [origin]);

/// Compares parameter spaces, which are paired by name.
pub(super) fn spaces() -> impl Fn(&Vec<ParameterSpace>, &Vec<ParameterSpace>, &mut Comparison<'_>) {
    list(Elements::titled(|space: &ParameterSpace| format!("parameter space {}", space.name)), space)
}

/// Compares how the protocol delimits and checks frames.
pub(super) fn framing(old: &Framing, new: &Framing, comparison: &mut Comparison<'_>) {
    let byte = |value: &Option<u8>| value.map(hex8).unwrap_or_default();
    compare_fields!(Framing, old, new, comparison, {
        start: fact_as("first byte", Judgment::WIRE, byte),
        end: fact_as("last byte", Judgment::WIRE, byte),
        escape: fact_as("escape byte", Judgment::WIRE, byte),
        escape_xor: fact_as("escaped bytes are combined with", Judgment::WIRE, |value| hex8(*value)),
        escaped: fact_as("escaped bytes", Judgment::WIRE, |escaped: &Vec<u8>| bytes(escaped)),
        check: fact("check", Judgment::WIRE),
        check_from: fact("check counts from", Judgment::WIRE),
        check_escaped: fact("check is escaped", Judgment::WIRE),
        check_seed: fact_as("start value of the check", Judgment::WIRE, |value| hex(*value)),
        max_data: fact("maximum number of data bytes", Judgment::BEHAVIOR),
        address: fact("device address field", Judgment::API_AND_WIRE),
        documentation,
    }, POSITION => [origin]);
}
