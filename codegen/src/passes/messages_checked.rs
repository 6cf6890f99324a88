//! After this pass messages were held against each other: they are whole bytes, fit into a frame, and whoever receives one can tell
//! which it is; and against the tables of what commands do in each state.

use std::collections::BTreeSet;

use super::message_frames::Frame;
use crate::diagnostics::{codes, Code, Diagnostic, Diagnostics};
use crate::ir::{Device, Message, Outcome};
use crate::text::brief;

/// So many other requests begin alike before one that doesn't looks like a misprint.
const ALIKE: usize = 8;

/// A message with its frames.
struct Framed<'d> {
    message: &'d Message,
    request: Frame,
    reply: Frame,
}

pub(super) fn run<'d>(device: &'d Device, diagnostics: &mut Diagnostics) {
    let frame = |message: &'d Message| {
        let request = Frame::new(device, &message.request, &[]);
        let reply = Frame::new(device, &message.reply, &message.request);
        Framed { message, request, reply }
    };
    let all: Vec<Framed<'_>> = device.messages.iter().map(frame).collect();
    let max = device.framing.as_ref().and_then(|framing| framing.max_data).map(usize::from);
    for own in &all {
        length(own, max, diagnostics);
        reply_of_another(own, &all, diagnostics);
        like_its_error(own, &all, diagnostics);
        states(device, own.message, diagnostics);
    }
    requests_alike(&all, diagnostics);
    odd_request(&all, diagnostics);
}

fn report(own: &Framed<'_>, code: &'static Code, message: String) -> Diagnostic {
    Diagnostic::new(code, own.message.origin.span, message)
}

/// Whole bytes, and no more than a frame holds.
fn length(own: &Framed<'_>, max: Option<usize>, diagnostics: &mut Diagnostics) {
    for (what, frame) in [("request", &own.request), ("reply", &own.reply)] {
        let name = brief(&own.message.name);
        if let Some(bit) = frame.broken {
            let message = format!("the {what} of `{name}` has bits up to bit {bit} that are no whole bytes");
            let found = report(own, &codes::MESSAGE_LENGTH, message);
            diagnostics.push(found.help("fields of less than a byte follow each other, and fill bytes"));
        }
        let Some(max) = max else { continue };
        let problem = match (frame.least.div_ceil(8), frame.most.div_ceil(8)) {
            (least, _) if least > max => format!("is at least {least} bytes long"),
            (_, most) if most > max => format!("is {most} bytes long with all its repetitions"),
            _ => continue,
        };
        let message = format!("the {what} of `{name}` {problem}, and a frame holds {max}");
        let found = report(own, &codes::MESSAGE_LENGTH, message);
        diagnostics.push(found.help("`max` of repeated fields is how many fit, or one of the lengths is another"));
    }
}

/// A reply whose first constant is that of another message, and isn't in its own request.
fn reply_of_another(own: &Framed<'_>, all: &[Framed<'_>], diagnostics: &mut Diagnostics) {
    let Some((place, byte)) = own.reply.constants.first_key_value() else { return };
    if own.request.constants.is_empty() || own.request.constants.values().any(|own| own == byte) {
        return;
    }
    let other = all.iter().find(|other| {
        let answers = other.reply.constants.first_key_value() == Some((place, byte));
        answers && other.message.name != own.message.name && other.request.constants.values().any(|own| own == byte)
    });
    if let Some(other) = other {
        let message = format!(
            "the reply of `{}` has the constant 0x{byte:02X} of `{}`, which its request doesn't have",
            brief(&own.message.name),
            brief(&other.message.name)
        );
        let found = report(own, &codes::REPLY_OF_ANOTHER, message).note_at(other.message.origin.span, "the other one");
        diagnostics.push(found.help("the table of one was copied from the other: compare both with their texts"));
    }
}

/// A reply that can't be told from what comes where the device refuses.
fn like_its_error(own: &Framed<'_>, all: &[Framed<'_>], diagnostics: &mut Diagnostics) {
    let Some(error) = own.message.error.as_ref() else { return };
    let Some(other) = all.iter().find(|other| other.message.name == *error) else { return };
    if !own.message.reply.is_empty() && own.reply.overlaps(&other.reply) {
        let message = format!(
            "the reply of `{}` can have the same bytes as `{}`, which comes in its place",
            brief(&own.message.name),
            brief(error)
        );
        let found = report(own, &codes::ERROR_ALIKE, message).note_at(other.message.origin.span, "the other one");
        diagnostics.push(found.help("where the device never refuses it, leave out `error`"));
    }
}

/// Requests that a device can't tell apart, where no earlier message decides.
fn requests_alike(all: &[Framed<'_>], diagnostics: &mut Diagnostics) {
    for (at, own) in all.iter().enumerate().filter(|(_, own)| !own.message.request.is_empty()) {
        let is_same = |other: &&Framed<'_>| {
            let decided = own.message.after.is_some() || other.message.after.is_some();
            !other.message.request.is_empty() && !decided && own.request.overlaps(&other.request)
        };
        if let Some(other) = all[..at].iter().find(is_same) {
            let message = format!(
                "the requests `{}` and `{}` can have the same bytes",
                brief(&other.message.name),
                brief(&own.message.name)
            );
            let found =
                report(own, &codes::MESSAGES_ALIKE, message).note_at(other.message.origin.span, "the other one");
            diagnostics.push(found.help("one has a wrong constant; where an earlier message decides, say `after`"));
        }
    }
}

/// The only request that begins with another constant than all others of several constants.
fn odd_request(all: &[Framed<'_>], diagnostics: &mut Diagnostics) {
    let long = |own: &&Framed<'_>| own.request.first_run().len() > 1;
    let first = |own: &Framed<'_>| own.request.constants.first_key_value().map(|(place, byte)| (*place, *byte));
    let list: Vec<&Framed<'_>> = all.iter().filter(long).collect();
    let odd = |own: &&&Framed<'_>| {
        let same = list.iter().filter(|other| first(other) == first(own)).count();
        same == 1 && list.len() > ALIKE
    };
    let mut found = list.iter().filter(odd);
    let (Some(own), None) = (found.next(), found.next()) else { return };
    let others: BTreeSet<_> =
        list.iter().filter(|other| first(other) != first(own)).filter_map(|other| first(other)).collect();
    if let ([(place, byte)], Some((_, odd))) = (others.into_iter().collect::<Vec<_>>().as_slice(), first(own)) {
        let message = format!(
            "`{}` has the constant 0x{odd:02X} where {} other requests have 0x{byte:02X}, in byte {place}",
            brief(&own.message.name),
            list.len() - 1
        );
        let found = report(own, &codes::ODD_REQUEST, message);
        diagnostics.push(found.help("it is an exception or a misprint: say which with a `doubt`, and allow this code"));
    }
}

/// What a message says of states in which it is accepted, and the table of commands and states.
fn states(device: &Device, message: &Message, diagnostics: &mut Diagnostics) {
    if message.accepted_in.is_empty() {
        return;
    }
    for machine in &device.machines {
        let rows = machine.outcomes.iter().filter(|row| row.commands.contains(&message.name));
        for cell in rows.flat_map(|row| &row.cells).filter(|cell| !cell.outcomes.is_empty()) {
            let says = message.accepted_in.contains(&cell.state);
            let can = cell.outcomes.iter().any(|outcome| *outcome != Outcome::Refused);
            if says != can {
                let (own, table) = if says { ("accepted", "refuses") } else { ("not accepted", "accepts") };
                let text = format!(
                    "`{}` is {own} in `{}`, and the table of `{}` {table} it there",
                    brief(&message.name),
                    brief(&cell.state),
                    brief(&machine.name)
                );
                let found = Diagnostic::new(&codes::STATES_DIFFER, message.origin.span, text);
                diagnostics.push(found.help("keep what the manual says state by state, with a `doubt`"));
            }
        }
    }
}
