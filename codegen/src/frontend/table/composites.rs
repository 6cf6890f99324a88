//! Reads numbers that are split over several items.

use super::at::At;
use super::format::CompositeTable;
use super::references::ITEM;
use super::tree::Reader;
use crate::diagnostics::codes;
use crate::ir::{Composite, Device};

/// Reads a number that is split over several items.
pub(super) fn composite(reader: &mut Reader<'_, '_>, name: &At<String>, table: &CompositeTable, device: &mut Device) {
    let origin = reader.origin(name);
    let doubts = reader.doubts_of(table, origin);
    reader.mention(table.parts.iter().chain(&table.sign), ITEM);
    let message = match (table.parts.len(), table.base, table.sign.is_some(), table.negative.is_some()) {
        (0..=1, ..) => "`parts` needs at least two items, the most significant one first",
        (_, None | Some(0..=1), ..) => "`base`, the ratio of a part to the next one, must be at least 2",
        (_, _, true, false) => "`negative`, the value of `sign` for negative numbers, is missing",
        (_, _, false, true) => "the composite has `negative`, but no `sign`",
        _ => "",
    };
    if !message.is_empty() {
        reader.report(&codes::TABLE_VALUE, reader.span(name), message);
        return;
    }
    let sign = table.sign.as_ref().zip(table.negative);
    device.composites.push(Composite {
        name: name.value.as_str().into(),
        names: reader.original(table.orig.as_deref()),
        parts: table.parts.iter().map(|part| reader.reference(part)).collect(),
        base: table.base.unwrap_or_default(),
        sign: sign.map(|(item, value)| (reader.reference(item), value)),
        unit: table.unit.as_deref().unwrap_or_default().into(),
        documentation: reader.documentation_of(table),
        doubts,
        origin,
    });
}
