//! Frames of Modbus that a manual prints.

use super::at::At;
use super::format::FrameTable;
use super::tree::{cited, Reader};
use crate::diagnostics::codes;
use crate::ir::{Device, MessageExample};

/// Puts a request and its reply into the device.
pub(super) fn frame(reader: &mut Reader<'_, '_>, table: &At<FrameTable>, device: &mut Device) {
    let own = &table.value;
    if own.request.value.is_empty() && own.reply.value.is_empty() {
        reader.report(&codes::TABLE_VALUE, reader.span(table), "a frame has a `request`, a `reply`, or both");
    }
    let (origin, cite) = (reader.origin(table), own.cite.as_ref().map(cited));
    device.doubts.extend(reader.doubts([own.doubt.as_ref(), own.doubts.as_ref()], origin, cite.as_deref()));
    device.modbus_examples.push(MessageExample {
        request: own.request.value.clone(),
        reply: own.reply.value.clone(),
        documentation: reader.documentation(own.doc.as_deref(), cite),
        request_at: reader.span(&own.request),
        reply_at: reader.span(&own.reply),
    });
}
