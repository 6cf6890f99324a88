//! Command protocols: a type for every request and reply, how parameters travel in them, and how frames are delimited.

mod completion;
mod device;
mod field;
mod framing;
mod outcomes;
mod parameters;
mod rules;
mod steps;

use std::collections::{HashMap, HashSet};

use super::code::{call, seq, Doc};
use super::context::Context;
use super::docs::{self, WORDS};
use super::links::{self, Here};
use super::named::Types;
use super::naming::messages::{MessageNames as Names, NamedMessages};
use super::options::RustOptions;
use crate::ir::{Completion, Message};
use crate::resolve::messages::{self, Shaped, Step};
pub(super) use device::{CallModel, DefaultModel};
pub(super) use field::Field;
use outcomes::OutcomesModel;
pub(super) use parameters::{Arm, ParametersModel};
use rules::{RuleModel, Rules};
pub(super) use steps::Statements;

/// A protocol, ready to be written.
pub(super) struct ProtocolModel {
    /// The expression of the constant.
    pub framing: Option<Doc>,
    pub framing_docs: Vec<String>,
    pub max_data: u32,
    pub derives: Vec<String>,
    /// Whether requests have the number of the device.
    pub has_station: bool,
    pub rules: Vec<RuleModel>,
    pub messages: Vec<MessageModel>,
    pub parameters: Option<ParametersModel>,
    /// The requests that a simulated device tells apart, and whether they borrow from the data.
    pub requests: Vec<(String, bool)>,
    pub request_derives: Vec<String>,
    pub calls: Vec<CallModel>,
    /// What a device answers after power-on.
    pub by_default: Option<DefaultModel>,
}

/// A request and its reply.
pub(super) struct MessageModel {
    pub title: String,
    /// What is said of the method that sends it.
    pub call_docs: Vec<String>,
    /// None where only the device sends.
    pub request: Option<DataModel>,
    /// None where the reply isn't described.
    pub reply: Option<DataModel>,
    /// The type of what comes where the device refuses.
    pub refusal: String,
    pub completion: Doc,
    /// Whether the requests of others mean what this one has selected.
    pub is_selector: bool,
    /// What it does in each state.
    pub outcomes: Vec<OutcomesModel>,
}

/// The data of a request or a reply.
pub(super) struct DataModel {
    pub name: String,
    pub docs: Vec<String>,
    pub derives: Vec<String>,
    pub borrows: bool,
    pub fields: Vec<Field>,
    pub code: Statements,
    /// What is repeated.
    pub entry: Option<EntryModel>,
    /// The expression that tells whether an order is carried out.
    pub is_complete: Option<String>,
}

/// Fields that are repeated.
pub(super) struct EntryModel {
    pub name: String,
    pub title: String,
    pub derives: Vec<String>,
    pub length: u32,
    pub fields: Vec<Field>,
    pub code: Statements,
}

impl ProtocolModel {
    /// The protocol of a device; `None` where it has none. Its methods must not be called as `taken`.
    pub(super) fn new(context: &Context<'_>, options: &RustOptions, types: &Types, taken: &[&str]) -> Option<Self> {
        let device = context.device?;
        let NamedMessages { shapes, names } = &context.names.messages;
        if shapes.is_empty() {
            return None;
        }
        let own_types: Vec<&str> = names.iter().flatten().map(String::as_str).collect();
        let steps = shapes.iter().flat_map(|own| own.request.steps.iter().chain(&own.reply.steps));
        let rules = Rules::new(context, device, steps, &own_types);
        let states = outcomes::links(context, device, types);
        let make = Maker {
            context,
            options,
            polled: completion::conditions(device),
            selectors: shapes.iter().filter_map(|own| Some(own.message.after.as_ref()?.as_str())).collect(),
            rules: &rules,
            shapes,
            names,
            states: &states,
        };
        let mut outcomes = outcomes::models(context, device, types);
        let mut messages: Vec<MessageModel> =
            shapes.iter().zip(names).map(|(own, names)| make.message(own, names)).collect();
        for (own, model) in shapes.iter().zip(&mut messages) {
            model.outcomes = outcomes.remove(own.message.name.as_str()).unwrap_or_default();
        }
        let calls = if options.accessors { device::calls(shapes, &messages, &rules, taken) } else { Vec::new() };
        Some(ProtocolModel {
            framing: device.framing.as_deref().and_then(|own| framing::constant(own, shapes)),
            framing_docs: device.framing.as_deref().map(|own| framing::documentation(own, context)).unwrap_or_default(),
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

    /// Whether limits are real numbers.
    pub(super) fn has_real_limits(&self) -> bool {
        let sides = self.messages.iter().flat_map(|own| own.request.iter().chain(&own.reply));
        let mut fields = sides.flat_map(|side| side.fields.iter().chain(side.entry.iter().flat_map(|own| &own.fields)));
        fields.any(Field::has_real_limits)
    }

    /// Whether requests decide what others mean.
    pub(super) fn selects(&self) -> bool {
        self.messages.iter().any(|own| own.is_selector)
    }

    /// Whether there are methods that are there in any state.
    pub(super) fn has_free(&self) -> bool {
        self.calls.iter().any(|own| own.after.is_none() && !own.is_selector)
    }

    /// Whether the requests that are told apart borrow from the data.
    pub(super) fn requests_borrow(&self) -> bool {
        self.requests.iter().any(|(_, borrows)| *borrows)
    }
}

/// What is needed to make models of messages.
struct Maker<'m, 'a> {
    context: &'m Context<'a>,
    options: &'m RustOptions,
    /// By what orders are polled.
    polled: completion::Conditions<'m>,
    /// The names of the messages after which others can be sent.
    selectors: HashSet<&'m str>,
    rules: &'m Rules,
    shapes: &'m [Shaped<'a>],
    names: &'m [Names],
    /// The paths of states, by their names.
    states: &'m HashMap<String, String>,
}

impl Maker<'_, '_> {
    fn message(&self, own: &Shaped<'_>, names: &Names) -> MessageModel {
        let message = own.message;
        let refusal = messages::refusal(self.shapes, message).and_then(|at| self.names.get(at));
        let [request_name, reply_name, entry, reply_entry] = names;
        let has_request = !message.request.is_empty();
        let request = has_request.then(|| {
            let data = self.data(&own.request.steps, request_name, entry);
            let mut docs = self.documentation(message, Here::MESSAGES);
            let reply = (!message.reply.is_empty()).then(|| format!("Answered by {}.", links::beside(reply_name)));
            let refused = refusal.map(|names| format!("Refused with {}.", links::beside(&names[1])));
            let answers: Vec<String> = reply.into_iter().chain(refused).collect();
            if !answers.is_empty() {
                docs.extend([String::new(), answers.join(" ")]);
            }
            DataModel { docs, ..data }
        });
        let reply = (!message.reply.is_empty()).then(|| {
            let data = self.data(&own.reply.steps, reply_name, reply_entry);
            let docs = match has_request {
                true => vec![format!("What is answered to {}.", links::beside(request_name))],
                false => self.documentation(message, Here::MESSAGES),
            };
            let polled =
                || completion::expression(self.context, &self.polled, message, (&own.reply.steps, &data.fields));
            let is_complete = has_request.then(polled).flatten();
            DataModel { docs, is_complete, ..data }
        });
        MessageModel {
            title: super::literal::string(&message.name),
            call_docs: self.documentation(message, Here::TOP),
            request,
            reply,
            refusal: refusal.map_or_else(|| "core::convert::Infallible".to_owned(), |names| names[1].clone()),
            completion: completion(&message.completion),
            outcomes: Vec::new(),
            is_selector: self.selectors.contains(message.name.as_str()),
        }
    }

    fn data(&self, steps: &[Step<'_>], name: &str, entry: &str) -> DataModel {
        let (fields, borrows) = self.fields(steps, entry);
        let code = steps::statements(steps, &fields, self.rules);
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
        let (fields, borrows) = self.fields(steps, "");
        let mut code = steps::statements(steps, &fields, self.rules);
        // What follows is another one.
        code.read.pop();
        EntryModel {
            name: name.to_owned(),
            title: format!("What is repeated in {}.", links::beside(owner)),
            derives: self.derives(borrows),
            length,
            fields,
            code,
        }
    }

    /// The fields of a struct, and whether one borrows from the data.
    fn fields(&self, steps: &[Step<'_>], entry: &str) -> (Vec<Field>, bool) {
        let mut fields = field::fields(self.context, steps, entry);
        let borrows = fields.iter().any(Field::borrows);
        // A struct that borrows is nothing for `serde`, and then nobody reads the attribute.
        for field in fields.iter_mut().filter(|_| !borrows) {
            field.attribute = field.text_length().and_then(|length| self.options.octets_attribute(length));
        }
        (fields, borrows)
    }

    /// What borrows from the data, such as a list, has neither a form for `serde` nor for `defmt`.
    fn derives(&self, borrows: bool) -> Vec<String> {
        if !borrows {
            return self.options.derives(true);
        }
        let plain =
            RustOptions { serde: super::Presence::Never, defmt: super::Presence::Never, ..self.options.clone() };
        plain.derives(true)
    }

    /// The lines about a message, for a place.
    fn documentation(&self, message: &Message, here: Here<'_>) -> Vec<String> {
        let mut lines = vec![docs::sentence(&docs::escape(&message.name))];
        let mut sentences = Vec::new();
        docs::words(message.documentation.as_deref(), &mut sentences);
        sentences.extend(completion::sentence(self.context, message, here));
        if !message.accepted_in.is_empty() {
            // The method leads to the message, which leads to the states.
            let state = |name: &str| match self.states.get(name).filter(|_| !here.is_top()) {
                Some(path) => here.code(path),
                None => docs::escape(name),
            };
            let states: Vec<String> = message.accepted_in.iter().map(|name| state(name)).collect();
            sentences.push(format!("Accepted in the states: {}.", states.join(", ")));
        }
        for condition in &message.accepted_when {
            sentences.push(format!("Accepted only while {}.", docs::holds(condition, self.context, here)));
        }
        sentences.extend(message.side_effects.iter().map(|effect| docs::sentence(&docs::escape(effect))));
        sentences.extend(message.after.iter().map(|other| {
            let other = self.context.link(other, here).unwrap_or_else(|| docs::escape(other));
            format!("Means this after {other}.")
        }));
        if message.by_default {
            sentences.push("So it is after power-on, too.".to_owned());
        }
        let link = |id, name: &str| self.context.link_to(id, name, here);
        sentences.extend(message.availability.as_ref().map(|own| docs::linked(&link).availability(own)));
        sentences.extend(WORDS.place(&self.context.manual, "", message.documentation.as_deref(), &message.names));
        sentences.extend(message.doubts.iter().map(|own| WORDS.doubt(&self.context.manual, own)));
        for sentence in sentences.into_iter().filter(|sentence| !sentence.is_empty()) {
            lines.extend([String::new(), sentence]);
        }
        lines
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

/// The requests that can be told apart: of those that are alike, the first.
fn requests(messages: &[MessageModel]) -> Vec<(String, bool)> {
    let mut seen = HashSet::new();
    let requests = messages.iter().filter_map(|message| message.request.as_ref());
    let first = requests.filter(|request| seen.insert(&request.code.read));
    first.map(|request| (request.name.clone(), request.borrows)).collect()
}
