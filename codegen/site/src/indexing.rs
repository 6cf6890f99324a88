//! Entries of the search index for the elements of each kind of page.

use super::area::Area;
use super::codes::Codes;
use super::entry::Row;
use super::machines::Behavior;
use super::modules::ModuleModel;
use super::part_anchors;
use super::process::Frame;
use super::protocol::Protocol;
use super::search::{Entry, Index};

/// Returns an entry without names in other languages, unit and description.
pub(super) fn entry<'e>(anchor: &'e str, number: &'e str, name: &'e str) -> Entry<'e> {
    Entry { anchor, number, name, names: &[], unit: "", words: "" }
}

/// Adds the objects and items of a page.
pub(super) fn area(index: &mut Index, area: &Area) {
    for section in &area.sections {
        if let Some(anchor) = &section.anchor {
            index.entry(&Entry { names: &section.names, ..entry(anchor, &section.number, &section.name) });
        }
        rows(index, &section.rows);
    }
}

/// Adds items with their bits and values.
pub(super) fn rows(index: &mut Index, rows: &[Row]) {
    for row in rows {
        let words = row.description.as_str();
        for number in row.lookups() {
            let entry = self::entry(&row.anchor, number, &row.name);
            index.entry(&Entry { names: &row.names, unit: &row.unit, words, ..entry });
        }
        parts(index, row);
    }
}

/// Adds the bit fields, their named values, and the named values of a row. The numbers of these entries, such as `bit
/// 4`, are relative to the row, whose entry precedes them.
fn parts(index: &mut Index, row: &Row) {
    let mut part = |number: &str, anchor: &str, name: &str, names: &[(String, String)]| {
        let anchor = anchor.strip_prefix(&row.anchor).map_or(anchor, |part| part.trim_start_matches('.'));
        // If the anchor is empty, the script derives it from the number.
        let anchor = if anchor == part_anchors::of_number(number) { "" } else { anchor };
        if !name.is_empty() {
            index.entry(&Entry { names, ..entry(anchor, number, name) });
        }
    };
    for field in row.bits.iter().flat_map(|bits| &bits.fields) {
        part(&field.number(), &field.anchor, &field.name, &field.names);
        for value in &field.values {
            part(&field.number(), &value.anchor, &value.name, &value.names);
        }
    }
    for label in &row.labels {
        part(&label.number(), &label.anchor, &label.name, &label.names);
    }
}

/// Adds PDOs and process images.
pub(super) fn frames(index: &mut Index, frames: &[Frame]) {
    for frame in frames {
        index.entry(&entry(&frame.anchor, &frame.anchor, &frame.title));
    }
}

/// Adds messages.
pub(super) fn messages(index: &mut Index, protocol: &Protocol) {
    for message in &protocol.messages {
        let words = message.facts.first().map_or("", String::as_str);
        index.entry(&Entry { names: &message.names, words, ..entry(&message.anchor, "message", &message.name) });
    }
}

/// Adds states and procedures.
pub(super) fn behavior(index: &mut Index, behavior: &Behavior) {
    for state in behavior.machines.iter().flat_map(|machine| &machine.states) {
        let words = format!("{} {}", state.identifier, state.facts);
        index.entry(&Entry { names: &state.names, words: &words, ..entry(&state.anchor, "state", &state.name) });
    }
    for sequence in &behavior.sequences {
        // The anchor is the identifier of the procedure.
        let words = format!("{} {}", sequence.anchor, sequence.facts.first().map_or("", String::as_str));
        index.entry(&Entry { words: &words, ..entry(&sequence.anchor, "procedure", &sequence.name) });
    }
}

/// Adds codes.
pub(super) fn codes(index: &mut Index, tables: &[Codes]) {
    for (table, row) in tables.iter().flat_map(|table| table.rows.iter().map(move |row| (table, row))) {
        let words = format!("{} {} {}", table.title, row.cells.join(" "), row.facts);
        index.entry(&Entry { names: &row.names, words: &words, ..entry(&row.anchor, &row.number, &row.name) });
    }
}

/// Adds a module with its items.
pub(super) fn module(index: &mut Index, module: &ModuleModel) {
    let words = module.facts.first().map_or("", String::as_str);
    for number in module.lookups() {
        index.entry(&Entry { names: &module.names, words, ..entry(&module.anchor, number, &module.name) });
    }
    for (_, section) in &module.sections {
        rows(index, &section.rows);
    }
}
