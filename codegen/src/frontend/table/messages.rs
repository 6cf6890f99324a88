//! Reads the messages of a command protocol, and the spaces whose parameters they transfer.

use super::at::{At, FlagOr, Literal, TextOr};
use super::format::{field_row, CompletionTable, ExampleTable, FieldTable, MessageTable, NumberOrText, Row};
use super::references::ITEM_OR_FIELD;
use super::rows::{Named, Rows};
use super::tree::Reader;
use super::{conditions, framing, notation, types, value, Table};
use crate::collections::HashSet;
use crate::diagnostics::codes;
use crate::ir::owner::Owner;
use crate::ir::{
    Access, Binding, CompactString, Completion, Device, Doubts, Item, Message, MessageExample, MessageField,
    MessageValue, ParameterSpace, SpaceRef, Type, Value,
};
use crate::limits;
use crate::resolve::messages::fixed_bits;
use crate::text::brief;

/// Maximum depth of nested repeated fields.
const MAX_DEPTH: usize = 4;

fn text(at: &At<String>) -> CompactString {
    at.value.as_str().into()
}

/// Reads the messages of a table, the delimiters and checksum of the frames, and the spaces whose parameters the
/// messages transfer.
pub(super) fn read<'a>(reader: &mut Reader<'a, '_>, file: &mut Table<'a>, rows: &mut Rows, device: &mut Device) {
    let mut names = HashSet::default();
    let tables = file.list::<MessageTable>(reader, "messages");
    device.messages.reserve_exact(tables.len().min(limits::MAX_MESSAGES));
    for table in tables {
        rows.allow_at(reader, (table.start, end(&table)), &table.value.allow);
        if device.messages.len() >= limits::MAX_MESSAGES {
            too_many(reader, &table);
            break;
        }
        message(reader, rows, &table, device, &mut names);
    }
    if let Some(table) = file.take(reader, "framing") {
        framing::read(reader, &table, device);
    }
    spaces(reader, file, device);
}

/// Reads the spaces whose key `parameter` names the messages that transfer parameters.
fn spaces(reader: &mut Reader<'_, '_>, file: &Table<'_>, device: &mut Device) {
    for (name, table) in &file.spaces {
        let Some(FlagOr::Table(rule)) = &table.parameter else { continue };
        let messages = [&rule.read, &rule.write, &rule.store];
        reader.mention(messages.into_iter().flatten(), "message");
        device.parameter_spaces.push(ParameterSpace {
            name: text(name),
            read: rule.read.as_ref().map(|name| reader.reference(name)),
            write: rule.write.as_ref().map(|name| reader.reference(name)),
            store: rule.store.as_ref().map(|name| reader.reference(name)),
            byte_order: rule.order.as_ref().map(|order| byte_order(reader, order)).unwrap_or_default(),
            documentation: reader.documentation(table.doc.as_deref(), None),
            origin: reader.origin(name),
        });
    }
}

/// Returns the byte offset in the file at which a message with all of its fields and examples ends.
fn end(table: &At<MessageTable>) -> u32 {
    let message = &table.value;
    let fields = message.request.iter().chain(&message.reply).map(|field| field.end);
    let frames = message.examples.iter().flat_map(|example| [example.value.request.end, example.value.reply.end]);
    fields.chain(frames).fold(table.end, u32::max)
}

/// Reads a request and its reply. `names` contains the names of earlier messages.
fn message(
    reader: &mut Reader<'_, '_>,
    rows: &mut Rows,
    table: &At<MessageTable>,
    device: &mut Device,
    names: &mut HashSet<String>,
) {
    let given = &table.value;
    let Some(name) = &given.name else {
        reader.report(&codes::TABLE_VALUE, reader.span(table), "the message has no `name`");
        return;
    };
    let origin = reader.origin(name);
    if !names.insert(name.value.clone()) {
        let message = format!("two messages have the name `{}`", brief(&name.value));
        reader.report(&codes::TABLE_DUPLICATE, reader.span(name), message);
    }
    let mut with = Fields { reader, rows, request: Vec::new() };
    let request = with.list(&given.request, 0);
    with.request = field_names(&request).cloned().collect();
    let reply = with.list(&given.reply, 0);
    for (list, fields) in [(&given.request, &request), (&given.reply, &reply)] {
        with.numbers(list, fields);
    }
    let replies: Vec<CompactString> = field_names(&reply).cloned().collect();
    let completion = completion(reader, given.completion.as_ref(), &replies);
    mention_names(reader, given);
    let replaced_by = given.replaced_by.as_ref().map(|name| name.value.as_str());
    let versions = [&given.since, &given.until];
    let availability = conditions::availability(reader, &given.models, versions, replaced_by, None);
    let mut doubts = reader.doubts_of(given, origin);
    let examples = given.examples.iter().map(|frames| example(reader, frames, &mut doubts)).collect();
    let effects = given.effects.iter().flat_map(|effects| &effects.0);
    device.messages.push(Message {
        name: text(name),
        request,
        reply,
        address: None,
        check_from: None,
        completion,
        reply_time: given.reply_time,
        after: given.after.as_ref().map(|name| reader.reference(name)),
        by_default: given.default,
        error: given.error.as_ref().map(|name| reader.reference(name)),
        side_effects: effects.map(|effect| effect.as_str().into()).collect(),
        accepted_when: given.when.as_ref().map(|when| conditions::conditions(reader, when)).unwrap_or_default(),
        names: reader.original(given.orig.as_deref()),
        availability,
        accepted_in: given.accepted_in.iter().map(|name| reader.reference(name)).collect(),
        examples,
        documentation: reader.documentation_of(given),
        doubts,
        origin,
    });
}

/// Reports the first message that exceeds the maximum number of messages.
fn too_many(reader: &mut Reader<'_, '_>, table: &At<MessageTable>) {
    let message = format!("the table has more than {} messages", limits::MAX_MESSAGES);
    let found = codes::INPUT_TOO_LARGE.at(reader.span(table), message);
    reader.diagnostics.push(found.label("this and all later messages are left out"));
}

/// Reports each `counts` key in `tables` that does not name a field of the same list. `fields` contains the fields of this
/// list.
fn counted(reader: &mut Reader<'_, '_>, fields: &[MessageField], tables: &[At<FieldTable>]) {
    let echoes = fields.iter().filter_map(|field| match field {
        MessageField::Echo { field, .. } => Some(&field.name),
        _ => None,
    });
    let known: Vec<&CompactString> = field_names(fields).chain(echoes).collect();
    for counts in tables.iter().filter_map(|table| table.value.counts.as_ref()) {
        if !known.iter().any(|name| **name == counts.value) {
            let known = known.iter().map(|name| name.as_str());
            reader.unresolved("field of this list", &counts.value, reader.span(counts), known);
        }
    }
}

/// Reads an example in the manual: a request and its reply.
fn example(reader: &mut Reader<'_, '_>, given: &At<ExampleTable>, doubts: &mut Doubts) -> MessageExample {
    let example = &given.value;
    let origin = reader.origin(given);
    doubts.extend(reader.doubts_of(example, origin));
    MessageExample {
        request: example.request.value.clone(),
        reply: example.reply.value.clone(),
        documentation: reader.documentation_of(example),
        request_at: reader.span(&example.request),
        reply_at: reader.span(&example.reply),
    }
}

/// Adds the names to which a message refers.
fn mention_names(reader: &mut Reader<'_, '_>, message: &MessageTable) {
    let messages = [&message.after, &message.error, &message.replaced_by];
    reader.mention(messages.into_iter().flatten(), "message");
    reader.mention(&message.accepted_in, "state");
}

fn completion(
    reader: &mut Reader<'_, '_>,
    given: Option<&At<TextOr<CompletionTable>>>,
    replies: &[CompactString],
) -> Completion {
    let Some(given) = given else { return Completion::Immediate };
    let found = match &given.value {
        TextOr::Text(word) => match word.as_str() {
            "immediate" => Some(Completion::Immediate),
            "reply" => Some(Completion::Reply),
            _ => None,
        },
        TextOr::Table(table) => match (&table.poll, table.delay) {
            (Some(item), None) => {
                // Text after a dot names a bit of the item or field. Only the item or field is looked up.
                let whole = item.value.split('.').next().unwrap_or_default();
                if !replies.iter().any(|field| field == whole) {
                    reader.mention([&At { value: whole.to_owned(), start: item.start, end: item.end }], ITEM_OR_FIELD);
                }
                let value = table.value.as_ref().and_then(|literal| value::convert(literal, Type::Opaque(None), false));
                Some(Completion::Polled {
                    item: reader.reference(item),
                    mask: table.mask,
                    value,
                    in_reply: table.in_reply,
                })
            }
            (None, Some(delay)) if table.mask.is_none() && table.value.is_none() && !table.in_reply => {
                Some(Completion::Delayed(delay))
            }
            _ => None,
        },
    };
    if found.is_none() {
        let message =
            "`completion` must be `\"immediate\"`, `\"reply\"`, `{ poll = \"item\" }` (with `mask`, `value`, `in_reply`) or \
                       `{ delay = 100 }`";
        reader.report(&codes::TABLE_VALUE, reader.span(given), message);
    }
    found.unwrap_or_default()
}

/// Returns the names of the values in `fields`. Values in repeated fields are left out, because only fields of the same list
/// can refer to them.
pub(super) fn field_names(fields: &[MessageField]) -> impl Iterator<Item = &CompactString> {
    fields.iter().filter_map(|field| match field {
        MessageField::Value(value) => Some(&value.item.name),
        _ => None,
    })
}

/// Reads the fields of a request or reply.
struct Fields<'r, 's, 'd> {
    reader: &'r mut Reader<'s, 'd>,
    rows: &'r mut Rows,
    /// Names of the values in the request, which fields of the reply may repeat.
    request: Vec<CompactString>,
}

impl Fields<'_, '_, '_> {
    fn list(&mut self, list: &[At<FieldTable>], depth: usize) -> Vec<MessageField> {
        let mut fields: Vec<MessageField> = Vec::with_capacity(list.len());
        let mut before = HashSet::default();
        for field in list {
            let message_field = self.one(field, &before, depth);
            before.extend(field_names(message_field.as_slice()).cloned());
            fields.extend(message_field);
        }
        counted(self.reader, &fields, list);
        fields
    }

    fn one(&mut self, field: &At<FieldTable>, before: &HashSet<CompactString>, depth: usize) -> Option<MessageField> {
        let given = &field.value;
        let given_keys = [
            given.field.is_some(),
            given.bytes.is_some(),
            given.fixed.is_some() && given.field.is_none(),
            given.echo.is_some(),
            given.copy.is_some(),
            given.code.is_some(),
            given.value_of.is_some(),
            given.zeros_for.is_some(),
            given.pad.is_some(),
            given.repeat.is_some(),
            given.rest,
        ];
        let is_one = given_keys.iter().filter(|is_given| **is_given).count() == 1;
        if !is_one || (given.repeat.is_some() && depth >= MAX_DEPTH) {
            let message =
                "a field must have one of `field`, `bytes`, `fixed`, `echo`, `copy`, `code`, `value_of`, `zeros_for`, `pad`, \
                           `repeat`, `rest`";
            self.reader.report(&codes::TABLE_VALUE, self.reader.span(field), message);
            return None;
        }
        if let Some(name) = &given.field {
            return self.typed(field, name);
        }
        if let Some(echo) = &given.echo {
            return Some(self.echo(echo, field));
        }
        if let Some(fixed) = &given.fixed {
            return self.fixed(fixed, field);
        }
        if let Some(copy) = &given.copy {
            return self.bytes(copy).map(|(first, last)| MessageField::Copy { first, last });
        }
        if let Some(space) = &given.code {
            return Some(MessageField::ItemCode { space: self.space(space), bits: self.code_bits(field) });
        }
        if let Some(space) = &given.value_of {
            return Some(MessageField::ItemValue { space: self.space(space) });
        }
        if let Some(space) = &given.zeros_for {
            return Some(MessageField::ItemPadding { space: self.space(space) });
        }
        if let Some(repeat) = &given.repeat {
            if let Some(count) = repeat.count.as_ref().filter(|count| !before.contains(count.value.as_str())) {
                let mut known: Vec<&str> = match self.reader.helps() {
                    true => before.iter().map(CompactString::as_str).collect(),
                    false => Vec::new(),
                };
                known.sort_unstable();
                self.reader.unresolved("field", &count.value, self.reader.span(count), known.into_iter());
            }
            let fields = self.list(&repeat.fields, depth + 1);
            let count = repeat.count.as_ref().map(|count| self.reader.reference(count));
            return Some(MessageField::Repeat { count, max: repeat.max, fields });
        }
        let fixed = given.bytes.clone().map(MessageField::Constant).or(given.pad.map(MessageField::Padding));
        Some(fixed.unwrap_or(MessageField::Rest))
    }

    /// Reports the first printed byte number that contradicts the lengths of the preceding fields. The check ends at the
    /// first field without a fixed length.
    fn numbers(&mut self, list: &[At<FieldTable>], fields: &[MessageField]) {
        if list.len() != fields.len() {
            return;
        }
        let (mut bits, mut first) = (0u32, None);
        for (given, field) in list.iter().zip(fields) {
            if let Some(at) = &given.value.at {
                let number = i64::from(at.value) - i64::from(bits / 8);
                let first = *first.get_or_insert(number);
                if number != first {
                    let message = format!(
                        "the printed byte number of the field is {}, but the preceding fields require {}",
                        at.value,
                        first + i64::from(bits / 8)
                    );
                    self.reader.report(&codes::BYTE_NUMBERS, self.reader.span(at), message);
                    return;
                }
            }
            let owner = Owner::of_types(&self.rows.definitions.types);
            match fixed_bits(owner, field).and_then(|length| bits.checked_add(length)) {
                Some(all) => bits = all,
                None => return,
            }
        }
    }

    fn echo(&mut self, echo: &At<String>, field: &At<FieldTable>) -> MessageField {
        if !self.request.iter().any(|name| *name == echo.value) {
            let known = self.request.iter().map(CompactString::as_str);
            let what = "field of the request outside repeated groups";
            self.reader.unresolved(what, &echo.value, self.reader.span(echo), known);
        }
        let bytes = field.value.part.as_ref().and_then(|part| self.bytes(part));
        MessageField::Echo { field: self.reader.reference(echo), bytes }
    }

    /// Reads a range of bytes. Returns the numbers of the first and the last byte. Returns `None` and reports the range if it is
    /// invalid.
    fn bytes<T: TryFrom<i128> + PartialOrd>(&mut self, given: &At<NumberOrText>) -> Option<(T, T)> {
        let range = notation::range(&given.value.to_string());
        let found = range.and_then(|(first, last)| Some((T::try_from(first).ok()?, T::try_from(last).ok()?)));
        let found = found.filter(|(first, last)| first <= last);
        if found.is_none() {
            let message = format!("`{}` is not a range of bytes", brief(&given.value.to_string()));
            let help = "write a range such as `\"1..3\"`, where 0 is the first byte on the wire";
            self.reader.report_with_help(&codes::TABLE_PLACE, self.reader.span(given), message, help);
        }
        found
    }

    /// Reads a field with constant bits. The type of the field must be an unsigned integer of 1 to 63 bits.
    fn fixed(&mut self, fixed: &At<Literal>, field: &At<FieldTable>) -> Option<MessageField> {
        let ty = field.value.ty.as_ref().and_then(|ty| types::named(&ty.value)).map(|named| named.ty);
        let Some(ty @ Type::Unsigned(bits @ 1..=63)) = ty else {
            let (message, help) = ("fixed bits need a `type` such as `u4`", "write whole bytes as `bytes = [0x00]`");
            self.reader.report_with_help(&codes::TABLE_VALUE, self.reader.span(field), message, help);
            return None;
        };
        match value::value(self.reader, fixed, ty) {
            Value::Int(value) => Some(MessageField::FixedBits { bits, value: u64::try_from(value).unwrap_or(0) }),
            _ => None,
        }
    }

    fn space(&mut self, name: &At<String>) -> SpaceRef {
        if !self.rows.spaces.iter().any(|space| space.name == name.value) {
            let known: Vec<String> = self.rows.spaces.iter().map(|space| space.name.clone()).collect();
            self.reader.unresolved("space", &name.value, self.reader.span(name), known.iter().map(String::as_str));
        }
        self.reader.reference(name)
    }

    /// Returns the length of a parameter number in bits: that of the field's type, or 16 if the field has no type. Reports
    /// a type that is not an unsigned integer type, and also returns 16.
    fn code_bits(&mut self, field: &At<FieldTable>) -> u8 {
        let Some(ty) = &field.value.ty else { return 16 };
        match types::named(&ty.value).map(|named| named.ty) {
            Some(Type::Unsigned(bits)) => bits,
            _ => {
                let message = format!("`{}` is not an integer type for a code, such as `u16`", brief(&ty.value));
                self.reader.report(&codes::TABLE_VALUE, self.reader.span(ty), message);
                16
            }
        }
    }

    /// Reads a named message field with a data type. The field is read as a row that has the same keys.
    fn typed(&mut self, field: &At<FieldTable>, name: &At<String>) -> Option<MessageField> {
        let given = &field.value;
        let row = Row { offset: given.offset, fixed: given.fixed.clone(), ..field_row!(given) };
        let named = Named { name: &name.value, key: name, number: 0, end: field.end };
        let ty = self.rows.ty(self.reader, named, &row)?;
        let mut item = Item::new(Binding::Ascii(CompactString::default()));
        item.bindings.clear();
        item.access = Access::ReadWrite;
        self.rows.fill(self.reader, &mut item, named, &row, Some(ty));
        let byte_order = given.order.as_ref().map(|order| byte_order(self.reader, order)).unwrap_or_default();
        let bytes = self.rows.definitions.underlying(ty).bits().map(|bits| bits.div_ceil(8) as usize);
        if let Some((order, bytes)) =
            given.order.as_ref().zip(bytes.filter(|&bytes| !byte_order.is_empty() && byte_order.len() != bytes))
        {
            let message = format!("the byte order has {} bytes, but the type has {bytes}", byte_order.len());
            self.reader.report(&codes::TABLE_VALUE, self.reader.span(order), message);
        }
        let counts = given.counts.as_ref().map(|field| self.reader.reference(field));
        Some(MessageField::Value(Box::new(MessageValue { item, byte_order, counts, completes: None })))
    }
}

/// Reads a byte order such as `CDAB`, which lists the bytes in the order of the wire. `A` is the most significant byte.
fn byte_order(reader: &mut Reader<'_, '_>, order: &At<String>) -> Vec<u8> {
    let bytes: Vec<u8> = order.value.bytes().map(|letter| letter.wrapping_sub(b'A')).collect();
    let mut sorted = bytes.clone();
    sorted.sort_unstable();
    let is_order = (1..=8).contains(&bytes.len()) && sorted.iter().zip(0u8..).all(|(byte, expected)| *byte == expected);
    if is_order {
        return bytes;
    }
    let message = format!("`{}` is not a valid byte order", brief(&order.value));
    let found = codes::TABLE_VALUE.at(reader.span(order), message);
    reader.diagnostics.push(found.help("write consecutive letters from `A`, each exactly once, such as `CDAB`"));
    Vec::new()
}
