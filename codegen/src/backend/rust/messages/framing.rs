//! Constants of a message protocol: frame delimiters, maximum length, and whether requests contain a station number.

use crate::backend::rust::code::{Data, Declaration, Doc};
use crate::backend::rust::context::Context;
use crate::backend::rust::docs;
use crate::ir::{Device, Framing};
use crate::number::{hex16, hex8};
use crate::resolve::messages::{Shaped, Step};

/// Assumed length in bytes of a part of the message data that has no maximum length.
const UNBOUNDED_LENGTH: u32 = 256;

/// Returns the constant with the framing of messages. Returns `None` if frames have no end byte, or if the runtime does
/// not support the checksum algorithm.
pub(super) fn constant(framing: &Framing, context: &Context<'_>, shaped: &[Shaped<'_>]) -> Option<Declaration> {
    let byte = |byte: u8| Doc::from(hex8(byte));
    let max = framing.max_data.map_or_else(|| "usize::MAX".to_owned(), |max| max.to_string());
    let from = check_start(shaped).unwrap_or(0);
    let escape = |escape: u8| {
        let escaped = framing.escaped.iter().copied().map(byte);
        let fields = vec![("byte", byte(escape)), ("xor", byte(framing.escape_xor)), ("escaped", Data::slice(escaped))];
        Data::fields("rt::framing::Escape", fields)
    };
    let fields = vec![
        ("start", Data::option(framing.start.map(hex8))),
        ("end", byte(framing.end?)),
        ("escape", Data::optional(framing.escape.map(escape))),
        ("check", Doc::from(format!("rt::framing::Check::{}", check(framing)?))),
        ("check_from", Doc::from(from.to_string())),
        ("is_check_escaped", Doc::from((framing.check_escaped).to_string())),
        ("max_data", Doc::from(max)),
    ];
    let title = "Framing of messages: delimiters, escape bytes and checksum.".to_owned();
    let described = docs::described(framing.documentation.as_deref(), &context.manual);
    let docs = docs::paragraphs([title].into_iter().chain(described));
    Some(Declaration::new(
        docs,
        "const FRAMING: rt::framing::Delimited",
        Data::fields("rt::framing::Delimited", fields),
    ))
}

fn check(framing: &Framing) -> Option<String> {
    let (byte, word) = (framing.check_seed & 0xFF, framing.check_seed & 0xFFFF);
    Some(match framing.check.as_str() {
        "" => "None".to_owned(),
        "xor" => format!("Xor({})", hex8(byte)),
        "sum" => format!("Sum({})", hex8(byte)),
        "lrc" => format!("Lrc({})", hex8(byte)),
        "crc16" => format!("Crc16({})", hex16(word)),
        _ => return None,
    })
}

/// Returns the byte offset of the first field that the checksum covers. The offset is taken from the first request in which
/// it is fixed. Returns `None` if there is no such request.
fn check_start(shaped: &[Shaped<'_>]) -> Option<u32> {
    shaped.iter().find_map(|shape| shape.request.byte_offset(shape.message.check_from?))
}

/// Returns the maximum length of message data in bytes. If the description does not state it, the result is calculated
/// from the messages.
pub(super) fn max_data(device: &Device, shaped: &[Shaped<'_>]) -> u32 {
    if let Some(max) = device.framing.as_ref().and_then(|framing| framing.max_data) {
        return max.into();
    }
    let sides = shaped.iter().flat_map(|shape| [&shape.request, &shape.reply]);
    let longest = |steps: &[Step<'_>]| steps.iter().map(longest).fold(0, u32::saturating_add);
    sides.map(|side| longest(&side.steps)).max().unwrap_or(UNBOUNDED_LENGTH)
}

fn longest(step: &Step<'_>) -> u32 {
    match (step.bits(), step) {
        (Some(bits), _) => bits.div_ceil(8),
        (None, Step::List { length, max: Some(max), .. }) => length.saturating_mul((*max).into()),
        (None, Step::Setting { .. } | Step::Blank { .. }) => 12,
        (None, Step::Settings { max: Some(max), .. }) => 12 * u32::from(*max),
        (None, _) => UNBOUNDED_LENGTH,
    }
}

/// Returns whether any request contains a station number.
pub(super) fn has_station(shaped: &[Shaped<'_>]) -> bool {
    let mut steps = shaped.iter().flat_map(|shape| &shape.request.steps);
    steps.any(|step| matches!(step, Step::Station { .. }))
}
