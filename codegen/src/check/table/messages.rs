//! Checks that messages consist of whole bytes and fit into a frame, and that the receiver can distinguish them. Also compares
//! the messages with the state-command matrices.

use std::collections::BTreeMap;

use crate::check::context::Context;
use crate::diagnostics::{codes, Code, Diagnostic, Diagnostics};
use crate::ir::{CommandOutcomes, Device, DeviceStateId, Message, Outcome, StateMachine};
use crate::number::hex8;
use crate::resolve::messages::Frame;
use crate::text::brief;

/// Minimum number of requests with the same first constant. If so many requests have the same first constant, a single request
/// with another first constant is probably a misprint.
const ALIKE: usize = 8;

/// A message, with the frames of its request and reply.
struct Framed<'d> {
    message: &'d Message,
    request: Frame,
    reply: Frame,
}

pub(crate) fn check<'d>(context: &Context<'d>, diagnostics: &mut Diagnostics) {
    let device = context.device;
    let frame = |message: &'d Message| {
        let request = Frame::new(device, &message.request, &[]);
        let reply = Frame::new(device, &message.reply, &message.request);
        Framed { message, request, reply }
    };
    let all: Vec<Framed<'_>> = device.messages.iter().map(frame).collect();
    let max = device.framing.as_ref().and_then(|framing| framing.max_data).map(usize::from);
    for framed in &all {
        length(framed, max, diagnostics);
    }
    replies_of_others(&all, diagnostics);
    like_their_errors(&all, diagnostics);
    requests_alike(&all, diagnostics);
    odd_request(&all, diagnostics);
    states(device, diagnostics);
}

fn report(framed: &Framed<'_>, code: &'static Code, message: String) -> Diagnostic {
    code.at(framed.message.origin.span, message)
}

/// Creates a diagnostic that marks two messages.
fn both(framed: &Framed<'_>, other: &Framed<'_>, code: &'static Code, message: String) -> Diagnostic {
    report(framed, code, message).note_at(other.message.origin.span, "the other message")
}

/// Checks that a message consists of whole bytes and fits into a frame.
fn length(framed: &Framed<'_>, max: Option<usize>, diagnostics: &mut Diagnostics) {
    for (what, frame) in [("request", &framed.request), ("reply", &framed.reply)] {
        let name = brief(&framed.message.name);
        if let Some(bit) = frame.broken {
            let message = format!("the {what} of `{name}` has an incomplete byte that ends at bit {bit}");
            let found = report(framed, &codes::MESSAGE_LENGTH, message);
            diagnostics.push(found.help("make adjacent fields that are shorter than a byte fill whole bytes"));
        }
        let Some(max) = max else { continue };
        let problem = match (frame.min_bits.div_ceil(8), frame.max_bits.div_ceil(8)) {
            (shortest, _) if shortest > max => format!("is at least {shortest} bytes long"),
            (_, longest) if longest > max => format!("is {longest} bytes long with all repetitions"),
            _ => continue,
        };
        let message = format!("the {what} of `{name}` {problem}, but a frame holds at most {max} data bytes");
        let found = report(framed, &codes::MESSAGE_LENGTH, message);
        diagnostics.push(found.help("correct a length, or the `max` of repeated fields"));
    }
}

/// Reports a reply whose first constant is probably that of another message. The constant is not in the request of this
/// message, but in the request of another message whose reply has the same first constant in the same byte.
fn replies_of_others(all: &[Framed<'_>], diagnostics: &mut Diagnostics) {
    let first =
        |framed: &Framed<'_>| framed.reply.constants.first_key_value().map(|(position, byte)| (*position, *byte));
    let asks = |framed: &Framed<'_>, byte: u8| framed.request.constants.values().any(|constant| *constant == byte);
    let mut owners: BTreeMap<(usize, u8), &Framed<'_>> = BTreeMap::new();
    for framed in all {
        if let Some(first) = first(framed).filter(|(_, byte)| asks(framed, *byte)) {
            owners.entry(first).or_insert(framed);
        }
    }
    for framed in all.iter().filter(|framed| !framed.request.constants.is_empty()) {
        let Some((position, byte)) = first(framed).filter(|(_, byte)| !asks(framed, *byte)) else { continue };
        let Some(other) = owners.get(&(position, byte)) else { continue };
        let (name, other_name, constant) = (brief(&framed.message.name), brief(&other.message.name), hex8(byte));
        let message = format!(
            "the reply of `{name}` has the constant {constant}, which is in the request of `{other_name}`, but not in \
             the request of `{name}`"
        );
        let found = both(framed, other, &codes::REPLY_OF_ANOTHER, message);
        let help = "compare both tables with the manual's text, because one was probably copied from the other";
        diagnostics.push(found.help(help));
    }
}

/// Reports replies that cannot be distinguished from the error reply.
fn like_their_errors(all: &[Framed<'_>], diagnostics: &mut Diagnostics) {
    for framed in all.iter().filter(|framed| !framed.message.reply.is_empty()) {
        let id = framed.message.error.as_ref().and_then(|error| error.id);
        let Some(other) = id.and_then(|id| all.get(id.0 as usize)) else { continue };
        if framed.reply.overlaps(&other.reply) {
            let (name, other_name) = (brief(&framed.message.name), brief(&other.message.name));
            let message = format!("the reply of `{name}` can have the same bytes as its error reply `{other_name}`");
            let found = both(framed, other, &codes::ERROR_ALIKE, message);
            diagnostics.push(found.help("delete `error` if the device never refuses the request"));
        }
    }
}

/// Reports requests that a device cannot distinguish, unless an earlier message decides which request is meant. The requests are
/// sorted by their first constants, so that requests with possibly equal bytes are adjacent.
fn requests_alike(all: &[Framed<'_>], diagnostics: &mut Diagnostics) {
    let runs = all.iter().enumerate().filter(|(_, framed)| !framed.message.request.is_empty());
    let mut runs: Vec<(Option<usize>, Vec<u8>, usize, &Framed<'_>)> = runs
        .map(|(at, framed)| (framed.request.constants.keys().next().copied(), framed.request.first_run(), at, framed))
        .collect();
    runs.sort_by(|one, other| (one.0, &one.1, one.2).cmp(&(other.0, &other.1, other.2)));
    let (mut before, mut found): (Vec<usize>, Vec<(usize, usize)>) = (Vec::new(), Vec::new());
    for (at, (position, run, index, framed)) in runs.iter().enumerate() {
        let begins = |other: &usize| {
            runs.get(*other).is_some_and(|(others, shorter, ..)| others == position && run.starts_with(shorter))
        };
        while before.pop_if(|other| !begins(other)).is_some() {}
        let is_same = |other: &&Framed<'_>| {
            framed.message.after.is_none() && other.message.after.is_none() && framed.request.overlaps(&other.request)
        };
        let others = before.iter().filter_map(|other| runs.get(*other));
        if let Some((.., other, _)) = others.clone().find(|(.., other)| is_same(other)) {
            found.push((*index.max(other), *index.min(other)));
        }
        before.push(at);
    }
    found.sort_unstable();
    for (framed, other) in found.into_iter().filter_map(|(framed, other)| Some((all.get(framed)?, all.get(other)?))) {
        let names = (brief(&other.message.name), brief(&framed.message.name));
        let message = format!("the requests `{}` and `{}` can have the same bytes", names.0, names.1);
        let found = both(framed, other, &codes::MESSAGES_ALIKE, message);
        let help = "correct a constant, or add `after` if an earlier message decides which request is meant";
        diagnostics.push(found.help(help));
    }
}

/// Compares the requests whose first constant byte is directly followed by another constant byte. Reports a single request whose
/// first constant differs, if all others have the same first constant and their number is at least [`ALIKE`].
fn odd_request(all: &[Framed<'_>], diagnostics: &mut Diagnostics) {
    let mut groups: BTreeMap<(usize, u8), Vec<&Framed<'_>>> = BTreeMap::new();
    for framed in all.iter().filter(|framed| framed.request.first_run().len() > 1) {
        if let Some((position, byte)) = framed.request.constants.first_key_value() {
            groups.entry((*position, *byte)).or_default().push(framed);
        }
    }
    let groups: Vec<_> = groups.into_iter().collect();
    let [one, other] = groups.as_slice() else { return };
    let (odd, others) = if one.1.len() < other.1.len() { (one, other) } else { (other, one) };
    let ((_, byte), [framed]) = (odd.0, odd.1.as_slice()) else { return };
    if others.1.len() < ALIKE {
        return;
    }
    let (name, ((position, common), others)) = (brief(&framed.message.name), (others.0, others.1.len()));
    let (odd, common) = (hex8(byte), hex8(common));
    let message = format!(
        "the request `{name}` has the constant {odd} in byte {position}, but {others} other requests have \
         {common} in this byte"
    );
    let found = report(framed, &codes::ODD_REQUEST, message);
    let help = "record in a `doubt` whether the constant is an exception or a misprint, and allow this code";
    diagnostics.push(found.help(help));
}

/// Compares the state-command matrices with the states in which the device accepts each message.
fn states(device: &Device, diagnostics: &mut Diagnostics) {
    for (number, machine) in (0..).zip(&device.machines) {
        for row in &machine.outcomes {
            let messages = row.commands.iter().filter_map(|command| device.messages.get(command.id?.0 as usize));
            for message in messages.filter(|message| !message.accepted_in.is_empty()) {
                cells(number, machine, row, message, diagnostics);
            }
        }
    }
}

/// Compares a row of the matrix of a state machine with a message. `number` is the index of the state machine in
/// `Device::machines`.
fn cells(number: u32, machine: &StateMachine, row: &CommandOutcomes, message: &Message, diagnostics: &mut Diagnostics) {
    for cell in row.cells.iter().filter(|cell| !cell.outcomes.is_empty()) {
        let id = cell.state.id.map(|state| DeviceStateId { machine: number, state });
        let is_stated = id.is_some() && message.accepted_in.iter().any(|state| state.id == id);
        let can = cell.outcomes.iter().any(|outcome| *outcome != Outcome::Refused);
        if is_stated == can {
            continue;
        }
        let (stated, table) = if is_stated { ("lists", "refuses") } else { ("does not list", "accepts") };
        let (name, state, machine) = (brief(&message.name), brief(&cell.state), brief(&machine.name));
        let text = format!(
            "`accepted_in` of the message `{name}` {stated} the state `{state}`, but the matrix of `{machine}` states \
             that the device {table} the command in this state"
        );
        let found = codes::STATES_DIFFER.at(message.origin.span, text);
        diagnostics.push(found.help("keep the statement that lists the states one by one, and add a `doubt`"));
    }
}
