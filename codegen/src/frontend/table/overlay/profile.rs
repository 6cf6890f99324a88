//! Reads the tables of profiles as plain data. The compiler contains the result, so only tests read the tables.

use std::mem;

use super::super::format::{ImageTable, ProfileTable};
use super::super::machine_budget::MachineBudget;
use super::super::rows::{Named, Rows};
use super::super::tree::{cited, Reader};
use super::super::{buses, code_tables, machines, notation, process, types, Table};
use super::patch::Patch;
use super::{PatchRow, Target};
use crate::diagnostics::{codes, Diagnostics};
use crate::ir::{Binding, Buses, CodeTable, CompactString, Device, Item, StateMachine, Type, TypeDef, TypeId};
use crate::resolve::profiles::{Described, Profile, Signal, Telegram};
use crate::source::{FileId, Source};
use crate::text::standard_and_clause;

/// Reads the table of a profile. Returns `None` if the file is not valid TOML or has no `[profile]`.
pub(crate) fn read(source: &Source, diagnostics: &mut Diagnostics) -> Option<Profile> {
    let mut reader = Reader::new(source, FileId(0), diagnostics);
    let reader = &mut reader;
    let mut table = Table::new(reader, &[])?;
    let head =
        table.required::<ProfileTable>(reader, "profile", "give the profile a name: `[profile]`, with `name`")?.value;
    let name = CompactString::from(head.name.as_deref().unwrap_or_default());
    reader.standard.clone_from(&name);
    let when = head.when.as_ref().and_then(|when| {
        let index = notation::objects(&when.value.to_string()).map(|objects| objects.indices.0);
        if index.is_none() {
            reader.report(&codes::TABLE_PLACE, reader.span(when), "`when` must be an object such as `0x6040`");
        }
        index
    });
    let buses = head.buses.as_ref().map_or(Buses::ALL, |list| buses::read(reader, list)).with_objects();
    let patch = Patch::read(reader, &mut table, &["profile", "images"]);
    let telegrams = table.list(reader, "images").iter().filter_map(|image| telegram(reader, &image.value)).collect();
    let mut rows = patch.filler();
    rows.definitions.make_unused(reader);
    let mut profile = Profile {
        name,
        number: head.number,
        when,
        api: head.api,
        on_canopen: buses.canopen,
        on_ethercat: buses.coe,
        axis_index: head.axis_index,
        telegrams,
        ..Profile::default()
    };
    for row in &patch.rows {
        let ty = row.row.value.ty.as_ref().and_then(|ty| types::named(&ty.value)).map(|named| named.ty);
        let meaning = meaning(reader, &mut rows, row, ty);
        match row.target {
            Target::Name => {
                let name = row.key.value.as_str().into();
                profile.signals.push(Signal { name, ty, meaning });
            }
            Target::Objects(objects) => {
                let described = described(reader, &mut rows, row, ty);
                profile.objects.push(Described {
                    indices: objects.indices,
                    subs: objects.subs,
                    ty,
                    meaning,
                    ..described
                });
            }
        }
    }
    profile.types = mem::take(&mut rows.definitions.types);
    profile.codes = code_tables(reader, &patch, &profile.types);
    profile.machines = machines(reader, &patch, &profile.types);
    Some(profile)
}

fn named(row: &PatchRow) -> Named<'_> {
    Named { name: "", key: &row.key, number: 0, end: row.row.end }
}

/// Returns the bit field or enumeration of a row, with the underlying integer type `ty`. Reports a row that does not refer to an
/// existing definition by its name.
fn meaning(reader: &mut Reader<'_, '_>, rows: &mut Rows, row: &PatchRow, ty: Option<Type>) -> Option<TypeId> {
    let before = rows.definitions.types.len();
    let meaning = rows.meaning(reader, named(row), &row.row.value, ty?);
    if rows.definitions.types.len() > before {
        let message =
            "a row of a profile must refer to bits or values by name, and have the base type of their definition";
        reader.report(&codes::TABLE_VALUE, reader.span(&row.key), message);
    }
    match meaning? {
        Type::Named(id) => Some(id),
        _ => None,
    }
}

/// Returns the buses, unit, behavior and documentation that a row declares for its objects, and the standard with the clause that
/// the row cites.
fn described(reader: &mut Reader<'_, '_>, rows: &mut Rows, row: &PatchRow, ty: Option<Type>) -> Described {
    let mut item = Item { ty: ty.unwrap_or(Type::Opaque(None)), ..Item::new(Binding::canopen(0, 0)) };
    rows.fill(reader, &mut item, named(row), &row.row.value, None);
    let clause = row.row.value.cite.as_ref().map(cited).unwrap_or_default();
    let buses = row.row.value.buses.as_ref().map(|_| rows.buses_of(reader, &row.row.value).with_objects());
    Described {
        buses,
        standard: standard_and_clause(&reader.standard, &clause).into(),
        quantity: item.quantity,
        behavior: item.behavior,
        documentation: item.documentation,
        ..Described::default()
    }
}

fn telegram(reader: &mut Reader<'_, '_>, image: &ImageTable) -> Option<Telegram> {
    let direction = process::direction(reader, image.direction.as_ref())?;
    let name = image.name.as_deref()?.into();
    let signals = image.fields.iter().filter_map(|(name, field)| Some((field.value.at?, name.value.as_str().into())));
    Some(Telegram { name, direction, signals: signals.collect() })
}

fn code_tables(reader: &mut Reader<'_, '_>, patch: &Patch, types: &[TypeDef]) -> Vec<CodeTable> {
    let mut device = Device { types: types.to_vec(), ..Device::default() };
    for (name, table) in &patch.codes {
        code_tables::table(reader, name, table, &mut device);
    }
    device.code_tables
}

/// Reads state machines. The items of a state machine are looked up later, in each device.
fn machines(reader: &mut Reader<'_, '_>, patch: &Patch, types: &[TypeDef]) -> Vec<StateMachine> {
    let mut device = Device { types: types.to_vec(), ..Device::default() };
    let mut budget = MachineBudget::new();
    for (name, table) in &patch.machines {
        if !machines::machine(reader, name, table, &mut device, &mut budget) {
            break;
        }
    }
    device.machines
}

mod tests {
    use super::*;
    use crate::ir::{Group, ObjectCode, Shape};
    use crate::resolve::profiles::Completion;
    use crate::source::Origin;

    const PROFILE: &str = "lexibus = 1\n[profile]\nname = \"P\"\n\
        [enums.Phase.values]\n0 = \"Off\"\n1 = \"On\"\n\
        [machines.Main]\nstatus = \"0x2000\"\ncontrol = \"0x2000\"\nstates = \"Phase\"\n\
        doubt = { says = \"two states\", chose = \"both\", why = \"the figure has them\" }\n\
        [codes.Faults]\nrows = { 1 = { name = \"Short\", doubt = { says = \"1 and 2\", chose = \"1\", why = \"page 3\" } } }\n";

    fn profile() -> Profile {
        let mut diagnostics = Diagnostics::default();
        let profile = read(&Source::new("p.toml", PROFILE.into()), &mut diagnostics).expect("a profile");
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
        let device = completed(Type::Unsigned(16), profile().types);
        assert_eq!(device.machines[0].state_type.as_ref().map(|state_type| state_type.as_str()), Some("Phase"));
    }

    #[test]
    fn doubts_of_codes_and_machines_are_kept() {
        let device = completed(Type::Unsigned(16), Vec::new());
        let doubts = [&device.code_tables[0].doubts[0], &device.machines[0].doubts[0]];
        assert_eq!(
            doubts.map(|doubt| (doubt.says.as_str(), doubt.part.as_str())),
            [("1 and 2", "1"), ("two states", "")]
        );
        assert!(doubts.iter().all(|doubt| doubt.origin == Origin::default()));
    }

    /// Checks that an enumeration has the same values for signed and unsigned objects.
    #[test]
    fn values_are_the_same_for_either_sign() {
        let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../dictionaries/profiles");
        for file in std::fs::read_dir(folder).expect("profiles") {
            let text = std::fs::read(file.expect("a file").path()).expect("a profile");
            let (source, mut diagnostics) = (Source::new("p.toml", text), Diagnostics::default());
            let mut reader = Reader::new(&source, FileId(0), &mut diagnostics);
            let mut table = Table::new(&mut reader, &[]).expect("a table");
            let mut definitions = table.rows(&mut reader, Buses::ALL).definitions;
            for name in definitions.enums.names().cloned().collect::<Vec<_>>() {
                let kind = super::super::super::definitions::DefinitionKind::Enumeration;
                let base = definitions.base(&mut reader, kind, &name.value).expect("a base");
                let other = match base {
                    Type::Integer(bits) => Type::Unsigned(bits),
                    Type::Unsigned(bits) => Type::Integer(bits),
                    other => other,
                };
                let values = [base, other].map(|base| {
                    let Some(Type::Named(TypeId(id))) = definitions.named(&mut reader, kind, &name, base) else {
                        panic!("{}", name.value);
                    };
                    match &definitions.types[id as usize].shape {
                        Shape::Enumeration { values, .. } => values.clone(),
                        other => panic!("{other:?}"),
                    }
                });
                assert_eq!(values[0], values[1], "{}", name.value);
            }
        }
    }
}
