//! After this pass every request and reply has a shape that code can have, or it was reported.
//!
//! [`shapes`] gives these to back ends: steps of known length one after the other, among which one at most is as long as the data
//! are.

mod parameters;
mod shaper;
mod step;

use std::collections::{HashMap, HashSet};

use super::message_frames::Frame;
use crate::diagnostics::{codes, Diagnostic, Diagnostics};
use crate::ir::{Device, Framing, Message};
use crate::source::Span;
use crate::text::brief;

pub(crate) use parameters::{carriers, numbered};
pub(crate) use shaper::Side;
pub(crate) use step::{tail, Step};

/// Why there is no code.
type Problem = &'static str;

const SELECTOR: Problem =
    "what `after` names isn't sent, has no code, or has data of any length, so that nothing can be remembered of it";
const FIRST: Problem = "`default` says what is answered before any other message was sent, and there is no `after`";
const NO_REFUSAL: Problem = "what comes instead of its reply has no reply of its own, no code, or data of any length";
const NO_END: Problem = "they have no last byte";
const UNKNOWN_CHECK: Problem = "the runtime has `xor`, `sum`, `lrc` and `crc16`";

/// A message with the shapes of its data.
#[derive(Clone, Debug)]
pub(crate) struct Shaped<'a> {
    pub message: &'a Message,
    pub request: Side<'a>,
    pub reply: Side<'a>,
}

impl<'a> Shaped<'a> {
    fn new(device: &'a Device, message: &'a Message) -> Result<Self, Problem> {
        let request = shaper::request(device, message)?;
        let reply = shaper::reply(device, message, &request)?;
        Ok(Shaped { message, request, reply })
    }

    fn is_called(&self, name: &str) -> bool {
        self.message.name == name
    }

    /// Whether later messages can depend on it.
    fn can_select(&self) -> bool {
        !self.message.request.is_empty() && !self.request.borrows()
    }
}

/// The messages for which code is generated.
pub(crate) fn shapes(device: &Device) -> Vec<Shaped<'_>> {
    let all: Vec<Shaped<'_>> = device.messages.iter().filter_map(|message| Shaped::new(device, message).ok()).collect();
    let lost = without_selector(&all);
    all.into_iter().zip(lost).filter(|(_, is_lost)| !is_lost).map(|(own, _)| own).collect()
}

/// Which messages depend on one that can't select anything, or on one that is lost for that.
fn without_selector(all: &[Shaped<'_>]) -> Vec<bool> {
    let mut selectors: HashMap<&str, usize> = HashMap::new();
    let mut dependents: HashMap<&str, Vec<usize>> = HashMap::new();
    for (at, own) in all.iter().enumerate() {
        if own.can_select() {
            *selectors.entry(&own.message.name).or_default() += 1;
        }
        if let Some(after) = own.message.after.as_deref() {
            dependents.entry(after).or_default().push(at);
        }
    }
    let mut lost = vec![false; all.len()];
    let mut found: Vec<usize> = dependents
        .iter()
        .filter(|(name, _)| !selectors.contains_key(*name))
        .flat_map(|(_, list)| list.iter().copied())
        .collect();
    while let Some(at) = found.pop() {
        if std::mem::replace(&mut lost[at], true) || !all[at].can_select() {
            continue;
        }
        let name = all[at].message.name.as_str();
        let left = selectors.entry(name).or_default();
        *left -= 1;
        if *left == 0 {
            found.extend(dependents.get(name).into_iter().flatten());
        }
    }
    lost
}

/// What comes where a device refuses a message; `None` where it doesn't, or no code can be generated for that.
pub(crate) fn refusal(shapes: &[Shaped<'_>], message: &Message) -> Option<usize> {
    let name = message.error.as_deref()?;
    shapes.iter().position(|own| own.is_called(name) && !own.message.reply.is_empty() && !own.reply.borrows())
}

/// Why no code is generated for a framing. Where nothing delimits frames, such as on a bus that has packets of its own, none is
/// needed.
fn framing(framing: &Framing) -> Option<Problem> {
    let is_delimited = framing.start.is_some() || framing.escape.is_some() || !framing.check.is_empty();
    match framing.check.as_str() {
        _ if framing.end.is_none() => is_delimited.then_some(NO_END),
        "" | "xor" | "sum" | "lrc" | "crc16" => None,
        _ => Some(UNKNOWN_CHECK),
    }
}

/// Reports messages for which no code is generated, and what they lack.
pub(super) fn run(device: &Device, diagnostics: &mut Diagnostics) {
    let shapes = shapes(device);
    let known: HashSet<&str> = shapes.iter().map(|own| own.message.name.as_str()).collect();
    let mut left_out = |at: Span, text: String| {
        diagnostics.push(Diagnostic::new(&codes::MESSAGE_UNSHAPED, at, text));
    };
    for message in &device.messages {
        let name = brief(&message.name);
        let span = message.origin.span;
        let problem = match Shaped::new(device, message) {
            Err(problem) if is_told(device, message, problem) => continue,
            Err(problem) => Some(problem),
            Ok(own) => (!known.contains(own.message.name.as_str())).then_some(SELECTOR),
        };
        if let Some(problem) = problem {
            left_out(span, format!("no code for the message `{name}`: {problem}"));
            continue;
        }
        if message.by_default && message.after.is_none() {
            left_out(span, format!("no code for `{name}` as the device is after power-on: {FIRST}"));
        }
        if message.error.is_some() && refusal(&shapes, message).is_none() {
            left_out(span, format!("no code for a refused `{name}`: {NO_REFUSAL}"));
        }
    }
    if let Some((own, problem)) = device.framing.as_ref().and_then(|own| Some((own, framing(own)?))) {
        left_out(own.origin.span, format!("no code for how frames are delimited: {problem}"));
    }
    parameters::run(device, &shapes, diagnostics);
}

/// Whether a name that leads nowhere, or bytes that aren't whole, were reported already.
fn is_told(device: &Device, message: &Message, problem: Problem) -> bool {
    let is_broken = || {
        let request = Frame::new(device, &message.request, &[]);
        request.broken.is_some() || Frame::new(device, &message.reply, &message.request).broken.is_some()
    };
    problem == shaper::UNRESOLVED || problem == shaper::UNALIGNED && is_broken()
}
