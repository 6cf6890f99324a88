//! Reports messages, framings and parameters for which no code is generated, with the reason.

use std::collections::BTreeMap;

use crate::check::context::Context;
use crate::collections::HashSet;
use crate::diagnostics::{codes, Diagnostics};
use crate::ir::{Device, Framing, MessageId, Type};
use crate::number::hex;
use crate::resolve::messages::{
    carrier_problems, is_reported_elsewhere, numbered, problem, refusal, shapes, Problem, Shaped, LONGEST,
};
use crate::source::Span;
use crate::text::brief;

const SELECTOR: Problem =
    "the message in `after` is not sent, has no generated code, or has data of variable length, so the client cannot \
     remember it";
const FIRST: Problem = "`default` needs `after`, the message that selects another answer";
const NO_REFUSAL: Problem = "the error message has no reply, no generated code, or data of variable length";
const NO_END: Problem = "no byte marks the end of a frame";
const UNKNOWN_CHECK: Problem = "the runtime supports only the checks `xor`, `sum`, `lrc` and `crc16`";

/// Reports messages and framings for which no code is generated, parameters that no message transfers, and parameter numbers that
/// occur twice.
pub(in crate::check) fn check(context: &Context<'_>, diagnostics: &mut Diagnostics) {
    let device = context.device;
    let shapes = shapes(device);
    every_message(device, &shapes, diagnostics);
    if let Some((framing, problem)) = device.framing.as_ref().and_then(|framing| Some((framing, no_framing(framing)?)))
    {
        left_out(framing.origin.span, format!("no code is generated for the framing: {problem}"), diagnostics);
    }
    parameters(context, &shapes, diagnostics);
}

fn left_out(at: Span, text: String, diagnostics: &mut Diagnostics) {
    diagnostics.push(codes::MESSAGE_UNSHAPED.at(at, text));
}

fn every_message(device: &Device, shapes: &[Shaped<'_>], diagnostics: &mut Diagnostics) {
    let shaped: HashSet<MessageId> = shapes.iter().map(|shaped| shaped.id).collect();
    for (id, message) in (0..).map(MessageId).zip(&device.messages) {
        let name = brief(&message.name);
        let span = message.origin.span;
        let problem = match problem(device, message) {
            Err(problem) if is_reported_elsewhere(device, message, problem) => continue,
            Err(problem) => Some(problem),
            Ok(()) => (!shaped.contains(&id)).then_some(SELECTOR),
        };
        if let Some(problem) = problem {
            left_out(span, format!("no code is generated for the message `{name}`: {problem}"), diagnostics);
            continue;
        }
        if message.by_default && message.after.is_none() {
            let message = format!("no code is generated for `{name}` as the answer after power-on: {FIRST}");
            left_out(span, message, diagnostics);
        }
        if message.error.is_some() && refusal(shapes, message).is_none() {
            left_out(span, format!("no code is generated for the error reply of `{name}`: {NO_REFUSAL}"), diagnostics);
        }
    }
}

/// Returns the reason why no code is generated for a framing that needs code. A framing with neither delimiters nor a check needs
/// no code, because each packet on the bus is one frame.
fn no_framing(framing: &Framing) -> Option<Problem> {
    let is_delimited = framing.start.is_some() || framing.escape.is_some() || !framing.check.is_empty();
    match framing.check.as_str() {
        _ if framing.end.is_none() => is_delimited.then_some(NO_END),
        "" | "xor" | "sum" | "lrc" | "crc16" => None,
        _ => Some(UNKNOWN_CHECK),
    }
}

/// Reports messages that cannot transfer their parameters, parameters that no message transfers, and parameter numbers
/// that occur twice.
fn parameters(context: &Context<'_>, shapes: &[Shaped<'_>], diagnostics: &mut Diagnostics) {
    let mut carried: BTreeMap<u32, &str> = BTreeMap::new();
    for space in &context.device.parameter_spaces {
        for (verb, name, problem) in carrier_problems(space, shapes) {
            let (name, space_name) = (brief(name), brief(&space.name));
            let text = format!("no generated client {verb} parameters of `{space_name}` with `{name}`: {problem}");
            left_out(space.origin.span, text, diagnostics);
        }
        if space.read.is_none() && space.write.is_none() {
            continue;
        }
        for (code, item) in numbered(context.device, &space.name) {
            // The length of an item cannot be checked if its type is unknown.
            let basic = context.owner.basic(item.ty);
            if !matches!(basic, Type::Opaque(None)) && basic.bits().is_none_or(|bits| bits > LONGEST) {
                let name = brief(&item.name);
                let text = format!("no message transfers `{name}`: its value does not have 1 to 8 bytes");
                left_out(item.origin.span, text, diagnostics);
            }
            match carried.get(&code) {
                None => _ = carried.insert(code, &space.name),
                Some(first) => {
                    let (name, first, code) = (brief(&item.name), brief(first), hex(code));
                    let text = format!(
                        "the parameter `{name}` has the same number {code} as a parameter in the space `{first}`"
                    );
                    let text = text + ", and clients transfer only the parameter in that space";
                    diagnostics.push(codes::PARAMETERS_ALIKE.at(item.origin.span, text));
                }
            }
        }
    }
}
