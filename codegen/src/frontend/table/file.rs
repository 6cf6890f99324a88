//! Reads a register table, one top-level key at a time.

use super::at::At;
use super::by_name::ByName;
use super::definitions::Definitions;
use super::format::{DeviceTable, OptionTable};
use super::in_use::InUse;
use super::machine_budget::MachineBudget;
use super::objects::Dictionary;
use super::read::Read;
use super::rows::Rows;
use super::tree::{Node, Reader};
use super::{
    at, chapters, code_tables, composites, defaults, device, ethercat, format, frames, given, images, machines,
    numbered, process, references, spaces, summary, tree,
};
use crate::diagnostics::{codes, Diagnostics};
use crate::ir::{Buses, Catalog, Device};
use crate::source::{FileId, Source, Span};

/// JSON Schema (draft 7) of register tables, which editors use to complete and check tables. `lexibus schema` prints this schema.
pub const SCHEMA: &str = include_str!("../../../schema/table.json");

/// Supported version of the format.
const VERSION: u32 = 1;

/// Top-level keys of a table, overlay or profile.
const KEYS: [&str; 26] = [
    "lexibus",
    "device",
    "overlay",
    "profile",
    "manual",
    "models",
    "ethercat",
    "options",
    "defaults",
    "spaces",
    "units",
    "given",
    "enums",
    "bits",
    "chapters",
    "axes",
    "pdos",
    "images",
    "codes",
    "machines",
    "procedures",
    "composites",
    "framing",
    "messages",
    "frames",
    "doubts",
];

/// Reads the device that a table describes. `chosen` contains the choices for the options of the table.
///
/// Returns `None` and reports an error if `source` is not valid TOML or has no `[device]`.
pub fn read(
    source: &Source,
    file: FileId,
    chosen: &[(String, String)],
    diagnostics: &mut Diagnostics,
) -> Option<Catalog> {
    let mut reader = Reader::new(source, file, diagnostics);
    let mut table = Table::new(&mut reader, chosen)?;
    let help = "pass an overlay with `--overlay`, next to the description that it changes";
    let help = if table.has("overlay") { help } else { "describe the device: `[device]`, with `name` and `vendor`" };
    let head = table.required::<DeviceTable>(&mut reader, "device", help)?;
    let mut device = Device::default();
    if let Some(manual) = table.take(&mut reader, "manual") {
        device.manual = Some(device::manual(&mut reader, &manual));
    }
    let buses = device::head(&mut reader, &head, &mut device);
    for model in table.list(&mut reader, "models") {
        device::model(&mut reader, &model, &mut device);
    }
    if let Some(settings) = table.take(&mut reader, "ethercat") {
        ethercat::settings(&mut reader, &settings, buses, &mut device);
    }
    let mut rows = table.rows(&mut reader, buses);
    device.modbus = std::mem::take(&mut rows.modbus);
    let mut dictionary = Dictionary::new();
    let mut in_use = InUse::default();
    for chapter in table.nodes(&mut reader, "chapters") {
        device.groups.extend(chapters::chapter(&mut reader, &mut rows, &mut dictionary, &mut in_use, chapter));
    }
    summary::objects(&mut reader, &rows.definitions, &rows.summaries, &dictionary);
    for item in dictionary.values().flat_map(|group| &group.items) {
        in_use.addresses(&mut reader, item);
    }
    device.groups.extend(dictionary.into_values());
    for (name, given) in table.named::<format::GivenTable>(&mut reader, "given") {
        device.given.push(given::number(&mut reader, &name, &given));
    }
    // Fields of images and messages have types, so they are read before the types are moved from `rows` to the device.
    table.frames(&mut reader, &mut rows, &mut device);
    rows.definitions.make_unused(&mut reader);
    device.types = std::mem::take(&mut rows.definitions.types);
    device.types.shrink_to_fit();
    table.rest(&mut reader, &mut rows, &mut device);
    resolve(&mut reader, &rows, &device);
    numbered::mentioned(&mut reader, &rows.numbered, &device);
    rows.allow_of_definitions(&mut reader);
    reader.diagnostics.allow(rows.allowed);
    Some(Catalog { devices: vec![device], ..Catalog::default() })
}

/// Values of a file by top-level key, and the options and spaces of the file.
pub(super) struct Table<'a> {
    pub(super) parts: Vec<(At<String>, Option<Node<'a>>)>,
    pub(super) options: Vec<(At<String>, OptionTable)>,
    pub(super) spaces: Vec<(At<String>, format::SpaceTable)>,
}

impl<'a> Table<'a> {
    /// Parses a file, and replaces each text `$name` with the value of the chosen or default choice of the option `name`.
    pub(super) fn new(reader: &mut Reader<'a, '_>, chosen: &[(String, String)]) -> Option<Self> {
        let mut parts: Vec<_> = tree::entries(reader.parse()?).map(|(key, node)| (key, Some(node))).collect();
        for (key, node) in &mut parts {
            if !KEYS.contains(&key.value.as_str()) {
                reader.unknown_key(&key.value, &KEYS, reader.span(key));
                *node = None;
            }
        }
        let mut table = Table { parts, options: Vec::new(), spaces: Vec::new() };
        table.version(reader);
        let mut options = Vec::new();
        for (name, node) in table.entries(reader, "options") {
            options.extend(reader.piece::<OptionTable>(node.clone()).map(|option| (name, option, node)));
        }
        let values = tree::choices(reader, &options, chosen);
        let names: Vec<String> = options.iter().map(|(name, ..)| name.value.clone()).collect();
        for node in table.parts.iter_mut().filter_map(|(_, node)| node.as_mut()) {
            tree::choose(node, &values);
            tree::undecided(reader, node, &names);
        }
        table.options = options.into_iter().map(|(name, option, _)| (name, option)).collect();
        Some(table)
    }

    fn version(&mut self, reader: &mut Reader<'a, '_>) {
        match self.take::<u32>(reader, "lexibus") {
            Some(version) if version.value == VERSION => {}
            Some(version) => {
                let message =
                    format!("version {} of the format is not supported, only version {VERSION}", version.value);
                reader.report(&codes::TABLE_VALUE, reader.span(&version), message);
            }
            // A value that is no version number is already reported.
            None if self.has("lexibus") => {}
            None => {
                let message = "the version of the format is missing";
                let help = "begin the file with `lexibus = 1`";
                reader.report_with_help(&codes::TABLE_VALUE, Span::new(reader.file, 0, 0), message, help);
            }
        }
    }

    pub(super) fn node(&mut self, key: &str) -> Option<Node<'a>> {
        self.parts.iter_mut().find(|(name, _)| name.value == key)?.1.take()
    }

    /// Reads the value of the top-level key `key`.
    pub(super) fn take<T: Read>(&mut self, reader: &mut Reader<'a, '_>, key: &str) -> Option<At<T>> {
        let node = self.node(key)?;
        reader.piece_at(node)
    }

    /// Reads the table `[key]`. Reports an error if the file does not have the table.
    pub(super) fn required<T: Read>(&mut self, reader: &mut Reader<'a, '_>, key: &str, help: &str) -> Option<At<T>> {
        if !self.has(key) {
            let message = format!("the table has no `[{key}]`");
            reader.report_with_help(&codes::TABLE_VALUE, Span::new(reader.file, 0, 0), message, help);
        }
        self.take(reader, key)
    }

    fn has(&self, key: &str) -> bool {
        self.parts.iter().any(|(name, _)| name.value == key)
    }

    /// Returns the elements of the array of tables below the key `key`.
    pub(super) fn nodes(&mut self, reader: &mut Reader<'a, '_>, key: &str) -> Vec<Node<'a>> {
        self.node(key).map(|node| reader.elements(node, key)).unwrap_or_default()
    }

    /// Reads the elements of the array of tables below the key `key`.
    pub(super) fn list<T: Read>(&mut self, reader: &mut Reader<'a, '_>, key: &str) -> Vec<At<T>> {
        let nodes = self.nodes(reader, key);
        nodes.into_iter().filter_map(|node| reader.piece_at(node)).collect()
    }

    /// Returns the tables below the key `key`, with their names.
    pub(super) fn entries(&mut self, reader: &mut Reader<'a, '_>, key: &str) -> Vec<(At<String>, Node<'a>)> {
        self.node(key).map(|node| reader.entries(node, key)).unwrap_or_default()
    }

    /// Reads the tables below the key `key`, with their names.
    pub(super) fn named<T: Read>(&mut self, reader: &mut Reader<'a, '_>, key: &str) -> Vec<(At<String>, T)> {
        let entries = self.entries(reader, key);
        entries.into_iter().filter_map(|(name, node)| Some((name, reader.piece(node)?))).collect()
    }

    /// Reads the state that rows need: definitions, spaces and the table `[defaults]`.
    pub(super) fn rows(&mut self, reader: &mut Reader<'a, '_>, buses: Buses) -> Rows {
        let definitions = Definitions {
            units: ByName::new(self.named(reader, "units")),
            enums: ByName::new(self.named(reader, "enums")),
            bits: ByName::new(self.named(reader, "bits")),
            ..Definitions::default()
        };
        self.spaces = self.named(reader, "spaces");
        let defaults = self.node("defaults").and_then(|node| defaults::read(reader, node));
        Rows {
            spaces: spaces::read(reader, &self.spaces),
            modbus: spaces::modbus_tables(reader, &self.spaces),
            buses,
            ..Rows::new(definitions, defaults)
        }
    }

    /// Reads process images, messages, and the Modbus frames that the manual prints.
    fn frames(&mut self, reader: &mut Reader<'a, '_>, rows: &mut Rows, device: &mut Device) {
        let mut images = images::Images::new(device);
        for image in self.list(reader, "images") {
            images::image(reader, rows, &image, &mut images, device);
        }
        images.finish(device);
        #[cfg(feature = "messages")]
        super::messages::read(reader, self, rows, device);
        #[cfg(not(feature = "messages"))]
        for key in ["messages", "framing"] {
            if self.node(key).is_some() {
                let found = crate::frontend::without_feature("messages", "command protocols", reader.file);
                reader.diagnostics.push(found);
            }
        }
        for frame in self.list::<format::FrameTable>(reader, "frames") {
            let end = frame.value.request.end.max(frame.value.reply.end).max(frame.end);
            rows.allow_at(reader, (frame.start, end), &frame.value.allow);
            frames::frame(reader, &frame, device);
        }
    }

    /// Reads the elements that describe no items: axes, PDOs, codes, state machines, procedures, composites and
    /// ambiguities.
    fn rest(&mut self, reader: &mut Reader<'a, '_>, rows: &mut Rows, device: &mut Device) {
        if let Some(axes) = self.take::<format::AxesTable>(reader, "axes") {
            let models = axes.value.models.iter().flatten();
            reader.mention(models, "model");
            device::axes(reader, &axes, device);
        }
        let mut pdos = Vec::new();
        let targets = process::Targets::new(device);
        for pdo in self.list::<format::PdoTable>(reader, "pdos") {
            let end = pdo.value.entries.iter().map(|entry| entry.end).fold(pdo.end, u32::max);
            rows.allow_at(reader, (pdo.start, end), &pdo.value.allow);
            pdos.extend(process::pdo(reader, &pdo, &targets));
        }
        device.process_data.pdos.extend(pdos);
        for (name, table) in self.named::<format::CodesTable>(reader, "codes") {
            let models = table.rows.iter().filter_map(|(_, row)| match &row.value {
                at::TextOr::Table(row) => row.models.as_ref(),
                at::TextOr::Text(_) => None,
            });
            reader.mention(models.flatten(), "model");
            let end = table.rows.iter().map(|(_, row)| row.end).fold(name.end, u32::max);
            rows.allow_at(reader, (name.start, end), &table.allow);
            code_tables::table(reader, &name, &table, device);
        }
        self.sequences(reader, rows, device);
        for (name, option) in &self.options {
            device.doubts.extend(reader.doubts_of_part(option, name));
        }
        for doubt in self.list::<format::DoubtTable>(reader, "doubts") {
            let origin = reader.origin(&doubt);
            device.doubts.push(reader.doubt(&doubt.value, origin, None));
        }
    }

    /// Reads state machines, procedures and composites.
    fn sequences(&mut self, reader: &mut Reader<'a, '_>, rows: &mut Rows, device: &mut Device) {
        let mut budget = MachineBudget::new();
        for (name, table) in self.named(reader, "machines") {
            if !machines::machine(reader, &name, &table, device, &mut budget) {
                break;
            }
        }
        for (name, table) in self.named::<format::ProcedureTable>(reader, "procedures") {
            let end = table.steps.iter().map(|step| step.end).fold(name.end, u32::max);
            rows.allow_at(reader, (name.start, end), &table.allow);
            machines::procedure(reader, &name, &table, device);
        }
        for (name, table) in self.named(reader, "composites") {
            composites::composite(reader, &name, &table, device);
        }
    }
}

/// Reports names that do not refer to an element of the device, and ambiguous item names.
pub(super) fn resolve(reader: &mut Reader<'_, '_>, rows: &Rows, device: &Device) {
    let all = std::mem::take(&mut reader.references);
    references::resolve(reader, &all, device, &rows.numbered);
}
