//! Messages for which code is generated, and the reasons why no code is generated for other messages.

use super::frame::Frame;
use super::shaper::{self, Side};
use crate::collections::{HashMap, HashSet};
use crate::ir::{Device, Message, MessageId};

/// The reason why no code is generated for a message.
pub(crate) type Problem = &'static str;

/// A message with the steps of its request and reply.
#[derive(Clone, Debug)]
pub(crate) struct Shaped<'a> {
    pub id: MessageId,
    pub message: &'a Message,
    pub request: Side<'a>,
    pub reply: Side<'a>,
}

impl<'a> Shaped<'a> {
    fn new(device: &'a Device, id: MessageId, message: &'a Message) -> Option<Self> {
        let (request, reply) = sides(device, message).ok()?;
        Some(Shaped { id, message, request, reply })
    }

    /// Returns whether the meaning of a later reply can depend on this message.
    fn can_select(&self) -> bool {
        !self.message.request.is_empty() && !self.request.borrows()
    }
}

fn sides<'a>(device: &'a Device, message: &'a Message) -> Result<(Side<'a>, Side<'a>), Problem> {
    let request = shaper::request(device, message)?;
    let reply = shaper::reply(device, message, &request)?;
    Ok((request, reply))
}

/// Returns the messages for which code is generated.
pub(crate) fn shapes(device: &Device) -> Vec<Shaped<'_>> {
    let messages = (0..).map(MessageId).zip(&device.messages);
    let all: Vec<Shaped<'_>> = messages.filter_map(|(id, message)| Shaped::new(device, id, message)).collect();
    let lost = without_selector(&all);
    all.into_iter().zip(lost).filter(|(_, is_lost)| !is_lost).map(|(shaped, _)| shaped).collect()
}

/// Returns, for each message, whether its reply cannot be decoded. In this case, the meaning of the reply depends on an earlier
/// message, and no message with generated code can determine this meaning.
fn without_selector(all: &[Shaped<'_>]) -> Vec<bool> {
    let selectors: HashSet<MessageId> =
        all.iter().filter(|shaped| shaped.can_select()).map(|shaped| shaped.id).collect();
    let mut dependents: HashMap<Option<MessageId>, Vec<usize>> = HashMap::default();
    for (at, shaped) in all.iter().enumerate() {
        if let Some(after) = &shaped.message.after {
            dependents.entry(after.id).or_default().push(at);
        }
    }
    let mut lost = vec![false; all.len()];
    let unselected = dependents.iter().filter(|(selector, _)| selector.is_none_or(|id| !selectors.contains(&id)));
    let mut found: Vec<usize> = unselected.flat_map(|(_, list)| list.iter().copied()).collect();
    while let Some(at) = found.pop() {
        if std::mem::replace(&mut lost[at], true) || !all[at].can_select() {
            continue;
        }
        found.extend(dependents.get(&Some(all[at].id)).into_iter().flatten());
    }
    lost
}

/// Returns the position of the message that the device sends if it rejects `message`. Returns `None` if there is no such message,
/// if no code is generated for it, or if its reply is empty or borrows from the data.
pub(crate) fn refusal(shapes: &[Shaped<'_>], message: &Message) -> Option<usize> {
    let id = message.error.as_ref()?.id?;
    shapes.iter().position(|shaped| shaped.id == id && !shaped.message.reply.is_empty() && !shaped.reply.borrows())
}

/// Returns the reason as an error if the request or reply of a message cannot be represented as steps.
pub(crate) fn problem(device: &Device, message: &Message) -> Result<(), Problem> {
    sides(device, message).map(drop)
}

/// Returns whether another lint reports the problem: an unresolved name, or fields that are not aligned to whole bytes.
pub(crate) fn is_reported_elsewhere(device: &Device, message: &Message, problem: Problem) -> bool {
    let is_broken = || {
        let request = Frame::new(device, &message.request, &[]);
        request.broken.is_some() || Frame::new(device, &message.reply, &message.request).broken.is_some()
    };
    problem == shaper::UNRESOLVED || problem == shaper::UNALIGNED && is_broken()
}
