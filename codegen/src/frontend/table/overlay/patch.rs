//! Reads the rows and definitions of an overlay or profile.

use super::super::at::At;
use super::super::definitions::Definitions;
use super::super::format::{
    AxesTable, ChapterTable, CodesTable, DoubtTable, MachineTable, ManualTable, OverlayTable, ProcedureTable, Row,
};
use super::super::notation::{self, Objects};
use super::super::repeats::Repeats;
use super::super::rows::Rows;
use super::super::tree::Reader;
use super::super::Table;
use crate::diagnostics::codes;
use crate::ir::{Buses, CompactString};
use crate::text::brief;

/// Contents of an overlay or profile, except the head.
#[derive(Clone, Debug, Default)]
pub(super) struct Patch {
    pub(super) rows: Vec<PatchRow>,
    /// Definitions for which no types have been created yet.
    pub(super) definitions: Definitions,
    pub(super) axes: Option<At<AxesTable>>,
    pub(super) codes: Vec<(At<String>, CodesTable)>,
    pub(super) machines: Vec<(At<String>, MachineTable)>,
    pub(super) procedures: Vec<(At<String>, ProcedureTable)>,
    pub(super) doubts: Vec<At<DoubtTable>>,
    /// Language of the manual.
    pub(super) language: CompactString,
}

/// Row, and the objects or item to which it applies.
#[derive(Clone, Debug)]
pub(super) struct PatchRow {
    pub(super) key: At<String>,
    pub(super) row: At<Row>,
    pub(super) target: Target,
}

/// Objects or item to which a row applies.
#[derive(Clone, Copy, Debug)]
pub(super) enum Target {
    /// Objects, or sub-entries of objects.
    Objects(Objects),
    /// Item that the key of the row names.
    Name,
}

/// Keys that both overlays and profiles have, in addition to their head.
const KEYS: [&str; 9] = ["lexibus", "manual", "units", "enums", "bits", "chapters", "codes", "machines", "doubts"];

/// Keys that overlays have and profiles lack, in addition to [`KEYS`].
const OVERLAY_KEYS: [&str; 3] = ["overlay", "axes", "procedures"];

impl Patch {
    /// Reads an overlay or profile. `keys` are the keys that this kind of table has in addition to [`KEYS`].
    pub(super) fn read<'a>(reader: &mut Reader<'a, '_>, table: &mut Table<'a>, keys: &[&str]) -> Patch {
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
        // Errors in definitions are reported once, even if many rows use the definitions.
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

    /// Returns the state that is needed to add the facts of rows to items.
    pub(super) fn filler(&self) -> Rows {
        Rows::new(self.definitions.clone(), None)
    }
}

/// Returns the rows of all chapters, with the defaults of their chapters applied.
pub(super) fn rows<'a>(reader: &mut Reader<'a, '_>, table: &mut Table<'a>) -> Vec<PatchRow> {
    let mut rows = Vec::new();
    let mut repeats = Repeats::new(None);
    for node in table.nodes(reader, "chapters") {
        let Some((registers, objects, mut node)) = super::super::chapters::divide(reader, node) else { continue };
        super::super::defaults::of_chapter(reader, &mut node);
        let Some(chapter) = reader.piece::<ChapterTable>(node) else { continue };
        for (key, row) in registers.iter().chain(&objects) {
            super::super::misplaced::overlay(reader, key, row);
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
            match notation::objects(&key.value) {
                Some(objects) => rows.push(complete(reader, key, row, Target::Objects(objects))),
                None => {
                    let message = format!("`{}` is not an object address", brief(&key.value));
                    let help = notation::OBJECT_HELP;
                    reader.report_with_help(&codes::TABLE_PLACE, reader.span(&key), message, help);
                }
            }
        }
    }
    rows
}

/// Contents of an overlay.
pub(super) struct Overlay {
    pub(super) head: At<OverlayTable>,
    pub(super) patch: Patch,
}

impl Overlay {
    pub(super) fn read(reader: &mut Reader<'_, '_>) -> Option<Overlay> {
        let mut table = Table::new(reader, &[])?;
        let help = "pass a table with `[device]` as an input, not as an overlay";
        let head = table.required::<OverlayTable>(reader, "overlay", help)?;
        let patch = Patch::read(reader, &mut table, &OVERLAY_KEYS);
        if head.value.why.is_none() {
            for row in patch.rows.iter().filter(|row| row.row.value.why.is_none()) {
                let message = format!("the change of `{}` has no reason", brief(&row.key.value));
                let found = codes::TABLE_VALUE.at(reader.span(&row.key), message);
                reader.diagnostics.push(found.help("add `why` to the row, or to `[overlay]` for all rows"));
            }
        }
        Some(Overlay { head, patch })
    }
}
