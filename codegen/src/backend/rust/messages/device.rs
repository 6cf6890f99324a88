//! The methods of a device that send messages.

use super::rules::Rules;
use super::{MessageModel, Shaped};
use crate::backend::rust::docs;
use crate::passes::names_unique::{self, Case, Wish};

/// More arguments than clippy likes.
const MAX_ARGUMENTS: usize = 6;

/// A method, ready to be written.
pub(in crate::backend::rust) struct CallModel {
    pub method: String,
    pub heading: String,
    /// The type of the message, with its lifetime.
    pub ty: String,
    pub arguments: Vec<String>,
    /// The expression of the message.
    pub build: String,
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
    let wish = |(at, (own, ..)): (usize, (&Shaped<'_>, _, _))| (own.message.name.to_string(), at);
    let names: Vec<(String, usize)> = with().enumerate().map(|(at, own)| wish((at, own))).collect();
    let wishes: Vec<Wish<'_>> = names
        .iter()
        .map(|(name, at)| Wish { name, fallback: format!("message {at}"), suffix: format!("message {at}") })
        .collect();
    let names = names_unique::unique(&wishes, taken, Case::Snake);
    let mut calls = Vec::new();
    for ((own, model, request), name) in with().zip(names) {
        let fields: Vec<_> = request.fields.iter().map(|field| (field, field.argument(rules))).collect();
        let lifetime = if request.borrows { "<'a>" } else { "" };
        let ty = format!("messages::{}", request.name);
        let (arguments, build) = if fields.is_empty() {
            (Vec::new(), ty.clone())
        } else if fields.len() > MAX_ARGUMENTS {
            (vec![format!("message: {ty}{lifetime}")], "message".to_owned())
        } else {
            let arguments = fields.iter().map(|(field, (ty, _))| format!("{}: {ty}", field.name)).collect();
            let own: Vec<String> = fields.into_iter().map(|(_, (_, own))| own).collect();
            (arguments, super::literal(&ty, &own, 8))
        };
        let after = own.message.after.as_ref();
        let selector = shaped.iter().find(|other| Some(&other.message.name) == after);
        let replaced = own.message.availability.as_ref().and_then(|own| own.replaced_by.as_ref());
        calls.push(CallModel {
            method: names_unique::escaped(&name),
            heading: docs::sentence(&docs::escape(&own.message.name)),
            ty: format!("{ty}{lifetime}"),
            arguments,
            build,
            borrows: request.borrows,
            deprecated: replaced.map(|other| crate::backend::rust::literal::string(&format!("replaced by {other}"))),
            is_selector: model.is_selector,
            after: selector.map(|other| other.names[0].clone()),
        });
    }
    calls
}

/// What is answered after power-on; `None` where nothing is said of it, or the selector isn't known.
pub(super) fn by_default(shaped: &[Shaped<'_>], calls: &[CallModel]) -> Option<DefaultModel> {
    let own = shaped.iter().find(|own| own.message.by_default)?;
    let selector = shaped.iter().find(|other| own.message.after.as_ref() == Some(&other.message.name))?;
    let name = selector.names[0].clone();
    calls.iter().any(|call| call.after.as_ref() == Some(&name)).then_some(DefaultModel { selector: name })
}
