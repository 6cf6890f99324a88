//! Methods of a device that send messages.

use super::field::Field;
use super::{DataModel, MessageModel};
use crate::backend::rust::code::{Data, Doc};
use crate::backend::rust::docs;
use crate::backend::rust::links::DocModule;
use crate::backend::rust::literal;
use crate::backend::rust::method_names::unused_name;
use crate::ir::{Message, MessageRef};
use crate::names::{self, Case};
use crate::resolve::messages::Shaped;

/// Maximum number of arguments of a method. Clippy warns about methods with more arguments.
const MAX_ARGUMENTS: usize = 6;

/// A method that sends a message, ready to be printed.
pub(in crate::backend::rust) struct CallModel {
    pub method: String,
    pub docs: Vec<String>,
    /// The Rust type of the message, with its lifetime argument if it has one.
    pub ty: String,
    pub arguments: Vec<String>,
    /// Expression that creates the message.
    pub build: Doc,
    /// True if the type of at least one argument has a lifetime.
    pub borrows: bool,
    pub deprecated: Option<String>,
    pub is_selector: bool,
    /// Type of the message that must be sent before this message.
    pub after: Option<String>,
}

/// Returns the methods that send requests. `documentation` returns the documentation of a message.
pub(super) fn calls(
    shaped: &[Shaped<'_>],
    messages: &[MessageModel],
    reserved: &[&str],
    documentation: impl Fn(&Message) -> Vec<String>,
) -> Vec<CallModel> {
    let with =
        || shaped.iter().zip(messages).filter_map(|(shape, model)| Some((shape, model, model.request.as_ref()?)));
    let mut name_requests = names::numbered(with().map(|(shape, ..)| shape.message.name.as_str()), "message");
    for name_request in &mut name_requests {
        name_request.suffix.insert_str(0, "message_");
    }
    let names = names::unique(name_requests, reserved, Case::Snake);
    let mut calls = Vec::new();
    for ((shape, model, request), name) in with().zip(names) {
        let names = arguments(&request.fields);
        let fields = request.fields.iter().zip(&names).map(|(field, name)| field.argument(name));
        let (arguments, built): (Vec<String>, Vec<(String, Doc)>) = fields.unzip();
        let lifetime = if request.borrows { "<'a>" } else { "" };
        let ty = format!("messages::{}", request.name);
        let (arguments, build) = match arguments.len() {
            0 => (Vec::new(), Doc::from(ty.as_str())),
            1..=MAX_ARGUMENTS => (arguments, Data::fields(&ty, built)),
            _ => (vec![format!("message: {ty}{lifetime}")], Doc::from("message")),
        };
        let selector = selector(shaped, messages, shape.message.after.as_ref());
        calls.push(CallModel {
            method: names::escaped(&name),
            docs: call_docs(documentation(shape.message), request),
            ty: format!("{ty}{lifetime}"),
            arguments,
            build,
            borrows: request.borrows,
            deprecated: replacement(shape.message, shaped).map(|note| literal::string(&note)),
            is_selector: model.is_selector,
            after: selector,
        });
    }
    calls
}

/// Returns the names of a method's arguments: the names of the fields. A name that consists only of digits and
/// underscores is replaced, because clippy rejects such names.
fn arguments(fields: &[Field]) -> Vec<String> {
    let mut names: Vec<String> = fields.iter().map(|field| field.name.clone()).collect();
    for at in 0..names.len() {
        if names[at].chars().all(|letter| letter == '_' || letter.is_ascii_digit()) {
            names[at] = unused_name(|name| names.contains(name), format!("value{}", names[at]));
        }
    }
    names
}

/// Returns the documentation of a method: the documentation of the message, and a link to the type of the request.
fn call_docs(mut lines: Vec<String>, request: &DataModel) -> Vec<String> {
    let sends = format!("Sends the message {}.", DocModule::TOP.whole(&format!("messages::{}", request.name)));
    lines.extend([String::new(), sends]);
    docs::exact(lines)
}

/// Returns the type of the message that brings the driver into its state after power-on. Returns `None` if the description
/// states no such state, if no message selects it, or if no request requires it.
pub(super) fn by_default(shaped: &[Shaped<'_>], messages: &[MessageModel], calls: &[CallModel]) -> Option<String> {
    let shape = shaped.iter().find(|shape| shape.message.by_default)?;
    let selector = selector(shaped, messages, shape.message.after.as_ref())?;
    calls.iter().any(|call| call.after.as_ref() == Some(&selector)).then_some(selector)
}

/// Returns a note that names the replacement of a message and, if the description states them, the models that have the
/// replacement. Returns `None` if the message is not replaced.
fn replacement(message: &Message, all: &[Shaped<'_>]) -> Option<String> {
    let name = message.availability.as_ref()?.replaced_by.as_ref()?;
    let other = all.iter().find(|shape| name.id == Some(shape.id.into()));
    let models = other
        .and_then(|shape| shape.message.availability.as_ref())
        .map_or(&[][..], |availability| &availability.models);
    Some(match models {
        [] => format!("replaced by {name}"),
        models => format!("replaced by {name} on {}", models.join(", ")),
    })
}

/// Returns the name of the request type of the referenced message.
fn selector(shaped: &[Shaped<'_>], messages: &[MessageModel], message: Option<&MessageRef>) -> Option<String> {
    let id = message?.id?;
    let at = shaped.iter().position(|shape| shape.id == id)?;
    messages.get(at)?.request.as_ref().map(|request| request.name.clone())
}
