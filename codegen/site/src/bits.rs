//! Draws bit fields, with the most significant bit first. Each field has a cell, except reserved bits.

use std::collections::BTreeSet;

use super::cell::Cell;
use super::part_anchors::anchors;
use super::words;
use lexibus_codegen::facts::types;
use lexibus_codegen::ir::owner::Owner;
use lexibus_codegen::ir::{BitFieldEntry, BitMeaning, EnumValue, Shape, Trigger, Type, TypeDef};

/// Number of bits per row of a drawing.
const ROW: u32 = 16;

/// Width of the cell of one bit, in pixels.
const CELL: u32 = 40;

/// The bit grids that a page needs: the first bit and the number of bits of each drawing row.
pub(super) type Grids = BTreeSet<(u32, u32)>;

/// A bit field on a page: the drawing of its bits and the list of its fields.
#[derive(Debug)]
pub(super) struct Bits {
    /// Rows of the drawing. The row with the most significant bits comes first.
    pub rows: Vec<Row>,
    pub fields: Vec<Field>,
}

/// A row of a drawing.
#[derive(Debug)]
pub(super) struct Row {
    /// Number of the least significant bit in the row.
    pub first: u32,
    /// Number of bits in the row.
    pub bits: u32,
    /// Vertical offset from the top of the drawing, in pixels.
    pub top: u32,
    pub cells: Vec<Cell>,
}

/// A row of the bit list.
#[derive(Debug)]
pub(super) struct Field {
    pub anchor: String,
    /// Bit numbers, such as `7` or `3–0`.
    pub bits: String,
    pub name: String,
    pub names: Vec<(String, String)>,
    pub facts: String,
    pub values: Vec<Label>,
    pub is_reserved: bool,
    /// True if the field has this meaning only while a condition holds.
    pub is_conditional: bool,
    /// True if the flag is active low, that is, active while its bit is 0.
    pub is_inverted: bool,
}

/// A named value of an enumeration, as a page shows it.
#[derive(Debug)]
pub(super) struct Label {
    pub anchor: String,
    pub number: String,
    pub name: String,
    pub names: Vec<(String, String)>,
    pub facts: String,
    /// True if the value has this meaning only while a condition holds.
    pub is_conditional: bool,
}

impl Field {
    /// Returns the number that the search shows, such as `bit 4`.
    pub fn number(&self) -> String {
        format!("bit {}", self.bits)
    }
}

impl Label {
    /// Returns the number that the search shows, such as `value 3`.
    pub fn number(&self) -> String {
        format!("value {}", self.number)
    }
}

/// Returns the drawing of a type's bits and the list of its named values. The anchors of the bits and values begin with
/// `owner`, the anchor of the element with this type.
pub(super) fn of_type(types: &[TypeDef], ty: Type, owner: &str) -> (Option<Bits>, Vec<Label>) {
    match Owner::of_types(types).definition(ty).map(|definition| &definition.shape) {
        Some(Shape::BitField { base, fields }) => {
            let bits = types::basic(types, *base).bits().unwrap_or(8);
            (Some(drawing(types, fields, bits, owner)), Vec::new())
        }
        Some(Shape::Enumeration { values, .. }) => (None, labels(values, owner)),
        _ => (None, Vec::new()),
    }
}

/// Returns the bit grids that these drawings need. Each grid is drawn only once per page.
pub(super) fn grids<'b>(drawings: impl Iterator<Item = &'b Bits>) -> Grids {
    drawings.flat_map(|drawing| &drawing.rows).map(|row| (row.first, row.bits)).collect()
}

fn drawing(types: &[TypeDef], fields: &[BitFieldEntry], bits: u32, owner: &str) -> Bits {
    let bits = bits.clamp(1, 64);
    let mut rows = Vec::new();
    let mut last = bits;
    while last > 0 {
        let first = (last - 1) / ROW * ROW;
        let top = rows.len() as u32 * CELL;
        let cells = fields.iter().filter_map(|field| cell(field, first, last - first)).collect();
        rows.push(Row { first, bits: last - first, top, cells });
        last = first;
    }
    // Omit a drawing in which no cell has space for a name. The list contains the names of all fields.
    if rows.iter().flat_map(|row: &Row| &row.cells).all(|cell| cell.label.is_empty()) {
        rows.clear();
    }
    Bits { rows, fields: self::fields(types, fields, owner) }
}

/// Returns the fields of a bit field with their anchors and named values.
fn fields(types: &[TypeDef], entries: &[BitFieldEntry], owner: &str) -> Vec<Field> {
    let mut fields: Vec<Field> = entries.iter().map(field).collect();
    let parts = fields.iter().map(|field| (field.number(), field.name.as_str(), field.is_conditional));
    let anchors = anchors(owner, &parts.collect::<Vec<_>>());
    for ((field, entry), anchor) in fields.iter_mut().zip(entries).zip(anchors) {
        if let BitMeaning::Enumeration(id) = entry.meaning {
            let enumeration = Owner::of_types(types).enumeration(Type::Named(id));
            field.values = enumeration.map(|(values, _)| labels(values, &anchor)).unwrap_or_default();
        }
        field.anchor = anchor;
    }
    fields
}

/// Returns the cell of a field in the row of `bits` bits that starts at bit `first`. Reserved bits have no cell.
fn cell(field: &BitFieldEntry, first: u32, bits: u32) -> Option<Cell> {
    if matches!(field.meaning, BitMeaning::Reserved { .. }) {
        return None;
    }
    let low = u32::from(field.offset).max(first);
    let end = (u32::from(field.offset) + u32::from(field.bits)).min(first + bits);
    let width = end.checked_sub(low).filter(|width| *width > 0)? * CELL;
    let left = (first + bits - end) * CELL;
    Some(Cell::new(left, width, &field.name))
}

/// Returns the row of a field in the bit list, without anchor and named values.
fn field(entry: &BitFieldEntry) -> Field {
    let (first, last) = (u32::from(entry.offset), u32::from(entry.offset) + u32::from(entry.bits).max(1) - 1);
    let mut facts = Vec::new();
    match &entry.meaning {
        BitMeaning::Flag { inverted: true } => facts.push("Active while the bit is 0.".to_owned()),
        BitMeaning::Reserved { write: Some(bit) } => facts.push(format!("Reserved, {}.", u8::from(*bit))),
        BitMeaning::Reserved { write: None } => facts.push("Reserved.".to_owned()),
        _ => {}
    }
    facts.extend(entry.when.as_ref().map(|condition| format!("While {}.", words::PLAIN.holds(condition))));
    facts.extend(entry.trigger.map(|trigger| match trigger {
        Trigger::Rising => "Acts on a rising edge.".to_owned(),
        Trigger::Falling => "Acts on a falling edge.".to_owned(),
        Trigger::Toggle => "Acts on every change.".to_owned(),
        Trigger::SelfClearing => "The device clears the bit.".to_owned(),
    }));
    facts.extend(entry.access.map(|access| format!("Access: {}.", access.name())));
    facts.extend(words::PLAIN.description(entry.documentation.as_deref()));
    facts.extend(entry.availability.as_ref().map(|availability| words::PLAIN.availability(availability)));
    if facts.is_empty() && entry.bits > 1 && matches!(entry.meaning, BitMeaning::Number) {
        facts.push("A number.".to_owned());
    }
    Field {
        anchor: String::new(),
        bits: if first == last { first.to_string() } else { format!("{last}–{first}") },
        name: entry.name.to_string(),
        names: words::names(&entry.name, &entry.names),
        facts: facts.join(" "),
        values: Vec::new(),
        is_conditional: entry.when.is_some(),
        is_reserved: matches!(entry.meaning, BitMeaning::Reserved { .. }),
        is_inverted: matches!(entry.meaning, BitMeaning::Flag { inverted: true }),
    }
}

fn labels(values: &[EnumValue], owner: &str) -> Vec<Label> {
    let label = |value: &EnumValue| {
        let mut facts = Vec::new();
        facts.extend(value.when.as_ref().map(|condition| format!("While {}.", words::PLAIN.holds(condition))));
        facts.extend(words::PLAIN.description(value.documentation.as_deref()));
        facts.extend(value.availability.as_ref().map(|availability| words::PLAIN.availability(availability)));
        Label {
            anchor: String::new(),
            number: types::numbers(value.value, value.last),
            name: value.name.to_string(),
            names: words::names(&value.name, &value.names),
            facts: facts.join(" "),
            is_conditional: value.when.is_some(),
        }
    };
    let mut labels: Vec<Label> = values.iter().map(label).collect();
    let parts = labels.iter().map(|label| (label.number(), label.name.as_str(), label.is_conditional));
    let anchors = anchors(owner, &parts.collect::<Vec<_>>());
    labels.iter_mut().zip(anchors).for_each(|(label, anchor)| label.anchor = anchor);
    labels
}
