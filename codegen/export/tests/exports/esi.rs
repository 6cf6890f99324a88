//! Tests exported ESI files: their content, validity, notes and refusals.

use std::sync::Arc;

use crate::corpus_support::root::root;
use crate::corpus_support::round_trip::options;
use crate::corpus_support::xsd::Schema;
use lexibus_codegen::compile::{read, Options as Reading};
use lexibus_codegen::ir::{Catalog, Device, Documentation, Value};
use lexibus_codegen::source::Source;
use lexibus_export::esi::{export, Area, Export, NoteKind, Options, Refusal};

/// An EtherCAT slave that uses most features of ETG.2000.
const SLAVE: &str = include_str!("slave.xml");

/// The EDS of a CANopen device.
const EDS: &str = "\
[DeviceInfo]
VendorName=Example
VendorNumber=0x1234
ProductName=Pump <A&B>
ProductNumber=0x10
RevisionNumber=0x20001
[1000]
ParameterName=Device type
DataType=7
AccessType=const
DefaultValue=0x20192
[1017]
ParameterName=Producer heartbeat time
DataType=6
AccessType=rw
[2000]
ParameterName=Speeds
ObjectType=8
SubNumber=3
[2000sub0]
ParameterName=Highest sub-index
DataType=5
AccessType=const
DefaultValue=2
[2000sub1]
ParameterName=Low
DataType=3
AccessType=rww
PDOMapping=1
LowLimit=-5
HighLimit=5
[2000sub2]
ParameterName=High
DataType=3
AccessType=rww
PDOMapping=1
[2001]
ParameterName=Name
DataType=9
AccessType=rw
DefaultValue=pump
[2002]
ParameterName=Gains
ObjectType=9
SubNumber=2
[2002sub0]
ParameterName=Highest sub-index
DataType=5
AccessType=const
[2002sub1]
ParameterName=Proportional
DataType=8
AccessType=rw
DefaultValue=1.5
Unit=1/s
[1600]
ParameterName=RPDO 1 mapping
ObjectType=8
SubNumber=2
[1600sub0]
ParameterName=Count
DataType=5
AccessType=rw
DefaultValue=1
[1600sub1]
ParameterName=Entry 1
DataType=7
AccessType=rw
DefaultValue=0x20000110
";

fn catalog(name: &str, text: &str) -> Catalog {
    read(Source::new(name, text.into()), &options()).catalog.expect("a catalog")
}

fn note_lines(export: &Export) -> String {
    export.notes.iter().map(|note| format!("{note}\n")).collect()
}

/// Validates an exported file if a validator is installed, and reads the file. Reading must cause no diagnostics.
fn valid(what: &str, text: &str) -> Catalog {
    if let Some(schema) = Schema::new("esi/EtherCATInfo.xsd") {
        assert_eq!(schema.violations(what, [("export.xml", text.as_bytes())]), Vec::<String>::new());
    }
    let again = read(Source::new("export.xml", text.into()), &options());
    let reports: Vec<String> = again.diagnostics.list().iter().map(|found| again.one_line(found)).collect();
    assert_eq!(reports, Vec::<String>::new());
    again.catalog.expect("a catalog")
}

#[test]
fn esi_of_a_slave() {
    let exported = export(&catalog("slave.xml", SLAVE), &Options::default()).expect("an ESI");
    insta::assert_snapshot!(note_lines(&exported) + "\n" + &exported.text);
    valid("slave", &exported.text);
}

#[test]
fn the_description_of_a_pdo_is_left_out() {
    let mut catalog = catalog("slave.xml", SLAVE);
    let notes = |catalog: &Catalog| -> Vec<(NoteKind, usize)> {
        let exported = export(catalog, &Options::default()).expect("an ESI");
        exported.notes.iter().map(|note| (note.kind, note.count)).collect()
    };
    let before = notes(&catalog);
    let pdo = &mut catalog.devices[0].process_data.pdos[0];
    pdo.documentation = Some(Arc::new(Documentation { text: "Velocity.".into(), ..Documentation::default() }));
    let more = notes(&catalog);
    assert_ne!(before, more, "a note counts the fact");
    let count = |list: &[(NoteKind, usize)]| -> usize {
        list.iter().filter(|(kind, _)| *kind == NoteKind::Documentation).map(|(_, count)| count).sum()
    };
    assert_eq!(count(&more), count(&before) + 1);
}

#[test]
fn options_take_precedence() {
    let options = Options {
        vendor_id: Some(0x99),
        vendor_name: Some("Other".into()),
        product_code: Some(0x77),
        revision: Some(3),
        physics: Some("KK".into()),
        ..Options::default()
    };
    let again = valid("options", &export(&catalog("slave.xml", SLAVE), &options).expect("an ESI").text);
    let Device { identity, ethercat, .. } = &again.devices[0];
    assert_eq!((identity.vendor_id, identity.vendor_name.as_str()), (Some(0x99), "Other"));
    assert_eq!((identity.product_code, identity.revision_number), (Some(0x77), Some(3)));
    assert_eq!(ethercat.as_ref().expect("EtherCAT").physics, "KK");
}

#[test]
fn unused_options_are_noted() {
    let mut options = Options { vendor_id: Some(1), ..Options::default() };
    for (key, value) in [("coe", "sdo-info"), ("mailbox-out", "0x1000:128")] {
        options.set(key, value).expect("an option");
    }
    let exported = export(&catalog("slave.xml", SLAVE), &options).expect("an ESI");
    let note = exported.notes.iter().find(|note| note.kind == NoteKind::GivenFact).expect("a note");
    assert_eq!((note.count, note.first.as_str()), (2, "mailbox-out"), "the device has a mailbox and sync managers");
}

#[test]
fn missing_facts_are_listed() {
    let eds = catalog("pump.eds", EDS);
    let Err(Refusal::Missing(facts)) = export(&eds, &Options::default()) else { panic!("the options have no physics") };
    assert_eq!(facts.iter().map(|fact| fact.key).collect::<Vec<_>>(), ["physics", "group"]);
    let text = Refusal::Missing(facts).to_string();
    assert!(text.contains("`physics` (Kind of each port") && text.contains("`group` (Key of the group"), "{text}");
    assert_eq!(export(&Catalog::default(), &Options::default()), Err(Refusal::Nothing));
    let mut options = Options::default();
    assert_eq!(options.set("mailbox-out", "0x1000:128"), Ok(()));
    assert_eq!(options.mailbox_out, Some(Area { start: 0x1000, length: Some(128) }));
    assert!(options.set("mailbox-out", "here").is_err_and(|text| text.contains("an address")));
    assert!(options.set("color", "red").is_err_and(|text| text.contains("unknown option `color`")));
}

/// Returns facts that an ESI requires and an EDS does not contain.
fn of_a_slave() -> Options {
    let mut options = Options::default();
    let facts = [
        ("physics", "YY"),
        ("group", "Pumps"),
        ("mailbox-out", "0x1000:128"),
        ("mailbox-in", "0x1080:128"),
        ("outputs", "0x1100"),
        ("inputs", "0x1180"),
        ("coe", "sdo-info,pdo-assign"),
    ];
    facts.iter().for_each(|(key, value)| options.set(key, value).expect("an option"));
    options
}

#[test]
fn esi_of_a_canopen_device() {
    let exported = export(&catalog("pump.eds", EDS), &of_a_slave()).expect("an ESI");
    insta::assert_snapshot!(note_lines(&exported) + "\n" + &exported.text);
    let again = valid("canopen", &exported.text);
    let device = &again.devices[0];
    assert_eq!(device.name, "Pump <A&B>");
    assert_eq!(device.entry(0x2000, 1).expect("an entry").limits.low, Some(Value::Int(-5)));
    assert_eq!(device.entry(0x2002, 1).expect("an entry").default, Some(Value::Real(1.5)));
    assert!(device.object(0x1017).is_none(), "a heartbeat is a CAN service");
    assert_eq!(device.process_data.sync_managers.len(), 4);
}

#[test]
fn esi_of_a_register_table() {
    const TABLE: &str = include_str!("../../../../dictionaries/aec-vector-step.toml");
    let table = read(Source::new("aec-vector-step.toml", TABLE.into()), &Reading::default());
    let catalog = table.catalog.expect("a table");
    let mut options = of_a_slave();
    for (key, value) in [("vendor-id", "0x1"), ("product-code", "0x2"), ("revision", "1"), ("vendor-name", "Example")] {
        options.set(key, value).expect("an option");
    }
    let exported = export(&catalog, &options).expect("an ESI");
    let again = valid("table", &exported.text);
    let (before, after) = (&catalog.devices[0], &again.devices[0]);
    let mut count = 0;
    for item in before.groups.iter().flat_map(|group| &group.items) {
        let on_ethercat = item.bindings.iter().find_map(|binding| match binding {
            lexibus_codegen::ir::Binding::Object { buses, index, sub_index } if buses.coe => Some((*index, *sub_index)),
            _ => None,
        });
        let Some((index, sub)) = on_ethercat else { continue };
        let found = after.entry(index, sub).unwrap_or_else(|| panic!("{index:04X}:{sub:02X} is lost"));
        assert_eq!(found.name, item.name);
        assert_eq!(
            (found.access.readable(), found.access.writable()),
            (item.access.readable(), item.access.writable())
        );
        count += 1;
    }
    assert!(count > 100, "only {count} items are on EtherCAT");
    let kinds: Vec<NoteKind> = exported.notes.iter().map(|note| note.kind).collect();
    assert!(kinds.contains(&NoteKind::BitField), "{kinds:?}");
}

/// Exports all tables of the project that have objects. Each ESI must be valid.
#[test]
fn every_table_with_objects_has_an_esi() {
    let folder = root().join("dictionaries");
    let files = std::fs::read_dir(folder).expect("the tables").map(|entry| entry.expect("a table").path());
    let mut options = of_a_slave();
    for (key, value) in [("vendor-id", "0x1"), ("product-code", "0x2"), ("revision", "1"), ("vendor-name", "Example")] {
        options.set(key, value).expect("an option");
    }
    let mut count = 0;
    for path in files.filter(|path| path.extension().is_some_and(|ending| ending == "toml")) {
        let name = path.file_stem().expect("a name").to_string_lossy().into_owned();
        let compilation =
            read(Source::new(name.clone() + ".toml", std::fs::read(&path).expect("a table")), &Reading::default());
        match export(&compilation.catalog.expect("a table"), &options) {
            Ok(exported) => drop(valid(&name, &exported.text)),
            Err(Refusal::Nothing) => continue,
            Err(refusal) => panic!("{name}: {refusal}"),
        }
        count += 1;
    }
    assert!(count > 0, "no table has objects");
}

#[test]
fn the_documentation_lists_every_note() {
    let documentation = include_str!("../../../../docs/src/diagnostics.md");
    for kind in NoteKind::ALL {
        assert!(documentation.contains(&format!("| `{}` | {} |", kind.name(), kind.text())), "{kind:?}");
    }
}

#[test]
fn the_documentation_lists_every_option() {
    for (documentation, keys) in [
        (include_str!("../../../../docs/src/esi.md"), Options::KEYS),
        (include_str!("../../../../docs/src/esi.md"), lexibus_export::sii::Options::KEYS),
        (include_str!("../../../../docs/src/gsdml.md"), lexibus_export::gsdml::Options::KEYS),
    ] {
        for (key, what) in keys {
            assert!(documentation.contains(&format!("| `{key}` | {} |", what.trim_end_matches('.'))), "{key}");
        }
    }
}
