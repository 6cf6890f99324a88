//! Frames of Modbus that a manual prints.

use super::at::At;
use super::format::FrameTable;
use super::tree::Reader;
use crate::diagnostics::codes;
use crate::ir::{Device, MessageExample};

/// Puts a request and its reply into the device.
pub(super) fn frame(reader: &mut Reader<'_, '_>, table: &At<FrameTable>, device: &mut Device) {
    let own = &table.value;
    if own.request.value.is_empty() && own.reply.value.is_empty() {
        reader.report(&codes::TABLE_VALUE, reader.span(table), "a frame has a `request`, a `reply`, or both");
    }
    let origin = reader.origin(table);
    device.doubts.extend(reader.doubts_of(own, origin));
    device.modbus_examples.push(MessageExample {
        request: own.request.value.clone(),
        reply: own.reply.value.clone(),
        documentation: reader.documentation_of(own),
        request_at: reader.span(&own.request),
        reply_at: reader.span(&own.reply),
    });
}
