//! Models of a message protocol and of its messages.

use super::super::code::{call, seq, Declaration, Doc};
use super::super::context::Context;
use super::super::docs::{self, WORDS};
use super::super::links::{self, DocModule};
use super::super::named::Types;
use super::super::naming::messages::{MessageNames as Names, NamedMessages};
use super::super::options::RustOptions;
use super::rules::{RuleModel, Rules};
use super::{completion, device, field, framing, outcomes, parameters, steps};
use super::{CallModel, Field, ParametersModel, Statements};
use crate::collections::{HashMap, HashSet};
use crate::ir::{Completion, DeviceStateId, DeviceStateRef, Message, MessageId};
use crate::resolve::messages::{self, Shaped, Step};

/// A message protocol, ready to be printed.
pub(in super::super) struct ProtocolModel {
    /// The constant with the framing of messages.
    pub framing: Option<Declaration>,
    pub max_data: u32,
    pub derives: Vec<String>,
    /// True if any request contains a station number.
    pub has_station: bool,
    pub rules: Vec<RuleModel>,
    pub messages: Vec<MessageModel>,
    pub parameters: Option<ParametersModel>,
    /// Types of the requests that a simulated device can distinguish, and whether each type borrows from the message
    /// data.
    pub requests: Vec<(String, bool)>,
    pub request_derives: Vec<String>,
    pub calls: Vec<CallModel>,
    /// Type of the message that brings the driver into its state after power-on.
    pub by_default: Option<String>,
}

/// A message, which consists of a request, a reply, or both, ready to be printed.
pub(in super::super) struct MessageModel {
    pub title: String,
    /// The request. `None` if only the device sends the message.
    pub request: Option<DataModel>,
    /// The reply. `None` if the description contains no reply.
    pub reply: Option<DataModel>,
    /// Type of the reply with which the device refuses the request, or `Infallible` if there is no such reply.
    pub refusal: String,
    pub completion: Doc,
    /// True if this request determines the meaning of other requests.
    pub is_selector: bool,
    /// Effects of the message in each state.
    pub outcomes: Vec<Declaration>,
}

/// The data of a request or a reply.
pub(in super::super) struct DataModel {
    pub name: String,
    pub docs: Vec<String>,
    pub derives: Vec<String>,
    pub borrows: bool,
    pub fields: Vec<Field>,
    pub code: Statements,
    /// Type of list entries.
    pub entry: Option<EntryModel>,
    /// Expression that returns whether the command is completed.
    pub is_complete: Option<String>,
}

/// The type of a list entry, ready to be printed.
pub(in super::super) struct EntryModel {
    pub name: String,
    pub title: String,
    pub derives: Vec<String>,
    pub length: u32,
    pub fields: Vec<Field>,
    pub code: Statements,
}

impl ProtocolModel {
    /// Creates the protocol of a device. Returns `None` for a module, and if code is generated for none of the device's
    /// messages. `reserved` contains names that the protocol's methods must not have.
    pub(in super::super) fn new(
        context: &Context<'_>,
        options: &RustOptions,
        types: &Types,
        reserved: &[&str],
    ) -> Option<Self> {
        let device = context.device?;
        let NamedMessages { shapes, names } = &context.names.messages;
        if shapes.is_empty() {
            return None;
        }
        let type_names: Vec<&str> = names.iter().flatten().map(String::as_str).collect();
        let steps = shapes.iter().flat_map(|shape| shape.request.steps.iter().chain(&shape.reply.steps));
        let rules = Rules::new(context, device, steps, &type_names);
        let states = outcomes::links(context, device, types);
        let make = Maker {
            context,
            options,
            all: &device.messages,
            selectors: shapes.iter().filter_map(|shape| shape.message.after.as_ref()?.id).collect(),
            rules: &rules,
            shapes,
            names,
            states: &states,
        };
        let mut outcomes = outcomes::models(context, device, types);
        let mut messages: Vec<MessageModel> =
            shapes.iter().zip(names).map(|(shape, names)| make.message(shape, names)).collect();
        for (shape, model) in shapes.iter().zip(&mut messages) {
            model.outcomes = outcomes.remove(&shape.id).unwrap_or_default();
        }
        let documentation = |message: &Message| make.documentation(message, DocModule::TOP);
        let calls = match options.accessors {
            true => device::calls(shapes, &messages, reserved, documentation),
            false => Vec::new(),
        };
        Some(ProtocolModel {
            framing: device.framing.as_deref().and_then(|framing| framing::constant(framing, context, shapes)),
            max_data: framing::max_data(device, shapes),
            derives: options.derives(true),
            has_station: framing::has_station(shapes),
            parameters: parameters::model(device, shapes, &messages, &rules),
            requests: requests(&messages),
            request_derives: make.derives(true),
            by_default: device::by_default(shapes, &messages, &calls),
            calls,
            messages,
            rules: rules.models,
        })
    }

    /// Returns whether a limit of any field is a real number.
    pub(in super::super) fn has_real_limits(&self) -> bool {
        let sides = self.messages.iter().flat_map(|message| message.request.iter().chain(&message.reply));
        let mut fields =
            sides.flat_map(|side| side.fields.iter().chain(side.entry.iter().flat_map(|entry| &entry.fields)));
        fields.any(|field| field.has_real_limits)
    }

    /// Returns whether some requests determine the meaning of other requests.
    pub(in super::super) fn selects(&self) -> bool {
        self.messages.iter().any(|message| message.is_selector)
    }

    /// Returns whether some methods, except those of selecting requests, are available regardless of which selecting
    /// request was sent last.
    pub(in super::super) fn has_free(&self) -> bool {
        self.calls.iter().any(|call| call.after.is_none() && !call.is_selector)
    }

    /// Returns whether any distinguishable request borrows from the message data.
    pub(in super::super) fn requests_borrow(&self) -> bool {
        self.requests.iter().any(|(_, borrows)| *borrows)
    }
}

/// Creates the models of messages.
struct Maker<'m, 'a> {
    context: &'m Context<'a>,
    options: &'m RustOptions,
    /// All messages of the device.
    all: &'m [Message],
    /// Messages that determine the meaning of other messages.
    selectors: HashSet<MessageId>,
    rules: &'m Rules,
    shapes: &'m [Shaped<'a>],
    names: &'m [Names],
    /// Paths of states.
    states: &'m HashMap<DeviceStateId, String>,
}

impl Maker<'_, '_> {
    fn message(&self, shape: &Shaped<'_>, names: &Names) -> MessageModel {
        let message = shape.message;
        let refusal = messages::refusal(self.shapes, message).and_then(|at| self.names.get(at));
        let [request_name, reply_name, entry, reply_entry] = names;
        let has_request = !message.request.is_empty();
        let request = has_request.then(|| {
            let data = self.data(&shape.request.steps, request_name, entry);
            let mut lines = self.documentation(message, DocModule::MESSAGES);
            let reply = (!message.reply.is_empty()).then(|| format!("Reply: {}.", links::sibling(reply_name)));
            let refused = refusal.map(|names| format!("Refusal: {}.", links::sibling(&names[1])));
            let answers: Vec<String> = reply.into_iter().chain(refused).collect();
            if !answers.is_empty() {
                lines.extend([String::new(), answers.join(" ")]);
            }
            DataModel { docs: docs::exact(lines), ..data }
        });
        let reply = (!message.reply.is_empty()).then(|| {
            let data = self.data(&shape.reply.steps, reply_name, reply_entry);
            let docs = match has_request {
                true => vec![format!("Reply to {}.", links::sibling(request_name))],
                false => self.documentation(message, DocModule::MESSAGES),
            };
            let polled = || completion::expression(self.context, self.all, message, &shape.reply.steps, &data.fields);
            let is_complete = has_request.then(polled).flatten();
            DataModel { docs, is_complete, ..data }
        });
        MessageModel {
            title: super::super::literal::string(&message.name),
            request,
            reply,
            refusal: refusal.map_or_else(|| "core::convert::Infallible".to_owned(), |names| names[1].clone()),
            completion: completion(&message.completion),
            outcomes: Vec::new(),
            is_selector: self.selectors.contains(&shape.id),
        }
    }

    fn data(&self, steps: &[Step<'_>], name: &str, entry: &str) -> DataModel {
        let (fields, code, borrows) = self.fields(steps, entry);
        let entry = steps.iter().find_map(|step| match step {
            Step::List { steps, length, .. } => Some(self.entry(steps, *length, name, entry)),
            _ => None,
        });
        DataModel {
            name: name.to_owned(),
            docs: Vec::new(),
            derives: self.derives(borrows),
            borrows,
            fields,
            code,
            entry,
            is_complete: None,
        }
    }

    fn entry(&self, steps: &[Step<'_>], length: u32, owner: &str, name: &str) -> EntryModel {
        let (fields, mut code, borrows) = self.fields(steps, "");
        // Remove the check for the end of the data, because another list entry may follow.
        code.read.pop();
        EntryModel {
            name: name.to_owned(),
            title: format!("Entry of the list in {}.", links::sibling(owner)),
            derives: self.derives(borrows),
            length,
            fields,
            code,
        }
    }

    /// Returns the fields of a struct, its code, and whether any field borrows from the data.
    fn fields(&self, steps: &[Step<'_>], entry: &str) -> (Vec<Field>, Statements, bool) {
        let (mut fields, codes) = field::fields(self.context, self.rules, steps, entry);
        let borrows = fields.iter().any(Field::borrows);
        // If the struct borrows, `serde` is not derived and the fields need no attribute.
        for field in fields.iter_mut().filter(|_| !borrows) {
            field.attribute = field.text_length.and_then(|length| self.options.octets_attribute(length));
        }
        (fields, steps::statements(steps, codes), borrows)
    }

    /// Returns the `derive` attributes of a struct. Structs that borrow, for example those with a list, support neither
    /// `serde` nor `defmt`.
    fn derives(&self, borrows: bool) -> Vec<String> {
        if !borrows {
            return self.options.derives(true);
        }
        let plain = RustOptions {
            serde: super::super::Presence::Never,
            defmt: super::super::Presence::Never,
            ..self.options.clone()
        };
        plain.derives(true)
    }

    /// Returns the documentation of a message. Links are relative to `doc_module`.
    fn documentation(&self, message: &Message, doc_module: DocModule<'_>) -> Vec<String> {
        let mut sentences = WORDS.description(message.documentation.as_deref());
        sentences.extend(completion::sentence(self.context, message, doc_module));
        if !message.accepted_in.is_empty() {
            // Only the documentation of the message links to states. The documentation of the method links to the
            // message.
            let path = |state: &DeviceStateRef| self.states.get(&state.id?).filter(|_| !doc_module.is_top());
            let state = |state: &DeviceStateRef| match path(state) {
                Some(path) => doc_module.code(path),
                None => docs::escape(state),
            };
            let states: Vec<String> = message.accepted_in.iter().map(state).collect();
            sentences.push(format!("The device accepts the message in these states: {}.", states.join(", ")));
        }
        for condition in &message.accepted_when {
            sentences.push(format!(
                "The device accepts the message only while {}.",
                docs::holds(condition, self.context, doc_module)
            ));
        }
        sentences.extend(message.side_effects.iter().map(|effect| docs::sentence(&docs::escape(effect))));
        sentences.extend(message.after.iter().map(|other| {
            let other = self.context.link(other, doc_module).unwrap_or_else(|| docs::escape(other));
            format!("The message has this meaning only after {other} was sent.")
        }));
        if message.by_default {
            sentences.push("The message also has this meaning after power-on.".to_owned());
        }
        let link = |id, name: &str| self.context.link_to(id, name, doc_module);
        let words = docs::linked(&link);
        sentences.extend(message.availability.as_ref().map(|availability| words.availability(availability)));
        let documentation = message.documentation.as_deref();
        sentences.extend(WORDS.manual_entry(&self.context.manual, "", documentation, &message.names));
        sentences.extend(message.doubts.iter().map(|doubt| WORDS.doubt(&self.context.manual, doubt)));
        let title = docs::sentence(&docs::escape(&message.name));
        let sentences = sentences.into_iter().filter(|sentence| !sentence.is_empty());
        docs::paragraphs([title].into_iter().chain(sentences))
    }
}

fn completion(completion: &Completion) -> Doc {
    let name = match completion {
        Completion::Immediate => "Immediate",
        Completion::Reply => "Reply",
        Completion::Polled { .. } => "Polled",
        Completion::Delayed(milliseconds) => return call!("rt::message::Completion::Delayed", *milliseconds),
    };
    seq!["rt::message::Completion::", name]
}

/// Returns the requests that can be distinguished by their bytes. If the bytes of several requests have the same form,
/// only the first of these requests is returned.
fn requests(messages: &[MessageModel]) -> Vec<(String, bool)> {
    let mut seen = HashSet::default();
    let requests = messages.iter().filter_map(|message| message.request.as_ref());
    let first = requests.filter(|request| seen.insert(&request.code.read));
    first.map(|request| (request.name.clone(), request.borrows)).collect()
}
