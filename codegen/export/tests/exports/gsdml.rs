//! Tests exported GSDML files: their content, validity, notes and refusals.

use crate::corpus_support::root::root;
use crate::corpus_support::round_trip::options as reading;
use crate::corpus_support::xsd::Schema;
use lexibus_codegen::compile::{check, read};
use lexibus_codegen::ir::{Catalog, Type};
use lexibus_codegen::source::Source;
use lexibus_export::gsdml::{export, file_name, Export, NoteKind, Options, Refusal};

/// The register table of a drive with two process images, in which some fields share bytes.
const TABLE: &str = r#"
lexibus = 1
[device]
name = "Positioner"
vendor = "Example"
buses = ["modbus", "profinet"]
doc = "A drive for one axis."

[spaces.register]
modbus = { table = "holding" }

[[chapters]]
title = "Control"
space = "register"
[chapters.registers]
target = { reg = 1, type = "i32", access = "rw", unit = "µm" }
speed = { reg = 3, type = "u16", access = "rw" }

[[images]]
name = "outputs"
direction = "rx"
bytes = 9

[images.fields]
enable = { at = 0, bit = 0, type = "bool" }
"reset fault" = { at = 0, bit = 7, type = "bool" }
target = { at = 1 }
speed = { at = 6 }

[[images]]
name = "inputs"
direction = "tx"
bytes = 5

[images.fields]
ready = { at = 0, bit = 1, type = "bool" }
position = { at = 1, type = "i32" }
"#;

/// Facts that a GSDML requires and a register table does not have.
const FACTS: [(&str, &str); 27] = [
    ("vendor-id", "0x0123"),
    ("device-id", "0x0001"),
    ("main-family", "Drives"),
    ("product-family", "Positioner"),
    ("date", "20240131"),
    ("dns-name", "positioner"),
    ("pnio-version", "V2.35"),
    ("module-ident", "0x10"),
    ("submodule-ident", "0x11"),
    ("min-device-interval", "32"),
    ("object-uuid-index", "1"),
    ("max-input-length", "10"),
    ("max-output-length", "14"),
    ("name-not-transferable", "true"),
    ("device-access", "true"),
    ("check-device-id", "true"),
    ("process-alarms", "false"),
    ("interface-ident", "0x20"),
    ("interface-name", "X1"),
    ("consistent", "true"),
    ("supported-protocols", "SNMP;LLDP"),
    ("ports", "2"),
    ("port-ident", "0x21"),
    ("mau-type", "16"),
    ("startup-modes", "Legacy;Advanced"),
    ("conformance-class", "B"),
    ("application-class", "none"),
];

fn table() -> Catalog {
    let compilation = check(Source::new("positioner.toml", TABLE.into()), &reading());
    let reports: Vec<String> = compilation.diagnostics.list().iter().map(|found| compilation.one_line(found)).collect();
    assert!(!compilation.diagnostics.has_errors(), "{reports:?}");
    compilation.catalog.expect("a table")
}

fn given() -> Options {
    let mut options = Options::default();
    FACTS.iter().for_each(|(key, value)| options.set(key, value).expect("an option"));
    options
}

fn note_lines(export: &Export) -> String {
    export.notes.iter().map(|note| format!("{note}\n")).collect()
}

#[test]
fn gsdml_of_process_images() {
    let exported = export(&table(), &given()).expect("a GSDML");
    insta::assert_snapshot!(note_lines(&exported) + "\n" + &exported.text);
    if let Some(schema) = Schema::new("gsdml/GSDML-DeviceProfile-v2.35.xsd") {
        assert_eq!(schema.violations("images", [("export.xml", exported.text.as_bytes())]), Vec::<String>::new());
    }
    let name = file_name(&table(), &given()).expect("a name");
    assert_eq!(name, "GSDML-V2.35-Example-Positioner-20240131");
    let again = read(Source::new((name + ".xml").as_str(), exported.text.into()), &reading());
    let reports: Vec<String> = again.diagnostics.list().iter().map(|found| again.one_line(found)).collect();
    assert_eq!(reports, Vec::<String>::new());
    let catalog = again.catalog.expect("a catalog");
    // Options of a device access point have an effect only if the export creates one.
    let of_itself = export(&catalog, &given()).expect("a GSDML");
    let unused = of_itself.notes.iter().find(|note| note.kind == NoteKind::GivenFact).expect("a note");
    assert_eq!((unused.count, unused.first.as_str()), (FACTS.len() - 5, "dns-name"));
    let data = catalog.submodules.iter().find_map(|submodule| submodule.output.as_ref()).expect("output data");
    let fields = &data.image.fields;
    let position = |name: &str| {
        let found = fields.iter().find(|field| field.name == name).expect("a field");
        (found.bit_offset, found.bits, found.ty)
    };
    assert_eq!(position("enable"), (0, 1, Type::Boolean));
    assert_eq!(position("reset fault"), (7, 1, Type::Boolean));
    assert_eq!(position("target"), (8, 32, Type::Integer(32)));
    assert_eq!(position("speed"), (48, 16, Type::Unsigned(16)));
    assert_eq!(data.image.length, 9);
}

#[test]
fn missing_facts_are_listed() {
    let Err(Refusal::Missing(facts)) = export(&table(), &Options::default()) else {
        panic!("many required facts are missing")
    };
    let keys: Vec<&str> = facts.iter().map(|fact| fact.key).collect();
    for key in ["vendor-id", "device-id", "dns-name", "module-ident", "min-device-interval", "date"] {
        assert!(keys.contains(&key), "{key} of {keys:?}");
    }
    assert!(facts.iter().all(|fact| !fact.what.is_empty()));
    assert_eq!(export(&Catalog::default(), &Options::default()), Err(Refusal::Nothing));
    assert_eq!(file_name(&table(), &Options::default()), None);
    let mut options = Options::default();
    assert!(options.set("device-access", "perhaps").is_err_and(|text| text.contains("`true` or `false`")));
}

/// Exports all tables of the project that have process images. Each GSDML must be valid.
#[test]
fn every_table_with_images_has_a_gsdml() {
    let folder = root().join("dictionaries");
    let files = std::fs::read_dir(folder).expect("the tables").map(|entry| entry.expect("a table").path());
    let mut options = given();
    options.set("vendor-name", "Example").expect("an option");
    options.set("description", "A device.").expect("an option");
    for path in files.filter(|path| path.extension().is_some_and(|ending| ending == "toml")) {
        let name = path.file_stem().expect("a name").to_string_lossy().into_owned();
        let source = Source::new(name.clone() + ".toml", std::fs::read(&path).expect("a table"));
        let exported = match export(&check(source, &reading()).catalog.expect("a table"), &options) {
            Ok(exported) => exported,
            Err(Refusal::Nothing) => continue,
            Err(refusal) => panic!("{name}: {refusal}"),
        };
        if let Some(schema) = Schema::new("gsdml/GSDML-DeviceProfile-v2.35.xsd") {
            assert_eq!(schema.violations(&name, [("export.xml", exported.text.as_bytes())]), Vec::<String>::new());
        }
        let again = read(Source::new("export.xml", exported.text.into()), &reading());
        assert!(
            !again.diagnostics.has_errors() && again.catalog.is_some_and(|catalog| !catalog.devices.is_empty()),
            "{name}"
        );
    }
}
