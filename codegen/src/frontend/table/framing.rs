//! Reads the delimiters and checksums of frames of a command protocol.

use super::at::At;
use super::format::FramingTable;
use super::messages::field_names;
use super::tree::Reader;
use crate::diagnostics::codes;
use crate::ir::{Device, Framing, Message};
use crate::number::hex8;

/// Words for the key `check`.
const CHECKS: [(&str, &str); 5] =
    [("xor", "xor"), ("sum", "sum"), ("lrc", "lrc"), ("crc8", "crc8"), ("crc16", "crc16")];

/// Reads the delimiters and the checksum of the frames of a protocol.
pub(super) fn read(reader: &mut Reader<'_, '_>, table: &At<FramingTable>, device: &mut Device) {
    bytes_of_framing(reader, table);
    let framing = &table.value;
    let origin = reader.origin(table);
    device.doubts.extend(reader.doubts_of(framing, origin));
    let check = framing.check.as_ref().and_then(|word| reader.word(word, "checksum", &CHECKS));
    device.framing = Some(Box::new(Framing {
        start: framing.start,
        end: framing.end,
        escape: framing.escape,
        escape_xor: framing.escape_xor,
        escaped: framing.escaped.clone(),
        check: check.unwrap_or_default().into(),
        check_from: framing.check_from.as_ref().map(|field| field.value.as_str().into()),
        check_escaped: framing.check_escaped.unwrap_or(framing.escape.is_some()),
        check_seed: framing.seed,
        max_data: framing.max_data,
        address: framing.address.as_ref().map(|field| field.value.as_str().into()),
        documentation: reader.documentation_of(framing),
        origin,
    }));
    for field in framing.check_from.iter().chain(&framing.address) {
        let first = |message: &Message| field_names(&message.request).any(|name| *name == field.value);
        if !device.messages.iter().any(first) {
            let names: Vec<_> = device.messages.iter().flat_map(|message| field_names(&message.request)).collect();
            reader.unresolved("field", &field.value, reader.span(field), names.iter().map(|name| name.as_str()));
        }
    }
}

/// Reports conflicts between the start byte, the end byte, the escape byte and the escaped bytes of the frames.
fn bytes_of_framing(reader: &mut Reader<'_, '_>, table: &At<FramingTable>) {
    let framing = &table.value;
    let special = [("start", framing.start), ("end", framing.end), ("escape", framing.escape)];
    let special: Vec<(&str, u8)> = special.into_iter().filter_map(|(name, byte)| Some((name, byte?))).collect();
    let mut problems = Vec::new();
    for (at, (name, byte)) in special.iter().enumerate() {
        // The start byte and the end byte may be the same byte, which then separates frames.
        let same =
            special[..at].iter().find(|(other, other_byte)| other_byte == byte && (*other, *name) != ("start", "end"));
        problems.extend(same.map(|(other, _)| format!("`{other}` and `{name}` are both {}", hex8(*byte))));
        if framing.escape.is_some() && !framing.escaped.contains(byte) {
            problems.push(format!("the `{name}` byte {} of frames is not escaped", hex8(*byte)));
        }
    }
    for byte in framing.escaped.iter().filter(|_| framing.escape.is_some()) {
        let sent = byte ^ framing.escape_xor;
        if special.iter().any(|(_, special_byte)| *special_byte == sent) {
            let (byte, sent) = (hex8(*byte), hex8(sent));
            problems.push(format!("{byte} is escaped as {sent}, which is itself a start, end or escape byte"));
        }
    }
    for message in problems {
        reader.report(&codes::FRAMING_BYTES, reader.span(table), message);
    }
}
