//! Names of the types of messages.

use crate::ir::{Device, Message, MessageId};
use crate::names::{self, Case, NameRequest};
use crate::resolve::messages::{self, Shaped};

/// Names that types of messages must not have, because the generated code of messages uses them.
const RESERVED: [&str; 10] = ["Self", "Option", "Result", "Some", "None", "Ok", "Err", "Protocol", "Request", "E"];

/// Names of a message's types: request, reply, list entry of the request, and list entry of the reply.
pub(in crate::backend::rust) type MessageNames = [String; 4];

fn names(shapes: &[Shaped<'_>]) -> Vec<MessageNames> {
    let base_names = shapes.iter().enumerate().flat_map(|(at, shape)| base_names(shape.message).map(|name| (name, at)));
    let base_names: Vec<(String, usize)> = base_names.collect();
    let name_requests = base_names.iter().map(|(name, at)| NameRequest::new(name, "message", at));
    let mut names = names::unique(name_requests, &RESERVED, Case::Pascal).into_iter();
    shapes.iter().map(|_| std::array::from_fn(|_| names.next().unwrap_or_default())).collect()
}

/// Returns the preferred names for the types of a message. If only the device sends the message, the reply has the name
/// of the message.
fn base_names(message: &Message) -> MessageNames {
    let name = &message.name;
    let reply = if message.request.is_empty() { name.to_string() } else { format!("{name} reply") };
    let request = if message.request.is_empty() { format!("{name} request") } else { name.to_string() };
    [request, reply, format!("{name} entry"), format!("{name} reply entry")]
}

/// The messages of a device for which code is generated, with the names of their types.
#[derive(Default)]
pub(in crate::backend::rust) struct NamedMessages<'a> {
    pub shapes: Vec<Shaped<'a>>,
    /// Names of the types of each message, in the order of `shapes`.
    pub names: Vec<MessageNames>,
}

impl<'a> NamedMessages<'a> {
    pub(super) fn of(device: &'a Device) -> Self {
        let shapes = messages::shapes(device);
        NamedMessages { names: names(&shapes), shapes }
    }

    /// Returns the path of each message that has a request or a reply, relative to the device's module.
    pub fn paths(&self) -> impl Iterator<Item = (MessageId, String)> + use<'_> {
        let named = self.shapes.iter().zip(&self.names);
        named.filter_map(|(shape, [request, reply, ..])| {
            let name = match (shape.message.request.is_empty(), shape.message.reply.is_empty()) {
                (false, _) => request,
                (true, false) => reply,
                (true, true) => return None,
            };
            Some((shape.id, format!("messages::{name}")))
        })
    }
}
