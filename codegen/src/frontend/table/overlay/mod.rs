//! Overlays and profiles: tables that say something of objects which another file describes.
//!
//! | file | subject |
//! |---|---|
//! | `apply` | an overlay, and the devices and modules that it is for |
//! | `change` | a row of an overlay changes what is described, and its reason is kept |
//! | `profile` | a profile as plain data, in tests only: the compiler contains the result (`profiles`) |

mod apply;
mod change;
#[cfg(test)]
pub(crate) mod profile;

pub use apply::apply;

use super::at::At;
use super::definitions::Definitions;
use super::format::{
    AxesTable, ChapterTable, CodesTable, DoubtTable, MachineTable, ManualTable, OverlayTable, ProcedureTable, Row,
};
use super::place::{self, Objects};
use super::repeats::Repeats;
use super::rows::Rows;
use super::tree::Reader;
use super::Table;
use crate::diagnostics::{codes, Diagnostic};
use crate::ir::{Buses, CompactString};
use crate::source::Span;
use crate::text::brief;

/// What a table says of objects that another file describes.
#[derive(Clone, Debug, Default)]
struct Patch {
    rows: Vec<PatchRow>,
    /// Its definitions; no type is made of them yet.
    definitions: Definitions,
    axes: Option<At<AxesTable>>,
    codes: Vec<(At<String>, CodesTable)>,
    machines: Vec<(At<String>, MachineTable)>,
    procedures: Vec<(At<String>, ProcedureTable)>,
    doubts: Vec<At<DoubtTable>>,
    /// The manual's language.
    language: CompactString,
}

/// A row, and what it is about.
#[derive(Clone, Debug)]
struct PatchRow {
    key: At<String>,
    row: At<Row>,
    target: Target,
}

/// What a row is about.
#[derive(Clone, Copy, Debug)]
enum Target {
    /// Objects or their sub-entries.
    Objects(Objects),
    /// The item of this name.
    Name,
}

/// Keys that overlays and profiles have beside their head.
const KEYS: [&str; 9] = ["lexibus", "manual", "units", "enums", "bits", "chapters", "codes", "machines", "doubts"];

/// Those that only overlays have.
const OVERLAY_KEYS: [&str; 3] = ["overlay", "axes", "procedures"];

impl Patch {
    /// Reads a file that has `keys` in addition to those that all files have.
    fn read<'a>(reader: &mut Reader<'a, '_>, table: &mut Table<'a>, keys: &[&str]) -> Patch {
        let known: Vec<&str> = keys.iter().chain(&KEYS).copied().collect();
        for (key, node) in &mut table.parts {
            if node.is_some() && !known.contains(&key.value.as_str()) {
                reader.unknown_key(&key.value, &known, reader.span(key));
                *node = None;
            }
        }
        if let Some(manual) = table.take::<ManualTable>(reader, "manual") {
            reader.language = manual.value.language.as_deref().unwrap_or_default().into();
        }
        let definitions = table.rows(reader, Buses::ALL).definitions;
        // Mistakes in them are told once, whatever uses them.
        definitions.clone().make_unused(reader);
        Patch {
            definitions,
            rows: rows(reader, table),
            axes: table.take(reader, "axes"),
            codes: table.named(reader, "codes"),
            machines: table.named(reader, "machines"),
            procedures: table.named(reader, "procedures"),
            doubts: table.list(reader, "doubts"),
            language: reader.language.clone(),
        }
    }

    /// What rows need to be filled in.
    fn filler(&self) -> Rows {
        Rows {
            definitions: self.definitions.clone(),
            spaces: Vec::new(),
            modbus: Vec::new(),
            buses: Buses::ALL,
            defaults: None,
            references: Vec::new(),
            numbered: Vec::new(),
            allowed: Vec::new(),
            summaries: Vec::new(),
            repeats: Repeats::new(None),
        }
    }
}

/// The rows of all chapters, each with the defaults of its chapter.
fn rows<'a>(reader: &mut Reader<'a, '_>, table: &mut Table<'a>) -> Vec<PatchRow> {
    let mut rows = Vec::new();
    let mut repeats = Repeats::new(None);
    for node in table.nodes(reader, "chapters") {
        let Some((registers, objects, mut node)) = super::divide(reader, node) else { continue };
        super::defaults::of_chapter(reader, &mut node);
        let Some(chapter) = reader.piece::<ChapterTable>(node) else { continue };
        for (key, row) in registers.iter().chain(&objects) {
            super::misplaced::overlay(reader, key, row);
        }
        let defaults = chapter.defaults.as_ref().map(|defaults| &defaults.value);
        repeats.chapter(defaults);
        let mut complete = |reader: &mut Reader<'_, '_>, key: At<String>, row: At<Row>, target| {
            let defaults = defaults.filter(|_| repeats.inherit(reader, reader.span(&key)));
            let value = defaults.map_or(row.value.clone(), |defaults| row.value.or(defaults));
            PatchRow { key, row: At { value, start: row.start, end: row.end }, target }
        };
        rows.extend(registers.into_iter().map(|(key, row)| complete(reader, key, row, Target::Name)));
        for (key, row) in objects {
            match place::objects(&key.value) {
                Some(objects) => rows.push(complete(reader, key, row, Target::Objects(objects))),
                None => {
                    let message = format!(
                        "`{}` is no object: write `0x6040`, `\"0x1018:1\"` or `\"0x1400..0x1403:1\"`",
                        brief(&key.value)
                    );
                    reader.report(&codes::TABLE_PLACE, reader.span(&key), message);
                }
            }
        }
    }
    rows
}

/// An overlay as it was read.
struct Overlay {
    head: At<OverlayTable>,
    patch: Patch,
}

impl Overlay {
    fn read(reader: &mut Reader<'_, '_>) -> Option<Overlay> {
        let mut table = Table::new(reader, &[])?;
        let Some(head) = table.take::<OverlayTable>(reader, "overlay") else {
            let message = "the table has no `[overlay]`";
            let found = Diagnostic::new(&codes::TABLE_VALUE, Span::new(reader.file, 0, 0), message);
            reader.diagnostics.push(found.help("a table with `[device]` is an input of its own"));
            return None;
        };
        let patch = Patch::read(reader, &mut table, &OVERLAY_KEYS);
        if head.value.why.is_none() {
            for row in patch.rows.iter().filter(|row| row.row.value.why.is_none()) {
                let message = format!("nothing says why `{}` is changed", brief(&row.key.value));
                let found = Diagnostic::new(&codes::TABLE_VALUE, reader.span(&row.key), message);
                reader.diagnostics.push(found.help("give the row a `why`, or all of them one in `[overlay]`"));
            }
        }
        Some(Overlay { head, patch })
    }
}
