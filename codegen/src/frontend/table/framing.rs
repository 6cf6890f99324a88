//! How frames of a command protocol are delimited and checked.

use super::at::At;
use super::format::FramingTable;
use super::messages::field_names;
use super::tree::Reader;
use crate::diagnostics::codes;
use crate::ir::{Device, Framing, Message};

/// The words of `check`.
const CHECKS: [(&str, &str); 5] =
    [("xor", "xor"), ("sum", "sum"), ("lrc", "lrc"), ("crc8", "crc8"), ("crc16", "crc16")];

/// How frames are delimited and checked.
pub(super) fn read(reader: &mut Reader<'_, '_>, table: &At<FramingTable>, device: &mut Device) {
    bytes_of_framing(reader, table);
    let own = &table.value;
    let origin = reader.origin(table);
    device.doubts.extend(reader.doubts_of(own, origin));
    device.framing = Some(Box::new(Framing {
        start: own.start,
        end: own.end,
        escape: own.escape,
        escape_xor: own.escape_xor,
        escaped: own.escaped.clone(),
        check: own.check.as_ref().and_then(|word| reader.word(word, "check", &CHECKS)).unwrap_or_default().into(),
        check_from: own.check_from.as_ref().map(|field| field.value.as_str().into()),
        check_escaped: own.check_escaped.unwrap_or(own.escape.is_some()),
        check_seed: own.seed,
        max_data: own.max_data,
        address: own.address.as_ref().map(|field| field.value.as_str().into()),
        documentation: reader.documentation_of(own),
        origin,
    }));
    for field in own.check_from.iter().chain(&own.address) {
        let first = |message: &Message| field_names(&message.request).any(|name| *name == field.value);
        if !device.messages.iter().any(first) {
            let names: Vec<_> = device.messages.iter().flat_map(|message| field_names(&message.request)).collect();
            reader.unresolved("field", &field.value, reader.span(field), names.iter().map(|name| name.as_str()));
        }
    }
}

/// Holds the bytes of the framing against each other.
fn bytes_of_framing(reader: &mut Reader<'_, '_>, table: &At<FramingTable>) {
    let own = &table.value;
    let special = [("start", own.start), ("end", own.end), ("escape", own.escape)];
    let special: Vec<(&str, u8)> = special.into_iter().filter_map(|(name, byte)| Some((name, byte?))).collect();
    let mut problems = Vec::new();
    for (at, (name, byte)) in special.iter().enumerate() {
        // Start and end may be one byte, which stands between frames.
        let same = special[..at].iter().find(|(other, own)| own == byte && (*other, *name) != ("start", "end"));
        problems.extend(same.map(|(other, _)| format!("`{other}` and `{name}` are both 0x{byte:02X}")));
        if own.escape.is_some() && !own.escaped.contains(byte) {
            problems.push(format!("0x{byte:02X} is the `{name}` of frames, and isn't escaped"));
        }
    }
    for byte in own.escaped.iter().filter(|_| own.escape.is_some()) {
        let sent = byte ^ own.escape_xor;
        if special.iter().any(|(_, own)| *own == sent) {
            problems.push(format!("0x{byte:02X} is sent as 0x{sent:02X}, which is special itself"));
        }
    }
    for message in problems {
        reader.report(&codes::FRAMING_BYTES, reader.span(table), message);
    }
}
