//! Reads register tables (`*.toml`). `dictionaries/README.md` describes the format.
//!
//! | file | subject |
//! |---|---|
//! | `format`, `at`, `alternatives`, `read` | the tables of the format, their common types, and the readers of both |
//! | `tree` | parses the file into these tables, and reports errors with their spans; options |
//! | `notation`, `types`, `value`, `units`, `words` | numbers, ranges and addresses as text; type names; literals; unit symbols; words for access rights and other facts |
//! | `definitions`, `given` | units, enumerations, bit fields; machine constants |
//! | `scale` | conversion of raw values to physical values |
//! | `conditions`, `variants` | conditions for elements; differences between models or buses |
//! | `references`, `numbered` | names that refer to other elements, and register numbers in place of names |
//! | `repeats`, `machine_budget` | limits on the items that rows produce, and on the size of state machines |
//! | `in_use` | names and addresses that are in use |
//! | `buses`, `spaces`, `windows` | sets of buses; the addresses of a register on each bus |
//! | `rows`, `bindings`, `limits`, `registers`, `objects` | items and objects of rows; their addresses; default values, limits and allowed values |
//! | `defaults`, `misplaced` | keys that rows inherit; keys that have no effect in their row |
//! | `device` | the head: device, models, axes |
//! | `process`, `images` | process data: PDOs, fixed process images |
//! | `code_tables`, `machines`, `states`, `outcomes`, `messages`, `framing` | codes; state machines and procedures; states; state-command matrices; messages and their frames |
//! | `composites` | numbers that are split over several items |
//! | `overlay` | tables that change the objects of another description |
//! | `lints`, `summary` | checks of the notation; comparison of a row with other sections of the manual |
//! | `schema` | derives the JSON Schema of the format in tests; the file `schema/table.json` contains the result |

mod alternatives;
mod at;
mod bindings;
mod buses;
mod by_name;
mod code_tables;
mod composites;
mod conditions;
mod defaults;
mod definitions;
mod device;
mod ethercat;
pub mod format;
mod frames;
#[cfg(feature = "messages")]
mod framing;
mod given;
mod images;
mod in_use;
mod limits;
mod lints;
mod machine_budget;
mod machines;
#[cfg(feature = "messages")]
mod messages;
mod misplaced;
mod notation;
mod numbered;
mod objects;
mod outcomes;
pub mod overlay;
mod process;
mod read;
mod references;
mod registers;
mod repeats;
mod rows;
mod scale;
#[cfg(test)]
mod schema;
mod spaces;
mod states;
mod summary;
mod tree;
mod types;
mod units;
mod value;
mod variants;
mod windows;
mod words;

use toml::de::DeValue;

use self::machine_budget::MachineBudget;
use crate::diagnostics::{codes, Diagnostic, Diagnostics};
use crate::ir::{Buses, Catalog, Device, Group, GroupKind, ObjectCode};
use crate::source::{FileId, Source, Span};
use at::{At, Entries};
use by_name::ByName;
use definitions::Definitions;
use format::{ChapterTable, DeviceTable, OptionTable, Row};
use in_use::InUse;
use objects::Dictionary;
use read::Read;
use repeats::Repeats;
use rows::Rows;
use tree::{Node, Reader};

/// JSON Schema (draft 7) of register tables, which editors use to complete and check tables. `lexibus schema` prints it.
pub const SCHEMA: &str = include_str!("../../../schema/table.json");

/// Returns the symbol of a unit for another spelling of the unit, such as `°C` for `degC` and `rpm` for `1/min`. Returns `None`
/// if the spelling is unknown.
///
/// ```
/// use lexibus_codegen::frontend::table::usual_unit;
///
/// assert_eq!(usual_unit("Volts"), Some("V"));
/// assert_eq!(usual_unit("furlong"), None);
/// ```
pub fn usual_unit(text: &str) -> Option<&'static str> {
    units::usual(text)
}

/// Returns whether the format knows a unit symbol, or a product, quotient or power of known symbols such as `rev/s²`. All other
/// units must be defined in `[units]` of the table.
///
/// ```
/// use lexibus_codegen::frontend::table::is_unit;
///
/// assert!(is_unit("rev/s²") && !is_unit("furlong"));
/// ```
pub fn is_unit(symbol: &str) -> bool {
    units::is_known(symbol)
}

/// Supported version of the format.
const VERSION: u32 = 1;

/// Keys of a table in the order in which they are read: elements come before the elements that refer to them.
const KEYS: [&str; 25] = [
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
];

/// Reads the device that a table describes. `chosen` contains the choices for the options of the table.
///
/// Returns `None` and reports an error if the table does not describe a device.
pub fn read(
    source: &Source,
    file: FileId,
    chosen: &[(String, String)],
    diagnostics: &mut Diagnostics,
) -> Option<Catalog> {
    let mut reader = Reader::new(source, file, diagnostics);
    let mut table = Table::new(&mut reader, chosen)?;
    let Some(head) = table.take::<DeviceTable>(&mut reader, "device") else {
        let found = Diagnostic::new(&codes::TABLE_VALUE, Span::new(file, 0, 0), "the table has no `[device]`");
        reader.diagnostics.push(match table.node("overlay") {
            Some(_) => found.help("pass the overlay with `--overlay`, next to the description that it changes"),
            None => found,
        });
        return None;
    };
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
        device.groups.extend(self::chapter(&mut reader, &mut rows, &mut dictionary, &mut in_use, chapter));
    }
    summary::objects(&mut reader, &rows.definitions, &rows.summaries, &dictionary);
    for item in dictionary.values().flat_map(|group| &group.items) {
        in_use.addresses(&mut reader, item);
    }
    device.groups.extend(dictionary.into_values());
    for (name, given) in table.named::<format::GivenTable>(&mut reader, "given") {
        device.given.push(given::number(&mut reader, &name, &given, &mut rows.references));
    }
    // Images and messages need the same state as rows, because their fields have types.
    table.frames(&mut reader, &mut rows, &mut device);
    rows.definitions.make_unused(&mut reader);
    device.types = std::mem::take(&mut rows.definitions.types);
    device.doubts.append(&mut rows.definitions.doubts);
    table.rest(&mut reader, &mut rows, &mut device);
    resolve(&mut reader, &rows, &device);
    numbered::mentioned(&mut reader, &rows.numbered, &device);
    rows.allow_of_definitions(&mut reader);
    reader.diagnostics.allow(rows.allowed);
    Some(Catalog { devices: vec![device], ..Catalog::default() })
}

/// Parts of a file by their top-level key.
struct Table<'a> {
    parts: Vec<(At<String>, Option<Node<'a>>)>,
    options: Vec<(At<String>, OptionTable)>,
    spaces: Vec<(At<String>, format::SpaceTable)>,
}

impl<'a> Table<'a> {
    /// Parses a file, and replaces each option with the chosen value.
    fn new(reader: &mut Reader<'a, '_>, chosen: &[(String, String)]) -> Option<Self> {
        let mut parts: Vec<_> =
            tree::sorted(reader.parse()?).into_iter().map(|(key, node)| (key, Some(node))).collect();
        let known = || KEYS.into_iter().chain(["doubts"]);
        for (key, node) in &mut parts {
            if !known().any(|known| known == key.value) {
                let all: Vec<&str> = known().collect();
                reader.unknown_key(&key.value, &all, reader.span(key));
                *node = None;
            }
        }
        let mut table = Table { parts, options: Vec::new(), spaces: Vec::new() };
        table.version(reader);
        let mut options = Vec::new();
        for (name, node) in table.entries(reader, "options") {
            if let Some(option) = reader.piece::<OptionTable>(node.clone()) {
                options.push((name, option, node));
            }
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
            None => {
                let message = "the version of the format is missing";
                let help = "begin the file with `lexibus = 1`";
                reader.report_with_help(&codes::TABLE_VALUE, Span::new(reader.file, 0, 0), message, help);
            }
        }
    }

    fn node(&mut self, key: &str) -> Option<Node<'a>> {
        self.parts.iter_mut().find(|(name, _)| name.value == key)?.1.take()
    }

    /// Reads the table below the key `key`.
    fn take<T: Read>(&mut self, reader: &mut Reader<'a, '_>, key: &str) -> Option<At<T>> {
        let node = self.node(key)?;
        let (start, end) = (node.span().start as u32, node.span().end as u32);
        Some(At { value: reader.piece(node)?, start, end })
    }

    /// Returns the elements of the array of tables below the key `key`.
    fn nodes(&mut self, reader: &mut Reader<'a, '_>, key: &str) -> Vec<Node<'a>> {
        self.node(key).map(|node| reader.elements(node, key)).unwrap_or_default()
    }

    /// Reads the elements of the array of tables below the key `key`.
    fn list<T: Read>(&mut self, reader: &mut Reader<'a, '_>, key: &str) -> Vec<At<T>> {
        let nodes = self.nodes(reader, key);
        nodes
            .into_iter()
            .filter_map(|node| {
                let (start, end) = (node.span().start as u32, node.span().end as u32);
                Some(At { value: reader.piece(node)?, start, end })
            })
            .collect()
    }

    /// Returns the tables below the key `key`, with their names.
    fn entries(&mut self, reader: &mut Reader<'a, '_>, key: &str) -> Vec<(At<String>, Node<'a>)> {
        self.node(key).map(|node| reader.entries(node, key)).unwrap_or_default()
    }

    /// Reads the tables below the key `key`, with their names.
    fn named<T: Read>(&mut self, reader: &mut Reader<'a, '_>, key: &str) -> Vec<(At<String>, T)> {
        let entries = self.entries(reader, key);
        entries.into_iter().filter_map(|(name, node)| Some((name, reader.piece(node)?))).collect()
    }

    /// Reads the state that rows need: definitions, spaces and default values.
    fn rows(&mut self, reader: &mut Reader<'a, '_>, buses: Buses) -> Rows {
        let definitions = Definitions {
            units: ByName::new(self.named(reader, "units")),
            enums: ByName::new(self.named(reader, "enums")),
            bits: ByName::new(self.named(reader, "bits")),
            ..Definitions::default()
        };
        let spaces: Vec<(At<String>, format::SpaceTable)> = self.named(reader, "spaces");
        self.spaces.clone_from(&spaces);
        let at = |(name, table): (At<String>, _)| (name.clone(), At { value: table, start: name.start, end: name.end });
        let spaces = Entries(spaces.into_iter().map(at).collect());
        let defaults = self.node("defaults").and_then(|node| defaults::read(reader, node));
        Rows {
            repeats: Repeats::new(defaults.as_ref()),
            definitions,
            spaces: spaces::read(reader, &spaces),
            modbus: spaces::modbus_tables(reader, &spaces),
            buses,
            defaults,
            references: windows::references(&spaces),
            numbered: Vec::new(),
            allowed: Vec::new(),
            summaries: Vec::new(),
        }
    }

    /// Reads the elements that have fields: process images and messages.
    fn frames(&mut self, reader: &mut Reader<'a, '_>, rows: &mut Rows, device: &mut Device) {
        let mut images = images::Images::new(device);
        for image in self.list(reader, "images") {
            images::image(reader, rows, &image, &mut images, device);
        }
        images.finish(device);
        #[cfg(feature = "messages")]
        messages::read(reader, self, rows, device);
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

    /// Reads the elements that describe no items: axes, PDOs, codes, sequences.
    fn rest(&mut self, reader: &mut Reader<'a, '_>, rows: &mut Rows, device: &mut Device) {
        if let Some(axes) = self.take::<format::AxesTable>(reader, "axes") {
            let models = axes.value.models.iter().flatten();
            rows.references.extend(models.map(|model| (model.clone(), "model")));
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
            rows.references.extend(models.flatten().map(|model| (model.clone(), "model")));
            let end = table.rows.iter().map(|(_, row)| row.end).fold(name.end, u32::max);
            rows.allow_at(reader, (name.start, end), &table.allow);
            code_tables::table(reader, &name, &table, device);
        }
        self.sequences(reader, rows, device);
        for (name, option) in &self.options {
            let (origin, cite) = (reader.origin(name), option.cite.as_ref().map(tree::cited));
            let doubts = [option.doubt.as_ref(), option.doubts.as_ref()];
            let doubts_of_option = reader.doubts(doubts, origin, cite.as_deref());
            device.doubts.extend(tree::about(doubts_of_option, crate::ir::SubjectKind::Option, &name.value, ""));
        }
        for doubt in self.list::<format::DoubtTable>(reader, "doubts") {
            let origin = reader.origin(&doubt);
            let list = at::OneOrMany(vec![doubt.value]);
            device.doubts.extend(reader.doubts([Some(&list), None], origin, None));
        }
    }

    /// Reads state machines, procedures and composites.
    fn sequences(&mut self, reader: &mut Reader<'a, '_>, rows: &mut Rows, device: &mut Device) {
        let mut budget = MachineBudget::new();
        for (name, table) in self.named(reader, "machines") {
            if !machines::machine(reader, &name, &table, device, &mut budget, &mut rows.references) {
                break;
            }
        }
        for (name, table) in self.named::<format::ProcedureTable>(reader, "procedures") {
            let end = table.steps.iter().map(|step| step.end).fold(name.end, u32::max);
            rows.allow_at(reader, (name.start, end), &table.allow);
            machines::procedure(reader, &name, &table, device, &mut rows.references);
        }
        for (name, table) in self.named(reader, "composites") {
            composites::composite(reader, &name, &table, device, &mut rows.references);
        }
    }
}

/// Reads the rows of a chapter. Returns the registers of the chapter as a group, and adds the objects of the chapter to
/// `dictionary`.
fn chapter<'a>(
    reader: &mut Reader<'a, '_>,
    rows: &mut Rows,
    dictionary: &mut Dictionary,
    in_use: &mut InUse,
    node: Node<'a>,
) -> Option<Group> {
    let (start, end) = (node.span().start as u32, node.span().end as u32);
    let (registers, objects, mut node) = divide(reader, node)?;
    defaults::of_chapter(reader, &mut node);
    let chapter: ChapterTable = reader.piece(node)?;
    let at = At { value: (), start, end };
    let space = match &chapter.space {
        Some(name) => {
            let found = rows.spaces.iter().position(|space| space.name == name.value);
            if found.is_none() {
                let known = rows.spaces.iter().map(|space| space.name.as_str());
                reader.unresolved("space", &name.value, reader.span(name), known);
            }
            found
        }
        None => (!rows.spaces.is_empty()).then_some(0),
    };
    let defaults = chapter.defaults.as_ref().map(|row| &row.value);
    rows.repeats.chapter(defaults);
    let mut group = Group::object(0, ObjectCode::Record);
    group.kind = GroupKind::Chapter;
    group.name = chapter.title.as_deref().unwrap_or_default().into();
    group.names = reader.original(chapter.orig.as_deref());
    group.origin = reader.origin(&at);
    group.documentation = reader.documentation_of(&chapter);
    group.doubts = reader.doubts_of(&chapter, group.origin);
    lints::series(reader, &registers, space.and_then(|at| rows.spaces.get(at)));
    lints::unprinted(reader, &registers, space.and_then(|at| rows.spaces.get(at)));
    for (key, row) in registers {
        misplaced::register(reader, &key, &row);
        let items = registers::items(reader, rows, space, &key, &row, defaults);
        let part = row.value.part.as_ref().and_then(|part| notation::bits(&part.value.to_string()));
        items.iter().for_each(|item| in_use.register(reader, &group.name, item, part));
        group.items.extend(items);
    }
    for (key, row) in objects {
        misplaced::object(reader, &key, &row);
        objects::add(reader, rows, dictionary, &key, &row, space, defaults);
    }
    let says_something = !group.doubts.is_empty() || group.documentation.is_some();
    (!group.items.is_empty() || says_something).then_some(group)
}

/// Rows of a chapter's registers or objects, with their keys.
type RowList = Vec<(At<String>, At<Row>)>;

/// Separates the rows of a chapter from its other keys, so that an error in one row does not affect the other rows.
fn divide<'a>(reader: &mut Reader<'a, '_>, node: Node<'a>) -> Option<(RowList, RowList, Node<'a>)> {
    let mut node = node;
    let span = node.span();
    let DeValue::Table(table) = node.get_mut() else {
        let span = Span::new(reader.file, span.start as u32, span.end as u32);
        reader.report_with_help(&codes::TABLE_VALUE, span, "a chapter must be a table", "write `[[chapters]]`");
        return None;
    };
    let (registers, objects) = (table.remove("registers"), table.remove("objects"));
    let mut read = |part: Option<Node<'a>>, what| -> RowList {
        let entries = part.map(|part| reader.entries(part, what)).unwrap_or_default();
        entries
            .into_iter()
            .filter_map(|(key, node)| {
                let (start, end) = (node.span().start as u32, node.span().end as u32);
                Some((key, At { value: reader.piece(node)?, start, end }))
            })
            .collect()
    };
    let registers = read(registers, "chapters.registers");
    let objects = read(objects, "chapters.objects");
    Some((registers, objects, node))
}

/// Reports names without a definition, in rows and sequences.
fn resolve(reader: &mut Reader<'_, '_>, rows: &Rows, device: &Device) {
    let all = rows.references.iter().chain(&rows.definitions.mentioned);
    references::resolve(reader, all.map(|(name, what)| (name, *what)), device, &rows.numbered);
}
