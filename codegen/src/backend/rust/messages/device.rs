//! The methods of a device that send messages.

use super::field::Field;
use super::rules::Rules;
use super::{DataModel, MessageModel};
use crate::backend::rust::code::{Data, Doc};
use crate::backend::rust::links::Here;
use crate::backend::rust::literal;
use crate::backend::rust::method_names::beside;
use crate::ir::Message;
use crate::names::{self, Case};
use crate::resolve::messages::Shaped;

/// More arguments than clippy likes.
const MAX_ARGUMENTS: usize = 6;

/// A method, ready to be written.
pub(in crate::backend::rust) struct CallModel {
    pub method: String,
    pub docs: Vec<String>,
    /// The type of the message, with its lifetime.
    pub ty: String,
    pub arguments: Vec<String>,
    /// The expression of the message.
    pub build: Doc,
    /// The lifetime that the arguments have.
    pub borrows: bool,
    pub deprecated: Option<String>,
    pub is_selector: bool,
    /// The type of the message after which the method is there.
    pub after: Option<String>,
}

/// The device as it is after power-on.
pub(in crate::backend::rust) struct DefaultModel {
    /// The type of the message that would select the same.
    pub selector: String,
}

/// The methods for all requests.
pub(super) fn calls(shaped: &[Shaped<'_>], messages: &[MessageModel], rules: &Rules, taken: &[&str]) -> Vec<CallModel> {
    let with = || shaped.iter().zip(messages).filter_map(|(own, model)| Some((own, model, model.request.as_ref()?)));
    let mut wishes = names::numbered(with().map(|(own, ..)| own.message.name.as_str()), "message");
    for wish in &mut wishes {
        wish.suffix.insert_str(0, "message_");
    }
    let names = names::unique(&wishes, taken, Case::Snake);
    let mut calls = Vec::new();
    for ((own, model, request), name) in with().zip(names) {
        let names = arguments(&request.fields);
        let fields = request.fields.iter().zip(&names).map(|(field, name)| field.argument(name, rules));
        let (arguments, built): (Vec<String>, Vec<(String, Doc)>) = fields.unzip();
        let lifetime = if request.borrows { "<'a>" } else { "" };
        let ty = format!("messages::{}", request.name);
        let (arguments, build) = match arguments.len() {
            0 => (Vec::new(), Doc::from(ty.as_str())),
            1..=MAX_ARGUMENTS => (arguments, Data::fields(&ty, built)),
            _ => (vec![format!("message: {ty}{lifetime}")], Doc::from("message")),
        };
        let after = own.message.after.as_ref();
        let selector = selector(shaped, messages, after.map(|own| own.as_str()));
        calls.push(CallModel {
            method: names::escaped(&name),
            docs: docs(model, request),
            ty: format!("{ty}{lifetime}"),
            arguments,
            build,
            borrows: request.borrows,
            deprecated: replacement(own.message, shaped).map(|note| literal::string(&note)),
            is_selector: model.is_selector,
            after: selector,
        });
    }
    calls
}

/// What a method calls its arguments: as the fields, but for a number alone, which clippy takes for no name.
fn arguments(fields: &[Field]) -> Vec<String> {
    let mut names: Vec<String> = fields.iter().map(|field| field.name.clone()).collect();
    for at in 0..names.len() {
        if names[at].chars().all(|letter| letter == '_' || letter.is_ascii_digit()) {
            names[at] = beside(|name| names.contains(name), format!("value{}", names[at]));
        }
    }
    names
}

/// The lines about a method: those about the message, and what it sends.
fn docs(model: &MessageModel, request: &DataModel) -> Vec<String> {
    let sends = format!("Sends {}.", Here::TOP.whole(&format!("messages::{}", request.name)));
    model.call_docs.iter().cloned().chain([String::new(), sends]).collect()
}

/// What is answered after power-on; `None` where nothing is said of it, or the selector isn't known.
pub(super) fn by_default(
    shaped: &[Shaped<'_>],
    messages: &[MessageModel],
    calls: &[CallModel],
) -> Option<DefaultModel> {
    let own = shaped.iter().find(|own| own.message.by_default)?;
    let selector = selector(shaped, messages, own.message.after.as_ref().map(|own| own.as_str()))?;
    calls.iter().any(|call| call.after.as_ref() == Some(&selector)).then_some(DefaultModel { selector })
}

/// What to use instead of a message, and the only models that have it.
fn replacement(message: &Message, all: &[Shaped<'_>]) -> Option<String> {
    let name = message.availability.as_ref()?.replaced_by.as_ref()?;
    let other = all.iter().find(|own| own.message.name == *name);
    let models = other.and_then(|own| own.message.availability.as_ref()).map_or(&[][..], |own| &own.models);
    Some(match models {
        [] => format!("replaced by {name}"),
        models => format!("replaced by {name} on {}", models.join(", ")),
    })
}

/// The type of the message called so.
fn selector(shaped: &[Shaped<'_>], messages: &[MessageModel], name: Option<&str>) -> Option<String> {
    let at = shaped.iter().position(|own| Some(own.message.name.as_str()) == name)?;
    messages.get(at)?.request.as_ref().map(|request| request.name.clone())
}
