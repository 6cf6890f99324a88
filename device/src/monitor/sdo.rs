//! Events of SDO messages on the default channels (CiA 301 7.2.4.3).

use lexibus::clients::canopen::CanFrame;
use lexibus::{AbortCode, Object};

use super::event::{Event, EventKind, Named};
use super::interpreter::Interpreter;

/// COB-IDs of SDO replies and SDO requests without the node-ID.
const REPLIES: u32 = 0x580;
const REQUESTS: u32 = 0x600;
/// Command specifier of an abort.
const ABORT: u8 = 4;

/// Returns the event of an SDO message, or `None` if the frame is no SDO message on a default channel.
pub(super) fn event(interpreter: &mut Interpreter<'_>, frame: &CanFrame) -> Option<Event> {
    let of = |first: u32| frame.id().checked_sub(first).filter(|node| (1..=0x7F).contains(node)).map(|node| node as u8);
    let (node, is_request) = of(REPLIES).map(|node| (node, false)).or_else(|| of(REQUESTS).map(|node| (node, true)))?;
    let bytes: [u8; 8] = frame.data().try_into().ok()?;
    if interpreter.blocks.is_segment(node, is_request, &bytes) {
        return Some(Event::new(Some(node), EventKind::Sdo, "SDO block segment"));
    }
    let [command, low, high, sub_index, data @ ..] = bytes;
    let object = Object::new(u16::from_le_bytes([low, high]), sub_index);
    let (text, value) = match (command >> 5, is_request) {
        (ABORT, _) => ("SDO abort".to_owned(), None),
        (1, true) => ("SDO download".to_owned(), expedited(command, &data)),
        (2, true) => ("SDO upload".to_owned(), None),
        (2, false) => ("SDO upload reply".to_owned(), expedited(command, &data)),
        (3, false) => ("SDO download reply".to_owned(), None),
        (5 | 6, _) => match block(command, is_request) {
            (text, true) => (text.to_owned(), None),
            (text, false) => return Some(Event::new(Some(node), EventKind::Sdo, text)),
        },
        _ => return Some(Event::new(Some(node), EventKind::Sdo, "SDO segment")),
    };
    let parameter = interpreter.description(node).and_then(|found| found.object(object.index, object.sub_index));
    let shown = match (&parameter, value) {
        (_, None) => String::new(),
        (Some(parameter), Some(bytes)) => match parameter.decode(bytes) {
            Some(value) => parameter.text(&value),
            None => lexibus_codegen::number::bytes(bytes),
        },
        (None, Some(bytes)) => lexibus_codegen::number::bytes(bytes),
    };
    let name = parameter.map_or_else(String::new, |parameter| format!(" {}", parameter.path()));
    let (text, values) = match shown.as_str() {
        "" if command >> 5 == ABORT => {
            (format!("SDO abort of {object}{name}: {}", AbortCode(u32::from_le_bytes(data))), Vec::new())
        }
        "" => (format!("{text} of {object}{name}"), Vec::new()),
        value => {
            let named = Named { address: object.to_string(), name: format!("{object}{name}"), value: value.to_owned() };
            (text, vec![named])
        }
    };
    Some(Event { values, ..Event::new(Some(node), EventKind::Sdo, text) })
}

/// Returns the text of a message of a block transfer, and whether the message contains an object.
fn block(command: u8, is_request: bool) -> (&'static str, bool) {
    match (command >> 5, command & 3, is_request) {
        (5, 0, true) => ("SDO block upload", true),
        (5, 0, false) => ("SDO block download reply", true),
        (5, 1, _) => ("SDO block end reply", false),
        (5, 2, _) => ("SDO block acknowledgement", false),
        (5, _, _) => ("SDO block start", false),
        (_, 1 | 3, _) => ("SDO block end", false),
        (_, _, true) => ("SDO block download", true),
        (_, _, false) => ("SDO block upload reply", true),
    }
}

/// Returns the data of an expedited transfer, or `None` if the value follows in segments.
fn expedited(command: u8, data: &[u8; 4]) -> Option<&[u8]> {
    const EXPEDITED: u8 = 2;
    const WITH_SIZE: u8 = 1;
    let unused = if command & WITH_SIZE != 0 { usize::from(command >> 2 & 3) } else { 0 };
    (command & EXPEDITED != 0).then(|| data.get(..4 - unused))?
}
