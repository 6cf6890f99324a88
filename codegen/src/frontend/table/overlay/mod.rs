//! Overlays and profiles: tables that say something of objects which another file describes.
//!
//! | file | subject |
//! |---|---|
//! | `apply` | an overlay, and the devices and modules that it is for |
//! | `change` | a row of an overlay changes what is described, and its reason is kept |
//! | `complete` | a profile adds what a description leaves unsaid |

mod apply;
mod change;
mod complete;

pub use apply::apply;
pub(crate) use complete::Completion;

use super::at::At;
use super::definitions::Definitions;
use super::format::{
    AxesTable, ChapterTable, CodesTable, DoubtTable, ImageTable, MachineTable, ManualTable, OverlayTable,
    ProcedureTable, ProfileTable, Row,
};
use super::machine_budget::MachineBudget;
use super::place::{self, Objects};
use super::repeats::Repeats;
use super::rows::Rows;
use super::tree::Reader;
use super::{code_tables, machines, Table};
use crate::diagnostics::{codes, Diagnostic, Diagnostics};
use crate::ir::{
    Buses, CodeTable, CompactString, Device, Doubts, Format, Group, Item, ItemRef, ObjectCode, StateMachine, Type,
    TypeDef,
};
use crate::source::{FileId, Origin, Source, Span};
use crate::text::brief;

/// The format of overlays.
pub(crate) const FORMAT: Format = Format::Table;

/// What a table says of objects that another file describes.
#[derive(Clone, Debug, Default)]
struct Patch {
    rows: Vec<PatchRow>,
    /// Its definitions; no type is made of them yet.
    definitions: Definitions,
    /// The types that they make, for machines whose states are the values of one.
    types: Vec<TypeDef>,
    axes: Option<At<AxesTable>>,
    images: Vec<At<ImageTable>>,
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

/// Those that only profiles have.
const PROFILE_KEYS: [&str; 2] = ["profile", "images"];

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
        let mut made = definitions.clone();
        made.make_unused(reader);
        Patch {
            definitions,
            types: made.types,
            rows: rows(reader, table),
            axes: table.take(reader, "axes"),
            images: table.list(reader, "images"),
            codes: table.named(reader, "codes"),
            machines: table.named(reader, "machines"),
            procedures: table.named(reader, "procedures"),
            doubts: table.list(reader, "doubts"),
            language: reader.language.clone(),
        }
    }

    /// Codes and state machines, each with its doubts, as a device has them that has nothing but the definitions; they stand
    /// nowhere in its description.
    fn behaviour(&self, reader: &mut Reader<'_, '_>) -> (Vec<Doubted<CodeTable>>, Vec<Doubted<StateMachine>>) {
        let mut device = Device { types: self.types.clone(), ..Device::default() };
        let mut tables = Vec::new();
        for (name, table) in &self.codes {
            code_tables::table(reader, name, table, &mut device);
            device.code_tables.iter_mut().for_each(|own| own.origin = Origin::default());
            let doubts = nowhere(&mut device.doubts);
            tables.extend(device.code_tables.drain(..).map(|own| (own, doubts.clone())));
        }
        let mut machines = Vec::new();
        let mut budget = MachineBudget::new();
        for (name, table) in &self.machines {
            // Whether its items exist is another matter with each device.
            if !machines::machine(reader, (name, table), &mut device, &mut budget, &mut Vec::new()) {
                break;
            }
            let doubts = nowhere(&mut device.doubts);
            machines.extend(device.machines.drain(..).map(|own| (own, doubts.clone())));
        }
        (tables, machines)
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

/// A part of a profile, and its doubts.
type Doubted<T> = (T, Doubts);

/// Takes the doubts of a profile, whose file is none of a device's.
fn nowhere(doubts: &mut Doubts) -> Doubts {
    doubts.iter_mut().for_each(|doubt| doubt.origin = Origin::default());
    std::mem::take(doubts)
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

/// A profile: what a standard says of the objects of every device that follows it.
#[derive(Clone, Debug)]
pub(crate) struct Profile {
    source: Source,
    /// Who follows it.
    pub head: ProfileTable,
    /// The object that shows that a device follows it.
    pub when: Option<u16>,
    patch: Patch,
    /// Its codes and state machines, which are the same for every device.
    codes: Vec<Doubted<CodeTable>>,
    machines: Vec<Doubted<StateMachine>>,
}

impl Profile {
    /// Reads a profile.
    pub(crate) fn read(source: Source, diagnostics: &mut Diagnostics) -> Option<Profile> {
        let mut reader = Reader::new(&source, FileId(0), diagnostics);
        let mut table = Table::new(&mut reader, &[])?;
        let Some(head) = table.take::<ProfileTable>(&mut reader, "profile") else {
            let message = "the table has no `[profile]`";
            reader.report(&codes::TABLE_VALUE, Span::new(reader.file, 0, 0), message);
            return None;
        };
        let when = head.value.when.as_ref().and_then(|when| {
            let index = match &when.value {
                super::format::NumberOrText::Number(number) => u16::try_from(*number).ok(),
                super::format::NumberOrText::Text(text) => place::objects(text).map(|objects| objects.indices.0),
            };
            if index.is_none() {
                reader.report(&codes::TABLE_PLACE, reader.span(when), "`when` is an object such as `0x6040`");
            }
            index
        });
        reader.standard = head.value.name.as_deref().unwrap_or_default().into();
        let patch = Patch::read(&mut reader, &mut table, &PROFILE_KEYS);
        let (codes, machines) = patch.behaviour(&mut reader);
        drop(table);
        Some(Profile { head: head.value, when, patch, codes, machines, source })
    }

    /// The standard's name.
    fn standard(&self) -> CompactString {
        self.head.name.as_deref().unwrap_or_default().into()
    }

    /// Whether these objects are those of something that follows the profile. Without an object that would show it, they are.
    pub(crate) fn is_shown_by(&self, groups: &[Group]) -> bool {
        let Some(index) = self.when else { return true };
        let found = groups.binary_search_by_key(&Some(index), Group::index).ok().and_then(|at| groups.get(at));
        let Some(group) = found.filter(|group| !group.object_code().is_some_and(ObjectCode::has_subs)) else {
            return false;
        };
        let is_meant = |row: &&PatchRow| matches!(row.target, Target::Objects(own) if own.indices == (index, index));
        let row = self.patch.rows.iter().find(is_meant);
        // A type that the description defines may be anything.
        let is_alike =
            |ty: Type| matches!(ty, Type::Named(_)) || row.is_none_or(|row| complete::is_alike(ty, &row.row.value));
        group.sub(0).is_some_and(|item| is_alike(item.ty))
    }
}

/// The groups of objects with these indices; groups have to be sorted, as [`Device::object`](crate::ir::Device::object) says.
fn in_range(groups: &mut [Group], (first, last): (u16, u16)) -> &mut [Group] {
    let start = groups.partition_point(|group| group.index() < Some(first));
    let end = groups.partition_point(|group| group.index() <= Some(last));
    groups.get_mut(start..end).unwrap_or_default()
}

/// The item at the object that a name spells, where it spells one.
fn at_place<'g>(groups: &'g [Group], name: &str) -> Option<&'g Item> {
    let objects = place::objects(name)?;
    let position = groups.binary_search_by_key(&Some(objects.indices.0), Group::index).ok()?;
    groups.get(position)?.sub(objects.subs.map_or(0, |(first, _)| first))
}

/// The name of the item at the object that `name` spells, or `name` itself.
fn item_name(groups: &[Group], reference: &ItemRef) -> ItemRef {
    match at_place(groups, reference) {
        Some(item) if !item.name.is_empty() => ItemRef { name: item.name.clone(), ..reference.clone() },
        _ => reference.clone(),
    }
}

/// Names that conditions of bits and values give as objects become those of the items there.
fn name_conditions(groups: &[Group], types: &mut [TypeDef]) {
    for definition in types {
        let conditions: Vec<_> = match &mut definition.shape {
            crate::ir::Shape::BitField { fields, .. } => {
                fields.iter_mut().filter_map(|own| own.when.as_mut()).collect()
            }
            crate::ir::Shape::Enumeration { values, .. } => {
                values.iter_mut().filter_map(|own| own.when.as_mut()).collect()
            }
            _ => continue,
        };
        for when in conditions {
            when.item = item_name(groups, &when.item);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::complete::Completion;
    use super::*;
    use crate::ir::Binding;

    const PROFILE: &str = "lexibus = 1\n[profile]\nname = \"P\"\n\
        [enums.Phase.values]\n0 = \"Off\"\n1 = \"On\"\n\
        [machines.Main]\nstatus = \"0x2000\"\ncontrol = \"0x2000\"\nstates = \"Phase\"\n\
        doubt = { says = \"two states\", chose = \"both\", why = \"the figure has them\" }\n\
        [codes.Faults]\nrows = { 1 = { name = \"Short\", doubt = { says = \"1 and 2\", chose = \"1\", why = \"page 3\" } } }\n";

    fn profile() -> Profile {
        let mut diagnostics = Diagnostics::default();
        let profile = Profile::read(Source::new("p.toml", PROFILE.into()), &mut diagnostics).expect("a profile");
        assert!(diagnostics.list().is_empty(), "{:?}", diagnostics.list());
        profile
    }

    fn completed(ty: Type, types: Vec<TypeDef>) -> Device {
        let mut group = Group::object(0x2000, ObjectCode::Var);
        let mut item = Item::new(Binding::canopen(0x2000, 0));
        (item.name, item.ty) = ("Status".into(), ty);
        group.items.push(item);
        let mut device = Device { groups: vec![group], types, ..Device::default() };
        Completion::new(&profile()).device(&mut device, &|_| true);
        device
    }

    #[test]
    fn states_of_a_profile_are_those_of_its_enumeration() {
        let device = completed(Type::Unsigned(16), Vec::new());
        let states: Vec<_> = device.machines[0].states.iter().map(|state| (state.name.as_str(), state.value)).collect();
        assert_eq!(states, [("Off", 0), ("On", 1)]);
        assert_eq!(device.machines[0].state_type, None, "the device has no such type");
        let device = completed(Type::Unsigned(16), profile().patch.types);
        assert_eq!(device.machines[0].state_type.as_ref().map(|own| own.as_str()), Some("Phase"));
    }

    #[test]
    fn doubts_of_codes_and_machines_are_kept() {
        let device = completed(Type::Unsigned(16), Vec::new());
        let doubts: Vec<&str> = device.doubts.iter().map(|doubt| doubt.says.as_str()).collect();
        assert_eq!(doubts, ["1 and 2", "two states"]);
        assert!(device.doubts.iter().all(|doubt| doubt.origin == Origin::default()));
    }
}
