//! Reads the Modbus frames that a manual prints.

use super::at::At;
use super::format::FrameTable;
use super::tree::Reader;
use crate::diagnostics::codes;
use crate::ir::{Device, MessageExample};

/// Adds to the device a Modbus request and reply that the manual prints. Reports a frame that has neither.
pub(super) fn frame(reader: &mut Reader<'_, '_>, table: &At<FrameTable>, device: &mut Device) {
    let frame = &table.value;
    if frame.request.value.is_empty() && frame.reply.value.is_empty() {
        reader.report(&codes::TABLE_VALUE, reader.span(table), "a frame needs a `request`, a `reply`, or both");
    }
    let origin = reader.origin(table);
    device.doubts.extend(reader.doubts_of(frame, origin));
    device.modbus_examples.push(MessageExample {
        request: frame.request.value.clone(),
        reply: frame.reply.value.clone(),
        documentation: reader.documentation_of(frame),
        request_at: reader.span(&frame.request),
        reply_at: reader.span(&frame.reply),
    });
}
