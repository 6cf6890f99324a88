//! Messages of a command protocol, with their framing and fields.

use super::anchor::Names;
use super::bits::{self, Bits, Label};
use super::entry::{self, Doubt};
use super::words::{self, PLAIN};
use lexibus_codegen::facts::physical::Physical;
use lexibus_codegen::facts::types;
use lexibus_codegen::facts::words::{capital, sentence};
use lexibus_codegen::ir::{
    Completion, Device, Framing, Manual, Message, MessageExample, MessageField, MessageValue, TypeDef,
};
use lexibus_codegen::number::{bytes, hex8};

/// The command protocol of a device, as a page shows it.
#[derive(Debug)]
pub(super) struct Protocol {
    /// Names and values of the framing properties.
    pub framing: Vec<(&'static str, String)>,
    pub framing_facts: Vec<String>,
    pub messages: Vec<MessageModel>,
}

/// A message, as a page shows it: a request and its reply.
#[derive(Debug)]
pub(super) struct MessageModel {
    pub anchor: String,
    pub name: String,
    pub names: Vec<(String, String)>,
    pub facts: Vec<String>,
    pub doubts: Vec<Doubt>,
    pub request: Vec<Part>,
    pub reply: Vec<Part>,
    pub examples: Vec<Example>,
}

/// A field in the list of a frame's fields.
#[derive(Debug, Default)]
pub(super) struct Part {
    /// Length of the field, such as `2 bytes` or `4 bits`; empty if unknown.
    pub length: String,
    pub label: String,
    pub facts: String,
    /// CSS class of the field: `c` for fixed bytes, `v` for values, `e` for copies, `r` for repetitions.
    pub kind: &'static str,
    /// Number of nested repetitions that contain the field.
    pub depth: usize,
    pub bits: Option<Bits>,
    pub labels: Vec<Label>,
}

/// An example of a request and its reply from the manual.
#[derive(Debug)]
pub(super) struct Example {
    pub request: String,
    pub reply: String,
    pub facts: String,
}

/// Returns the protocol, or `None` if the device has no messages.
pub(super) fn protocol(device: &Device, manual: &Manual) -> Option<Protocol> {
    if device.messages.is_empty() {
        return None;
    }
    let mut names = Names::default();
    let framing = device.framing.as_deref();
    Some(Protocol {
        framing: framing.map(delimited).unwrap_or_default(),
        framing_facts: framing.map(|framing| PLAIN.description(framing.documentation.as_deref())).unwrap_or_default(),
        messages: device.messages.iter().map(|each| message(each, device, manual, &mut names)).collect(),
    })
}

fn delimited(framing: &Framing) -> Vec<(&'static str, String)> {
    let mut facts = Vec::new();
    facts.extend(framing.start.map(|start| ("First byte", hex8(start))));
    facts.extend(framing.end.map(|end| ("Last byte", hex8(end))));
    facts.extend(framing.escape.map(|escape| ("Escape", hex8(escape))));
    if framing.escape.is_some() {
        let escaped: Vec<String> = framing.escaped.iter().copied().map(hex8).collect();
        facts.push(("Escaped bytes", escaped.join(", ")));
        facts.push(("Mask of escaped bytes", format!("{} (XOR)", hex8(framing.escape_xor))));
    }
    if !framing.check.is_empty() {
        facts.push(("Check byte", format!("{}, beginning with {}", framing.check, hex8(framing.check_seed))));
    }
    facts.extend(framing.check_from.as_ref().map(|field| ("First checked field", field.to_string())));
    facts.extend(framing.max_data.map(|max| ("Maximum number of data bytes", max.to_string())));
    facts.extend(framing.address.as_ref().map(|field| ("Address field", field.to_string())));
    facts
}

fn message(message: &Message, device: &Device, manual: &Manual, names: &mut Names) -> MessageModel {
    let mut facts = PLAIN.description(message.documentation.as_deref());
    facts.extend(match &message.completion {
        Completion::Immediate => None,
        Completion::Reply => Some("The device replies after it has completed the command.".to_owned()),
        Completion::Delayed(milliseconds) => {
            Some(format!("The device completes the command {milliseconds} ms after the request."))
        }
        Completion::Polled { item, .. } => Some(format!("{item} shows when the device has completed the command.")),
    });
    facts.extend(message.reply_time.map(|time| format!("The reply takes about {time} ms.")));
    if !message.accepted_in.is_empty() {
        let states: Vec<&str> = message.accepted_in.iter().map(|state| state.as_str()).collect();
        facts.push(format!("Accepted in the states: {}.", states.join(", ")));
    }
    let conditions = message.accepted_when.iter().map(|condition| PLAIN.holds(condition));
    facts.extend(conditions.map(|condition| format!("Accepted only while {condition}.")));
    facts.extend(message.side_effects.iter().map(|effect| sentence(effect)));
    facts.extend(message.after.as_ref().map(|other| format!("Has this meaning after {other}.")));
    facts.extend(message.by_default.then(|| "This meaning also applies after power-on.".to_owned()));
    facts.extend(
        message.error.as_ref().map(|other| format!("If the device rejects the request, it replies with {other}.")),
    );
    facts.extend(message.availability.as_ref().map(|availability| PLAIN.availability(availability)));
    facts.extend(PLAIN.manual_entry(manual, "", message.documentation.as_deref(), &message.names));
    facts.retain(|fact| !fact.is_empty());
    let anchor = names.anchor(&message.name);
    let mut parts = Parts {
        types: &device.types,
        names: Names::within(&format!("{anchor}.request")),
        all: Vec::new(),
        doubts: message.doubts.to_vec(),
    };
    parts.fields(&message.request, 0);
    let request = std::mem::take(&mut parts.all);
    parts.names = Names::within(&format!("{anchor}.reply"));
    parts.fields(&message.reply, 0);
    let example = |example: &MessageExample| Example {
        request: bytes(&example.request),
        reply: bytes(&example.reply),
        facts: PLAIN.description(example.documentation.as_deref()).join(" "),
    };
    MessageModel {
        anchor,
        name: message.name.to_string(),
        names: words::names(&message.name, &message.names),
        facts,
        doubts: entry::doubts(&parts.doubts, "", manual),
        request,
        reply: parts.all,
        examples: message.examples.iter().map(example).collect(),
    }
}

/// Collects the fields of a frame, including the fields inside repetitions.
struct Parts<'d> {
    types: &'d [TypeDef],
    /// Anchors of the fields in the frame.
    names: Names,
    all: Vec<Part>,
    /// Ambiguities of the message and of its fields.
    doubts: Vec<lexibus_codegen::ir::Doubt>,
}

impl Parts<'_> {
    fn fields(&mut self, fields: &[MessageField], depth: usize) {
        for field in fields {
            let part = |length: String, label: String, kind| Part { length, label, kind, depth, ..Part::default() };
            let part = match field {
                MessageField::Constant(constant) => part(count(constant.len(), "byte"), bytes(constant), "c"),
                MessageField::FixedBits { bits, value } => {
                    part(count((*bits).into(), "bit"), format!("{value:#b}").replacen("0b", "", 1), "c")
                }
                MessageField::Value(value) => self.value(value, depth),
                MessageField::Echo { field, bytes } => {
                    let which = bytes.map(|(first, last)| format!(", bytes {first}–{last}")).unwrap_or_default();
                    part(String::new(), format!("{field} of the request{which}"), "e")
                }
                MessageField::Copy { first, last } => {
                    let length = usize::from(last.saturating_sub(*first)) + 1;
                    part(count(length, "byte"), format!("bytes {first}–{last} of the request"), "e")
                }
                MessageField::ItemCode { space, bits } => {
                    part(count((*bits).into(), "bit"), format!("number of a {space}"), "v")
                }
                MessageField::ItemValue { space } => part(String::new(), format!("value of the {space}"), "v"),
                MessageField::ItemPadding { space } => {
                    part(String::new(), format!("zeros, as many as the {space} has bytes"), "c")
                }
                MessageField::Padding(bytes) => part(count((*bytes).into(), "byte"), "no meaning".to_owned(), "c"),
                MessageField::Rest => part(String::new(), "all that follows".to_owned(), "v"),
                MessageField::Repeat { count: number, max, fields } => {
                    let often =
                        number.as_ref().map_or("up to the end".to_owned(), |count| format!("as often as {count} says"));
                    let most = max.map(|max| format!(", {max} times at most")).unwrap_or_default();
                    self.all.push(part(String::new(), format!("repeated {often}{most}:"), "r"));
                    self.fields(fields, depth + 1);
                    continue;
                }
            };
            self.all.push(part);
        }
    }

    fn value(&mut self, value: &MessageValue, depth: usize) -> Part {
        let item = &value.item;
        self.doubts.extend(item.doubts.iter().cloned());
        let basic = types::basic(self.types, item.ty);
        let (bits, labels) = bits::of_type(self.types, item.ty, &self.names.anchor(&item.name));
        let mut facts = vec![format!("{}.", types::name(self.types, item.ty))];
        let limits = PLAIN.limits(&item.limits, Physical::of(item.quantity.as_deref()).as_ref());
        facts.extend(limits.map(|limits| format!("{limits}.")));
        if let Some(quantity) = &item.quantity {
            facts.extend(PLAIN.unit(quantity).map(|unit| sentence(&capital(&unit))));
            facts.extend(PLAIN.notes(quantity));
        }
        if !value.byte_order.is_empty() {
            let order: String = value.byte_order.iter().map(|byte| char::from(b'A'.saturating_add(*byte))).collect();
            facts.push(format!("Byte order {order}; A is the most significant byte."));
        }
        facts.extend(value.counts.as_ref().map(|from| format!("The number of bytes from {from} on.")));
        facts.extend(PLAIN.description(item.documentation.as_deref()));
        let length = match basic.bits() {
            Some(bits) if bits.is_multiple_of(8) => count((bits / 8) as usize, "byte"),
            Some(bits) => count(bits as usize, "bit"),
            None => String::new(),
        };
        Part { length, label: item.name.to_string(), facts: facts.join(" "), kind: "v", depth, bits, labels }
    }
}

fn count(number: usize, what: &str) -> String {
    match number {
        1 => format!("1 {what}"),
        _ => format!("{number} {what}s"),
    }
}
