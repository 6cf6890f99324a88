//! Reads tables of codes, such as alarms, emergency codes and abort codes.

use super::at::{At, Literal, TextOr};
use super::format::{CodeTableRow, CodesTable};
use super::tree::Reader;
use super::{buses, notation, value};
use crate::collections::HashMap;
use crate::diagnostics::codes;
use crate::ir::{Availability, CodeRow, CodeTable, CompactString, Device, Doubts, Type, Value};
use crate::text::brief;

/// Reads a table of codes.
pub(super) fn table(reader: &mut Reader<'_, '_>, name: &At<String>, table: &CodesTable, device: &mut Device) {
    let mut doubts = Doubts::new();
    let mut rows = Vec::with_capacity(table.rows.0.len());
    let plain = CodeTableRow::default();
    let mut distinct = table.distinct.then(Distinct::default);
    for (key, row) in table.rows.iter() {
        let Some((first, last)) = notation::range(&key.value).filter(|(first, last)| first <= last) else {
            let message = format!("`{}` is not a code", brief(&key.value));
            let help = "write a code such as `0x8110`, or a range such as `\"0xFF13..0xFF15\"`";
            reader.report_with_help(&codes::TABLE_PLACE, reader.span(key), message, help);
            continue;
        };
        let (name, row) = match &row.value {
            TextOr::Text(name) => (Some(name.as_str()), &plain),
            TextOr::Table(row) => (row.name.as_deref(), &**row),
        };
        doubts.extend(reader.doubts_of_part(row, key));
        let same_cells = distinct.as_mut().and_then(|distinct| distinct.before(key, row));
        if let Some(other) = same_cells {
            let (first, second) = (brief(&other.value), brief(&key.value));
            let message = format!("the codes {first} and {second} have the same cells in the code table");
            let found = codes::CELLS_TWICE.at(reader.span(key), message);
            reader.diagnostics.push(found.note_at(reader.span(other), "the first of the two codes"));
        }
        let cell = |literal: &At<Literal>| {
            value::convert(&literal.value, Type::Opaque(None), false).unwrap_or(Value::Bool(false))
        };
        rows.push(CodeRow {
            printed: printed(&key.value, table.prefix.as_deref().unwrap_or_default()),
            printed_cells: printed_cells(reader, &row.cells),
            code: first,
            last: (last > first).then_some(last),
            name: name.unwrap_or_default().into(),
            names: reader.original(row.orig.as_deref()),
            availability: availability(row),
            documentation: reader.documentation_of(row),
            cells: row.cells.iter().map(cell).collect(),
            stated_by: None,
        });
    }
    device.code_tables.push(CodeTable {
        name: name.value.as_str().into(),
        columns: table.columns.iter().map(|column| column.as_str().into()).collect(),
        rows: rows.into(),
        buses: table.buses.as_ref().map(|list| buses::read(reader, list)).unwrap_or_default(),
        documentation: reader.documentation_of(table),
        doubts,
        stated_by: None,
        origin: reader.origin(name),
    });
}

/// Returns a code as the table writes it, such as `0x8700`, or `F125` with the prefix `F`. Returns an empty text for a decimal
/// number without a prefix.
fn printed(key: &str, prefix: &str) -> CompactString {
    let is_decimal = key.chars().all(|letter| letter.is_ascii_digit() || letter == '-');
    match prefix {
        "" if is_decimal => CompactString::default(),
        prefix => {
            let bounds: Vec<String> = key.split("..").map(|bound| format!("{prefix}{}", bound.trim())).collect();
            bounds.join(" to ").into()
        }
    }
}

/// Returns the texts of the hexadecimal cells in a row, and empty texts for its other cells. Returns an empty list if no cell is
/// hexadecimal.
fn printed_cells(reader: &Reader<'_, '_>, cells: &[At<Literal>]) -> Vec<CompactString> {
    let is_pattern = |cell: &At<Literal>| matches!(cell.value, Literal::Int(_)) && reader.is_pattern(cell);
    if !cells.iter().any(is_pattern) {
        return Vec::new();
    }
    let text = |cell: &At<Literal>| match is_pattern(cell) {
        true => CompactString::from(reader.source.slice(reader.span(cell)).replace('_', "")),
        false => CompactString::default(),
    };
    cells.iter().map(text).collect()
}

/// First code with each combination of cells.
#[derive(Default)]
struct Distinct<'t>(HashMap<Vec<Cell<'t>>, &'t At<String>>);

impl<'t> Distinct<'t> {
    /// Returns an earlier code with the same cells as `row`, or `None` if there is no such code. A row without cells,
    /// or with a NaN cell, equals no other row.
    fn before(&mut self, key: &'t At<String>, row: &'t CodeTableRow) -> Option<&'t At<String>> {
        let cells = row.cells.iter().map(|literal| Cell::of(&literal.value)).collect::<Option<Vec<_>>>();
        let cells = cells.filter(|cells| !cells.is_empty())?;
        let first = *self.0.entry(cells).or_insert(key);
        (first.start != key.start).then_some(first)
    }
}

/// Literal as a key of a hash map.
#[derive(PartialEq, Eq, Hash)]
enum Cell<'t> {
    Bool(bool),
    Int(i128),
    Real(u64),
    Text(&'t str),
}

impl<'t> Cell<'t> {
    /// Returns the map key for a literal, or `None` for NaN, which equals no value.
    fn of(literal: &'t Literal) -> Option<Self> {
        Some(match literal {
            Literal::Bool(value) => Cell::Bool(*value),
            Literal::Int(value) => Cell::Int(*value),
            Literal::Real(value) if value.is_nan() => return None,
            // Negative zero equals positive zero, so both need the same map key.
            Literal::Real(value) => Cell::Real((value + 0.0).to_bits()),
            Literal::Text(text) => Cell::Text(text),
        })
    }
}

/// Returns the models and firmware versions that have a code, or `None` if the row states neither.
fn availability(row: &CodeTableRow) -> Option<Box<Availability>> {
    let availability = Availability {
        models: row.models.iter().flatten().map(|model| model.value.as_str().into()).collect(),
        since: row.since.as_deref().map(Into::into),
        until: row.until.as_deref().map(Into::into),
        ..Availability::default()
    };
    (availability != Availability::default()).then(|| Box::new(availability))
}
