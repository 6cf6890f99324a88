//! Codes with a meaning: alarms, emergency codes, abort codes.

use super::at::{At, Entries, Literal, TextOr};
use super::format::{CodeTableRow, CodesTable};
use super::tree::{cited, Reader};
use super::{place, value};
use crate::diagnostics::{codes, Diagnostic};
use crate::ir::{Availability, CodeRow, CodeTable, Device, Type, Value};
use crate::text::brief;

/// A table of codes.
pub(super) fn table(reader: &mut Reader<'_, '_>, name: &At<String>, table: &CodesTable, device: &mut Device) {
    let mut rows = Vec::with_capacity(table.rows.0.len());
    for (key, row) in table.rows.iter() {
        let Some((first, last)) = place::range(&key.value).filter(|(first, last)| first <= last) else {
            let message = format!("`{}` is no code: write `0x8110` or `\"0xFF13..0xFF15\"`", brief(&key.value));
            reader.report(&codes::TABLE_PLACE, reader.span(key), message);
            continue;
        };
        let plain = CodeTableRow::default();
        let (name, row) = match &row.value {
            TextOr::Text(name) => (Some(name.as_str()), &plain),
            TextOr::Table(row) => (row.name.as_deref(), &**row),
        };
        let (origin, cite) = (reader.origin(key), row.cite.as_ref().map(cited));
        device.doubts.extend(reader.doubts([row.doubt.as_ref(), row.doubts.as_ref()], origin, cite.as_deref()));
        let as_before = table.distinct.then(|| same_cells(&table.rows, key, row)).flatten();
        if let Some(other) = as_before {
            let message = format!("the codes {} and {} have the same cells", brief(&other.value), brief(&key.value));
            let found = Diagnostic::new(&codes::CELLS_TWICE, reader.span(key), message);
            reader.diagnostics.push(found.note_at(reader.span(other), "the first one"));
        }
        let cell = |literal: &Literal| value::convert(literal, Type::Opaque(None), false).unwrap_or(Value::Bool(false));
        rows.push(CodeRow {
            code: first,
            last: (last > first).then_some(last),
            name: name.unwrap_or_default().into(),
            names: reader.original(row.orig.as_deref()),
            availability: availability(row),
            documentation: reader.documentation(row.doc.as_deref(), cite),
            cells: row.cells.iter().map(cell).collect(),
        });
    }
    if let Some(list) = &table.buses {
        super::device::buses(reader, list);
    }
    device.code_tables.push(CodeTable {
        name: name.value.as_str().into(),
        columns: table.columns.iter().map(|column| column.as_str().into()).collect(),
        rows: rows.into(),
        buses: table.buses.iter().flatten().map(|bus| bus.value.as_str().into()).collect(),
        documentation: reader.documentation(table.doc.as_deref(), table.cite.as_ref().map(cited)),
        origin: reader.origin(name),
    });
}

/// The code in front of `key` that has the cells of `row`, where it has any.
fn same_cells<'t>(
    rows: &'t Entries<TextOr<CodeTableRow>>,
    key: &At<String>,
    row: &CodeTableRow,
) -> Option<&'t At<String>> {
    let before = rows.iter().take_while(|(other, _)| other.start < key.start);
    let mut same = before.filter(|(_, other)| match &other.value {
        TextOr::Table(other) => !row.cells.is_empty() && other.cells == row.cells,
        TextOr::Text(_) => false,
    });
    same.next().map(|(other, _)| other)
}

/// Models and firmware that have a code.
fn availability(row: &CodeTableRow) -> Option<Box<Availability>> {
    let own = Availability {
        models: row.models.iter().flatten().map(|model| model.value.as_str().into()).collect(),
        since: row.since.as_deref().map(Into::into),
        until: row.until.as_deref().map(Into::into),
        ..Availability::default()
    };
    (own != Availability::default()).then(|| Box::new(own))
}
