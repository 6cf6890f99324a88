//! Random serial protocols: requests and replies, parameter spaces and framing.

use lexibus_codegen::ir::{
    CompactString, Completion, Framing, Message, MessageExample, MessageField, MessageValue, ParameterSpace, SpaceRef,
    Value,
};
use lexibus_codegen::source::Origin;

use super::bytes::Bytes;
use super::facts::{availability, condition};
use super::items::{unbound, Around};
use super::names;
use super::values;

/// Returns the messages of a device.
pub fn messages(b: &mut Bytes<'_>, around: &Around<'_>, most: usize) -> Vec<Message> {
    let mut messages: Vec<Message> = Vec::new();
    for _ in 0..b.within(0..=most) {
        let known: Vec<CompactString> = messages.iter().map(|message| message.name.clone()).collect();
        let message = message(b, around, &known);
        messages.push(message);
    }
    messages
}

fn message(b: &mut Bytes<'_>, around: &Around<'_>, known: &[CompactString]) -> Message {
    let request = if b.one_in(12) { Vec::new() } else { frame(b, around, None) };
    let reply = if b.one_in(8) { Vec::new() } else { frame(b, around, Some(&request)) };
    let completion = match b.within(0..=5) {
        0 => Completion::Reply,
        1 => Completion::Delayed(b.any()),
        2 | 3 => Completion::Polled {
            item: names::of(b, &fields(&reply)).into(),
            mask: b.maybe(2, |b| b.pick(&[1, 0x80, u64::MAX])),
            value: b.maybe(2, |b| Value::Int(values::number(b))),
            in_reply: b.any(),
        },
        _ => Completion::Immediate,
    };
    Message {
        name: names::name(b),
        request,
        reply,
        address: None,
        check_from: None,
        completion,
        reply_time: b.maybe(6, Bytes::any),
        after: b.maybe(5, |b| names::of(b, known).into()),
        by_default: b.one_in(5),
        error: b.maybe(4, |b| names::of(b, known).into()),
        side_effects: b.few(6, 2, names::text),
        accepted_when: b.few(6, 2, condition),
        names: names::texts(b),
        availability: b.maybe(6, availability).map(Box::new),
        accepted_in: b.few(6, 2, |b| names::name(b).into()),
        examples: b.few(8, 1, example),
        documentation: names::documentation(b),
        doubts: names::doubts(b),
        origin: Origin::default(),
    }
}

pub fn example(b: &mut Bytes<'_>) -> MessageExample {
    let [request, reply] = [0; 2].map(|_| b.list(6, Bytes::any));
    MessageExample { request, reply, documentation: names::documentation(b), ..MessageExample::default() }
}

/// Returns the names of the values in a frame, except values in repeated fields.
fn fields(frame: &[MessageField]) -> Vec<CompactString> {
    let name = |field: &MessageField| match field {
        MessageField::Value(value) => Some(value.item.name.clone()),
        _ => None,
    };
    frame.iter().filter_map(name).collect()
}

/// Returns the fields of a request or, if `request` is `Some`, of the reply to this request.
fn frame(b: &mut Bytes<'_>, around: &Around<'_>, request: Option<&[MessageField]>) -> Vec<MessageField> {
    let asked = request.map(fields).unwrap_or_default();
    let mut frame: Vec<MessageField> = Vec::new();
    for _ in 0..b.within(0..=5) {
        let names_of_fields = fields(&frame);
        match b.within(0..=15) {
            0..=2 => frame.push(MessageField::Constant(b.list(3, Bytes::any))),
            3 => frame.extend(bits(b)),
            4..=8 => frame.push(value(b, around, &names_of_fields)),
            9 if request.is_some() => {
                let bytes = b.maybe(4, |b| (0, b.within(0..=1)));
                frame.push(MessageField::Echo { field: names::of(b, &asked).into(), bytes });
            }
            10 if request.is_some() => frame.push(MessageField::Copy { first: b.within(0..=2), last: b.within(0..=4) }),
            11 => frame.extend(parameter(b, around)),
            12 => frame.push(MessageField::Padding(b.within(0..=4))),
            13 => frame.extend(repeat(b, around)),
            14 => frame.push(MessageField::Rest),
            _ => frame.push(MessageField::Constant(vec![b.any()])),
        }
    }
    frame
}

/// Returns two bit fields that usually have eight bits in total.
fn bits(b: &mut Bytes<'_>) -> [MessageField; 2] {
    let first = b.within(1..=7);
    let last = if b.one_in(8) { 1 } else { 8 - first };
    [first, last].map(|bits| MessageField::FixedBits { bits, value: b.any::<u64>() & ((1 << bits) - 1) })
}

fn value(b: &mut Bytes<'_>, around: &Around<'_>, before: &[CompactString]) -> MessageField {
    let item = unbound(b, around);
    let bytes = super::types::base(around.types, item.ty).bits().unwrap_or(0) / 8;
    let byte_order = if b.one_in(4) { (0..bytes.min(8) as u8).rev().collect() } else { Vec::new() };
    let counts = if before.is_empty() { None } else { b.maybe(6, |b| names::of(b, before).into()) };
    MessageField::Value(Box::new(MessageValue { item, byte_order, counts, completes: None }))
}

/// Returns fields with a parameter number, a parameter value, or both. The fields may be repeated.
fn parameter(b: &mut Bytes<'_>, around: &Around<'_>) -> Vec<MessageField> {
    let space = SpaceRef::from(names::of(b, around.spaces));
    let code = MessageField::ItemCode { space: space.clone(), bits: b.pick(&[8, 16, 32, 12, 33]) };
    match b.within(0..=4) {
        0 => vec![code],
        1 => vec![code, MessageField::ItemPadding { space }],
        2 => vec![MessageField::ItemValue { space }],
        3 => {
            let max = b.maybe(2, |b| b.within(0..=9));
            vec![MessageField::Repeat { count: None, max, fields: vec![code, MessageField::ItemValue { space }] }]
        }
        _ => vec![code, MessageField::ItemValue { space }],
    }
}

/// Returns a repeated group of fields. A field with the number of repetitions may precede the group.
fn repeat(b: &mut Bytes<'_>, around: &Around<'_>) -> Vec<MessageField> {
    let count = unbound(b, around);
    let max = b.maybe(2, |b| b.within(0..=9));
    let mut fields = vec![value(b, around, &[])];
    fields.extend(b.list(2, |b| if b.one_in(3) { MessageField::Padding(1) } else { value(b, around, &[]) }));
    if b.one_in(2) {
        return vec![MessageField::Repeat { count: None, max, fields }];
    }
    let name = count.name.clone();
    let count = MessageValue { item: count, byte_order: Vec::new(), counts: None, completes: None };
    let count = MessageField::Value(Box::new(count));
    vec![count, MessageField::Repeat { count: Some(name.into()), max, fields }]
}

/// Returns a parameter space to which these messages give access.
pub fn space(b: &mut Bytes<'_>, name: CompactString, messages: &[CompactString]) -> ParameterSpace {
    ParameterSpace {
        name,
        read: b.maybe(2, |b| names::of(b, messages).into()),
        write: b.maybe(2, |b| names::of(b, messages).into()),
        store: b.maybe(4, |b| names::of(b, messages).into()),
        byte_order: b.pick(&[vec![], vec![], vec![1, 0], vec![3, 2, 1, 0]]),
        documentation: names::documentation(b),
        origin: Origin::default(),
    }
}

/// Returns a framing. If the framing has a device address, the address is usually a field of a request.
pub fn framing(b: &mut Bytes<'_>, messages: &[Message]) -> Framing {
    let requested: Vec<CompactString> = messages.iter().flat_map(|message| fields(&message.request)).collect();
    Framing {
        start: b.maybe(2, Bytes::any),
        end: b.maybe(2, Bytes::any),
        escape: b.maybe(2, Bytes::any),
        escape_xor: b.any(),
        escaped: b.list(3, Bytes::any),
        check: b.pick(&["", "xor", "sum", "lrc", "crc16", "odd"]).into(),
        check_from: b.maybe(3, |b| names::of(b, &requested)),
        check_escaped: b.any(),
        check_seed: b.any(),
        max_data: b.maybe(2, |b| b.within(0..=64)),
        address: b.maybe(2, |b| names::of(b, &requested)),
        documentation: names::documentation(b),
        origin: Origin::default(),
    }
}
