//! The names of the types of messages.

use crate::ir::{Device, Message, MessageId};
use crate::names::{self, Case, Wish};
use crate::resolve::messages::{self, Shaped};

/// Names that the code of messages uses itself.
const RESERVED: [&str; 10] = ["Self", "Option", "Result", "Some", "None", "Ok", "Err", "Protocol", "Request", "E"];

/// The names of the types of each message: request, reply, and what is repeated in each.
pub(in crate::backend::rust) type MessageNames = [String; 4];

fn names(shapes: &[Shaped<'_>]) -> Vec<MessageNames> {
    let wished = shapes.iter().enumerate().flat_map(|(at, own)| wished(own.message).map(|name| (name, at)));
    let wished: Vec<(String, usize)> = wished.collect();
    let wishes: Vec<Wish<'_>> = wished.iter().map(|(name, at)| Wish::new(name, "message", at)).collect();
    let mut names = names::unique(&wishes, &RESERVED, Case::Pascal).into_iter();
    shapes.iter().map(|_| std::array::from_fn(|_| names.next().unwrap_or_default())).collect()
}

/// Names of request, reply, and of what is repeated in them. What only a device sends is no reply.
fn wished(message: &Message) -> MessageNames {
    let name = &message.name;
    let reply = if message.request.is_empty() { name.to_string() } else { format!("{name} reply") };
    let request = if message.request.is_empty() { format!("{name} request") } else { name.to_string() };
    [request, reply, format!("{name} entry"), format!("{name} reply entry")]
}

/// The path of a message, from the device's place.
pub(in crate::backend::rust) struct MessagePath {
    pub id: MessageId,
    /// Whether it is a request; else only the device sends it.
    pub is_request: bool,
    pub path: String,
}

/// The messages of a device that have a shape, and their names.
#[derive(Default)]
pub(in crate::backend::rust) struct NamedMessages<'a> {
    pub shapes: Vec<Shaped<'a>>,
    /// By the positions of the shapes.
    pub names: Vec<MessageNames>,
}

impl<'a> NamedMessages<'a> {
    pub(super) fn of(device: &'a Device) -> Self {
        let shapes = messages::shapes(device);
        NamedMessages { names: names(&shapes), shapes }
    }

    /// The paths of all messages.
    pub fn paths(&self) -> impl Iterator<Item = MessagePath> + use<'_> {
        let path = |(own, [request, reply, ..]): (&Shaped<'_>, &MessageNames)| {
            let is_request = !own.message.request.is_empty();
            let path = format!("messages::{}", if is_request { request } else { reply });
            MessagePath { id: own.id, is_request, path }
        };
        let named = self.shapes.iter().zip(&self.names);
        named.filter(|(own, _)| !own.message.request.is_empty() || !own.message.reply.is_empty()).map(path)
    }
}
