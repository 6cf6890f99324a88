//! Resolves the references to fields of messages.

use crate::collections::HashMap;
use crate::ir::owner::Owner;
use crate::ir::{
    CompactString, Completion, Device, FieldId, Message, MessageField, MessageId, MessageValue, PolledCommand, Shape,
    Value,
};

/// Sets the ids of the references to fields, and the commands of polled values. A field of a reply can copy a value of the
/// request. A length field and the first field whose bytes it counts must be in the same list of fields. The same applies to
/// repeated fields and their count. For each message, a name in the framing refers to the value with this name in the
/// request, if there is one.
pub(super) fn run(device: &mut Device) {
    let framing = device.framing.as_deref();
    for message in &mut device.messages {
        let requested = |name: &Option<CompactString>| find(&message.request, name.as_ref()?, value_name);
        message.address = framing.and_then(|framing| requested(&framing.address));
        message.check_from = framing.and_then(|framing| requested(&framing.check_from));
        copies(&mut message.reply, &message.request);
        within(&mut message.request);
        within(&mut message.reply);
    }
    polled(device);
}

/// Sets [`MessageValue::completes`] of the values in replies, except values in repeated fields.
fn polled(device: &mut Device) {
    let commands = Commands::new(&device.messages);
    if commands.0.is_empty() {
        return;
    }
    let owner = Owner::of_types(&device.types);
    for (id, message) in (0..).map(MessageId).zip(&mut device.messages) {
        for field in &mut message.reply {
            if let MessageField::Value(value) = field {
                value.completes = commands.of(id, value, owner);
            }
        }
    }
}

/// A command that polls a value, and the condition that completes it.
struct Polling {
    command: MessageId,
    condition: Condition,
}

#[derive(PartialEq)]
struct Condition {
    /// Name of the polled bit.
    bit: Option<CompactString>,
    mask: Option<u64>,
    expected: Option<Value>,
}

/// The commands that poll each item or field, in the order of the messages.
struct Commands(HashMap<CompactString, Vec<Polling>>);

impl Commands {
    fn new(messages: &[Message]) -> Self {
        let mut all = HashMap::<CompactString, Vec<Polling>>::default();
        for (command, message) in (0..).map(MessageId).zip(messages) {
            let Completion::Polled { item, mask, value, .. } = &message.completion else { continue };
            let (field, bit) = match item.split_once('.') {
                Some((field, bit)) => (field, Some(bit.into())),
                None => (item.as_str(), None),
            };
            let condition = Condition { bit, mask: *mask, expected: value.clone() };
            all.entry(field.into()).or_default().push(Polling { command, condition });
        }
        Commands(all)
    }

    /// Returns the command that polls `value`, a value in the reply to the message `replied`. If `replied` polls the value,
    /// the result is `replied`. Otherwise, it is the first command that polls the value, provided that all commands that
    /// poll the value have the same condition. Returns `None` if there is no such command, or if the type of the value does
    /// not have the bit that the command polls.
    fn of(&self, replied: MessageId, value: &MessageValue, owner: Owner<'_>) -> Option<PolledCommand> {
        let all = self.0.get(&value.item.name)?;
        let of_replied = all.iter().find(|polling| polling.command == replied);
        let common = || all.first().filter(|first| all.iter().all(|polling| polling.condition == first.condition));
        let Polling { command, condition } = of_replied.or_else(common)?;
        let bits = match &condition.bit {
            Some(bit) => Some(position_of_bits(bit, value, owner)?),
            None => None,
        };
        Some(PolledCommand { message: *command, bits })
    }
}

fn position_of_bits(name: &str, value: &MessageValue, owner: Owner<'_>) -> Option<u32> {
    let Shape::BitField { fields, .. } = &owner.definition(value.item.ty)?.shape else { return None };
    let position = fields.iter().position(|field| field.name == name)?;
    Some(position as u32)
}

fn copies(reply: &mut [MessageField], request: &[MessageField]) {
    for field in reply {
        match field {
            MessageField::Echo { field, .. } => field.id = find(request, field, value_name),
            MessageField::Repeat { fields, .. } => copies(fields, request),
            _ => {}
        }
    }
}

fn within(fields: &mut [MessageField]) {
    for position in 0..fields.len() {
        let id = match &fields[position] {
            MessageField::Value(value) => value.counts.as_ref().and_then(|first| find(fields, first, any_name)),
            MessageField::Repeat { count, .. } => count.as_ref().and_then(|count| find(fields, count, value_name)),
            _ => None,
        };
        match &mut fields[position] {
            MessageField::Value(value) => value.counts.iter_mut().for_each(|first| first.id = id),
            MessageField::Repeat { count, fields, .. } => {
                count.iter_mut().for_each(|count| count.id = id);
                within(fields);
            }
            _ => {}
        }
    }
}

/// Returns the id of the first field whose name is `wanted`.
fn find(fields: &[MessageField], wanted: &str, name: fn(&MessageField) -> Option<&str>) -> Option<FieldId> {
    let position = fields.iter().position(|field| name(field) == Some(wanted))?;
    Some(FieldId(position as u32))
}

fn value_name(field: &MessageField) -> Option<&str> {
    match field {
        MessageField::Value(value) => Some(&value.item.name),
        _ => None,
    }
}

fn any_name(field: &MessageField) -> Option<&str> {
    match field {
        MessageField::Echo { field, .. } => Some(field),
        other => value_name(other),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ir::{Binding, BitFieldEntry, BitMeaning, Framing, Item, Type, TypeDef, TypeId};

    fn value(name: &str, counts: Option<&str>) -> MessageField {
        let item = Item { name: name.into(), ..Item::new(Binding::canopen(0, 0)) };
        MessageField::Value(Box::new(MessageValue {
            item,
            byte_order: Vec::new(),
            counts: counts.map(Into::into),
            completes: None,
        }))
    }

    fn echo(name: &str) -> MessageField {
        MessageField::Echo { field: name.into(), bytes: None }
    }

    fn repeat(count: &str, fields: Vec<MessageField>) -> MessageField {
        MessageField::Repeat { count: Some(count.into()), max: None, fields }
    }

    /// Returns the positions of the referenced fields, one for each reference in the order of the fields. The position of an
    /// unresolved reference is `None`.
    fn targets(fields: &[MessageField]) -> Vec<Option<u32>> {
        let mut all = Vec::new();
        for field in fields {
            match field {
                MessageField::Echo { field, .. } => all.push(field.id),
                MessageField::Value(value) => all.extend(value.counts.as_ref().map(|first| first.id)),
                MessageField::Repeat { count, fields, .. } => {
                    all.extend(count.as_ref().map(|count| count.id));
                    all.extend(targets(fields).into_iter().map(|id| id.map(FieldId)));
                }
                _ => {}
            }
        }
        all.into_iter().map(|id| id.map(|FieldId(position)| position)).collect()
    }

    #[test]
    fn references_to_fields_become_positions() {
        let request = vec![value("node", None), value("speed", None), value("length", Some("speed"))];
        let reply = vec![
            MessageField::Padding(1),
            echo("speed"),
            value("count", Some("speed")),
            value("speed", Some("missing")),
            repeat("count", vec![value("entry", None), echo("node"), repeat("entry", Vec::new())]),
            repeat("entry", Vec::new()),
        ];
        let message = Message { request, reply, ..Message::default() };
        let framing = Framing { address: Some("node".into()), check_from: Some("speed".into()), ..Framing::default() };
        let mut device = Device {
            messages: vec![message, Message::default()],
            framing: Some(Box::new(framing)),
            ..Device::default()
        };
        run(&mut device);
        let [message, other] = &device.messages[..] else { panic!("{device:?}") };
        assert_eq!((message.address, message.check_from), (Some(FieldId(0)), Some(FieldId(1))));
        assert_eq!((other.address, other.check_from), (None, None));
        assert_eq!(targets(&message.request), [Some(1)]);
        // The first field named `speed` in the reply is the copy. The field with the number of repetitions must be in the
        // list that contains the `Repeat`, so the last reference is not resolved.
        assert_eq!(targets(&message.reply), [Some(1), Some(1), None, Some(2), Some(0), Some(0), None]);
    }

    /// Returns a message whose reply contains one value, and whose completion polls `item`.
    fn polling(item: &str, field: &str, ty: Type) -> Message {
        let mut value = value(field, None);
        if let MessageField::Value(value) = &mut value {
            value.item.ty = ty;
        }
        let completion = Completion::Polled { item: item.into(), mask: None, value: None, in_reply: false };
        Message { reply: vec![value], completion, ..Message::default() }
    }

    #[test]
    fn values_in_replies_refer_to_the_command_that_polls_them() {
        let field = |name: &str, offset| BitFieldEntry::new(name.into(), offset, 1, BitMeaning::Number);
        let fields = vec![field("error", 0), field("done", 1)];
        let status = TypeDef::new("Status", Shape::BitField { base: Type::Unsigned(8), fields }, Some(8));
        let named = Type::Named(TypeId(0));
        let messages = vec![
            polling("status.done", "status", Type::Unsigned(8)),
            polling("position", "position", Type::Unsigned(8)),
            polling("elsewhere", "status", named),
            polling("position", "position", named),
            polling("status.done", "speed", named),
        ];
        let mut device = Device { messages, types: vec![status], ..Device::default() };
        run(&mut device);
        let values = device.messages.iter().flat_map(Message::values);
        let command = |message, bits| Some(PolledCommand { message: MessageId(message), bits });
        let expected = [None, command(1, None), command(0, Some(1)), command(3, None), None];
        assert_eq!(values.map(|value| value.completes).collect::<Vec<_>>(), expected);
    }

    /// If several commands poll a value with different conditions, the value refers to a command only in the reply to that
    /// command.
    #[test]
    fn values_with_several_conditions_refer_only_to_the_command_of_their_reply() {
        let mut messages = [("status", "status"), ("status", "status"), ("speed", "status")]
            .map(|(item, field)| polling(item, field, Type::Unsigned(8)));
        if let Completion::Polled { mask, .. } = &mut messages[1].completion {
            *mask = Some(2);
        }
        let mut device = Device { messages: messages.into(), ..Device::default() };
        run(&mut device);
        let commands = device.messages.iter().flat_map(Message::values).map(|value| Some(value.completes?.message.0));
        assert_eq!(commands.collect::<Vec<_>>(), [Some(0), Some(1), None]);
    }
}
