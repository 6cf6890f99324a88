//! Tests which facts profiles add to devices and which facts of devices they keep. Profiles must cause no diagnostics.

use crate::corpus_support;

use std::path::Path;

use lexibus_codegen::backend::rust::Presence;
use lexibus_codegen::compile::{check, Options};
use lexibus_codegen::diagnostics::codes::CODES;
use lexibus_codegen::diagnostics::{Level, Levels};
use lexibus_codegen::ir::{BitMeaning, Catalog, Device, FactOrigin, Item, Scale, Shape, Type, TypeDef};
use lexibus_codegen::source::Source;

const DEMO: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../dictionaries/demo-drive.eds");

fn catalog(name: &str, text: &str, options: &Options) -> Catalog {
    let compilation = check(Source::new(name, text.as_bytes().to_vec()), options);
    compilation.catalog.expect("a catalog")
}

fn device(text: &str) -> Device {
    catalog("x.eds", text, &Options::default()).devices.remove(0)
}

fn demo(options: &Options) -> Device {
    let text = std::fs::read_to_string(DEMO).expect("the demo drive");
    catalog("demo-drive.eds", &text, options).devices.remove(0)
}

fn without() -> Options {
    Options { no_profiles: true, ..Options::default() }
}

fn item(device: &Device, index: u16, sub: u8) -> &Item {
    device.entry(index, sub).unwrap_or_else(|| panic!("0x{index:04X}:{sub} exists"))
}

fn definition(types: &[TypeDef], ty: Type) -> &TypeDef {
    let Type::Named(id) = ty else { panic!("{ty} has no definition") };
    &types[id.0 as usize]
}

fn type_name(device: &Device, index: u16, sub: u8) -> String {
    match item(device, index, sub).ty {
        ty @ Type::Named(_) => definition(&device.types, ty).name.to_string(),
        ty => ty.to_string(),
    }
}

/// Returns an EDS of a drive that contains the additional sections `more`.
fn drive(more: &str) -> String {
    format!(
        "[DeviceInfo]\nProductName=Drive\n\
         [1000]\nParameterName=Device type\nDataType=7\nAccessType=ro\nDefaultValue=0x00020192\n\
         [6040]\nParameterName=Control\nDataType=6\nAccessType=rww\nPDOMapping=1\n\
         [6041]\nParameterName=Status\nDataType=6\nAccessType=ro\nPDOMapping=1\n\
         [6060]\nParameterName=Mode\nDataType=2\nAccessType=rw\nDefaultValue=1\n{more}"
    )
}

#[test]
fn a_drive_gets_the_names_of_its_bits_and_values() {
    let device = demo(&Options::default());
    assert_eq!(type_name(&device, 0x6040, 0), "Controlword");
    assert_eq!(type_name(&device, 0x6041, 0), "Statusword");
    assert_eq!(type_name(&device, 0x6060, 0), "ModesOfOperation");
    assert_eq!(item(&device, 0x6060, 0).ty, item(&device, 0x6061, 0).ty, "one type for both");
    assert_eq!(type_name(&device, 0x1400, 1), "ReceivePdoIdentifier");
    assert_eq!(type_name(&device, 0x1600, 1), "MappingEntry");
    assert_eq!(type_name(&device, 0x1010, 1), "StoreParameters");
    let heartbeat = item(&device, 0x1017, 0);
    assert_eq!(heartbeat.quantity.as_ref().expect("a unit").unit, "ms");
    assert!(heartbeat.documentation.is_some());

    let Shape::BitField { fields, .. } = &definition(&device.types, item(&device, 0x6040, 0).ty).shape else {
        panic!("bits");
    };
    let bit = |name: &str| fields.iter().find(|field| field.name == name).expect(name);
    assert_eq!(bit("quick stop").meaning, BitMeaning::Flag { inverted: true });
    let when = bit("new set-point").when.as_ref().expect("a condition");
    assert_eq!(when.item, "Modes of operation", "the name of the object in the device");

    let machine = device.machines.first().expect("the state machine");
    assert_eq!((machine.status_item.as_str(), machine.control_item.as_str()), ("Statusword", "Controlword"));
    assert_eq!((machine.states.len(), machine.commands.len(), machine.transitions.len()), (8, 7, 16));
    assert!(device.code_tables.iter().any(|table| table.name == "drive errors"));
}

#[test]
fn process_data_have_the_types_of_their_items() {
    let device = demo(&Options::default());
    let entries = device.process_data.pdos.iter().flat_map(|pdo| &pdo.entries);
    let control: Vec<_> = entries.filter(|entry| entry.index == 0x6040).collect();
    assert!(!control.is_empty());
    assert!(control.iter().all(|entry| entry.ty == item(&device, 0x6040, 0).ty));
}

#[test]
fn nothing_else_changes() {
    let (plain, full) = (demo(&without()), demo(&Options::default()));
    assert!(plain.types.is_empty() && plain.machines.is_empty() && plain.code_tables.is_empty());
    assert_eq!(plain.groups.len(), full.groups.len());
    for (before, after) in plain.groups.iter().zip(&full.groups) {
        assert_eq!((&before.name, &before.kind, before.origin), (&after.name, &after.kind, after.origin));
        assert_eq!(before.items.len(), after.items.len());
        for (before, after) in before.items.iter().zip(&after.items) {
            let mut added = after.origins.0.iter().filter(|origin| !before.origins.0.contains(origin));
            assert!(added.all(|(_, origin)| matches!(origin, FactOrigin::Standard(_))));
            let after = Item {
                ty: before.ty,
                quantity: before.quantity.clone(),
                documentation: before.documentation.clone(),
                origins: before.origins.clone(),
                ..after.clone()
            };
            assert_eq!(*before, after);
        }
    }
    assert!(full.types.iter().all(|definition| definition.origin.line == 0), "types of a profile have no line");
}

#[test]
fn what_the_device_says_of_itself_stays() {
    let table = "lexibus = 1\n[device]\nname = \"D\"\nprofiles = [402]\nbuses = [\"canopen\"]\n[[chapters]]\n[chapters.objects]\n\
        0x6040 = { name = \"CW\", type = \"u16\", access = \"rw\", bits = \"Mine\", doc = \"Mine.\" }\n\
        0x6060 = { name = \"Mode\", type = \"i8\", access = \"rw\", enum = { 1 = \"own\" } }\n\
        0x6061 = { name = \"Mode now\", type = \"i8\", access = \"ro\" }\n\
        0x6071 = { name = \"Torque\", type = \"i16\", access = \"rw\", unit = \"mNm\" }\n\
        0x6072 = { name = \"Max torque\", type = \"u16\", access = \"rw\", doc = \"Own words.\" }\n\
        [bits.Mine.at]\n0 = \"go\"\n";
    let device = catalog("d.toml", table, &Options::default()).devices.remove(0);
    assert_eq!(type_name(&device, 0x6040, 0), "Mine");
    assert_eq!(&*item(&device, 0x6040, 0).documentation.as_ref().expect("words").text, "Mine.");
    assert_eq!(type_name(&device, 0x6060, 0), "Mode");
    assert_eq!(type_name(&device, 0x6061, 0), "ModesOfOperation");
    let torque = item(&device, 0x6071, 0).quantity.as_ref().expect("a unit");
    assert_eq!((torque.unit.as_str(), torque.scale.clone()), ("mNm", None));
    let max = item(&device, 0x6072, 0);
    assert_eq!(&*max.documentation.as_ref().expect("words").text, "Own words.");
    let quantity = max.quantity.as_ref().expect("a unit");
    let percent = Scale::Linear { factor: 0.1, offset: 0.0 };
    assert_eq!((quantity.unit.as_str(), quantity.scale.clone()), ("%", Some(percent)));
}

#[test]
fn another_width_has_another_meaning_and_another_sign_another_name() {
    let device = device(&drive(
        "[6061]\nParameterName=Mode now\nDataType=5\nAccessType=ro\n[6098]\nParameterName=Homing\nDataType=6\nAccessType=rw\n",
    ));
    assert_eq!(type_name(&device, 0x6060, 0), "ModesOfOperation");
    assert_eq!(type_name(&device, 0x6061, 0), "ModesOfOperationU8");
    assert_eq!((item(&device, 0x6098, 0).ty, &item(&device, 0x6098, 0).documentation), (Type::Unsigned(16), &None));
}

#[test]
fn further_axes_are_completed_where_they_exist() {
    let axis = |index: &str, status: &str, mode: &str| {
        format!(
            "[{index}]\nParameterName=Control 2\nDataType=6\nAccessType=rw\n\
             [{status}]\nParameterName=Status 2\nDataType=6\nAccessType=ro\n\
             [{mode}]\nParameterName=Mode 2\nDataType=2\nAccessType=rw\n"
        )
    };
    let two = device(&drive(&axis("6840", "6841", "6860")));
    assert_eq!(type_name(&two, 0x6841, 0), "Statusword");
    assert_eq!(item(&two, 0x6840, 0).ty, item(&two, 0x6040, 0).ty);
    assert_eq!(type_name(&two, 0x6860, 0), "ModesOfOperation");
    // In a device without the controlword 0x6840, object 0x6860 does not belong to a second axis.
    let one = device(&drive(&axis("6842", "6843", "6860")));
    assert_eq!(type_name(&one, 0x6860, 0), "INTEGER8");
}

#[test]
fn devices_of_other_profiles_are_no_drives() {
    let other = drive("").replace("0x00020192", "0x00000198");
    assert_eq!(type_name(&device(&other), 0x6040, 0), "UNSIGNED16");
    assert_eq!(type_name(&device(&other), 0x1000, 0), "DeviceType", "for any profile");
    let untold = drive("").replace("0x00020192", "0");
    assert_eq!(type_name(&device(&untold), 0x6040, 0), "Controlword");
    // An object with a signed type is not a controlword.
    let numbers = untold.replace("Control\nDataType=6", "Control\nDataType=3");
    assert_eq!(type_name(&device(&numbers), 0x6040, 0), "INTEGER16");
    assert_eq!(type_name(&device(&numbers), 0x6060, 0), "INTEGER8");
}

#[test]
fn the_bus_decides_what_communication_objects_are() {
    let esi = |index: &str| {
        format!(
            "<EtherCATInfo><Vendor><Id>1</Id></Vendor><Descriptions><Devices><Device><Type ProductCode=\"1\" RevisionNo=\"1\">D</Type>\
             <Profile><Dictionary><DataTypes><DataType><Name>UDINT</Name><BitSize>32</BitSize></DataType>\
             <DataType><Name>USINT</Name><BitSize>8</BitSize></DataType><DataType><Name>DT1C00</Name><BitSize>24</BitSize>\
             <SubItem><SubIdx>0</SubIdx><Name>Number</Name><Type>USINT</Type><BitSize>8</BitSize><BitOffs>0</BitOffs></SubItem>\
             <SubItem><SubIdx>1</SubIdx><Name>SM 0</Name><Type>USINT</Type><BitSize>8</BitSize><BitOffs>16</BitOffs></SubItem>\
             </DataType></DataTypes><Objects><Object><Index>#x1C00</Index><Name>Types</Name><Type>DT1C00</Type><BitSize>24</BitSize></Object>\
             <Object><Index>#x{index}</Index><Name>O</Name><Type>UDINT</Type><BitSize>32</BitSize></Object></Objects></Dictionary></Profile>\
             </Device></Devices></Descriptions></EtherCATInfo>"
        )
    };
    let slave = catalog("d.xml", &esi("1000"), &Options::default()).devices.remove(0);
    assert_eq!(type_name(&slave, 0x1000, 0), "DeviceType");
    assert_eq!(type_name(&slave, 0x1C00, 1), "SyncManagerType");
    let slave = catalog("d.xml", &esi("1014"), &Options::default()).devices.remove(0);
    assert_eq!(item(&slave, 0x1014, 0).ty, Type::Unsigned(32), "no COB-ID on EtherCAT");
}

/// Returns the generated Rust of an EDS.
fn rust(text: &str, options: &Options) -> String {
    let compilation = check(Source::new("drive.eds", text.as_bytes().to_vec()), options);
    compilation.rust(&options.rust).unwrap_or_else(|| panic!("{:?}", compilation.diagnostics.list()))
}

#[test]
fn bindings_reexport_the_definitions_of_profiles() {
    let code = rust(&drive(""), &Options::default());
    for name in ["types::ModesOfOperation", "types::Controlword", "types::Statusword", "types::DeviceType"] {
        assert!(code.contains(&format!("pub use ::lexibus::profiles::{name};")), "{name} in {code}");
    }
    assert!(code.contains("pub use ::lexibus::profiles::codes::{"), "{code}");
    assert!(!code.contains("pub enum State") && !code.contains("pub enum DriveErrors"), "{code}");

    let mut options = Options::default();
    options.rust.runtime = "crate::rt".to_owned();
    let code = rust(&drive(""), &options);
    assert!(code.contains("pub use crate::rt::profiles::types::Controlword;"), "{code}");
}

#[test]
fn bindings_contain_definitions_of_profiles_that_the_runtime_does_not_contain() {
    // The options ask for a trait that the types of the runtime do not implement.
    let mut options = Options::default();
    options.rust.serde = Presence::Feature("serde".into());
    let code = rust(&drive(""), &options);
    assert!(!code.contains("profiles::types"), "{code}");
    assert!(code.contains("pub enum State") && code.contains("pub struct Controlword(u16);"), "{code}");

    // A type of the description has the name of the state type, so the states have another name. The bit fields with
    // methods for the states are then also in the bindings. The type of 0x6060 is not affected.
    let mut options = Options::default();
    let overlay = "lexibus = 1\n[overlay]\nwhy = \"names\"\n[[chapters]]\n[chapters.objects]\n\
        0x2000 = { enum = \"State\" }\n\
        [enums.State]\nbase = \"u8\"\n[enums.State.values]\n0 = \"off\"\n1 = \"on\"\n";
    options.overlays.push(Source::new("drive.overlay.toml", overlay.as_bytes().to_vec()));
    let object = "[2000]\nParameterName=State\nDataType=5\nAccessType=ro\n";
    let code = rust(&drive(object), &options);
    assert!(code.contains("pub enum DriveState") && code.contains("pub struct Controlword(u16);"), "{code}");
    assert!(code.contains("pub use ::lexibus::profiles::types::ModesOfOperation;"), "{code}");
}

#[test]
fn telegrams_of_profidrive_have_their_words() {
    let corpus = concat!(env!("CARGO_MANIFEST_DIR"), "/../../shared/corpus/gsdml");
    let name = "simatic-ax__ae-demo-rack__GSDML-V2.42-Siemens-Sinamics_S200-20240814.xml";
    let Ok(text) = std::fs::read_to_string(std::path::Path::new(corpus).join(name)) else {
        eprintln!("skipped: there is no {name} in {corpus}");
        return;
    };
    let catalog = catalog(name, &text, &Options::default());
    let mut typed = 0;
    for submodule in catalog.submodules.iter().filter(|submodule| submodule.name.starts_with("Standard telegram")) {
        let first = |data: &Option<Box<lexibus_codegen::ir::IoData>>| {
            let ty = data.as_ref()?.image.fields.first()?.ty;
            Some(definition(&catalog.types, ty).name.clone())
        };
        let number: u32 =
            submodule.name["Standard telegram ".len()..].split(',').next().and_then(|n| n.parse().ok()).unwrap();
        if (1..=4).contains(&number) {
            assert_eq!(first(&submodule.output).as_deref(), Some("STW1"), "{}", submodule.name);
            assert_eq!(first(&submodule.input).as_deref(), Some("ZSW1"), "{}", submodule.name);
            typed += 1;
        }
    }
    assert_eq!(typed, 3, "telegrams 1, 2 and 3");
}

/// Lints check only the description itself. Profiles are applied before the lints run, but must not change a diagnostic.
#[test]
fn profiles_change_no_diagnostic() {
    let mut levels = Levels::lenient();
    CODES.iter().for_each(|code| levels.set(code.id, Level::Warn).expect("a code"));
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../dictionaries");
    let drives = ["aec-vector-step.toml", "demo-drive.eds", "eco.toml", "kollmorgen-akd.toml"];
    let mut sources: Vec<Source> = drives.map(|name| Source::read(&folder.join(name)).expect(name)).into();
    for format in ["eds", "xdd", "esi", "gsdml"] {
        let files = corpus_support::files_of(format).into_iter().flatten();
        sources.extend(files.map(|file| Source::new(file.name.as_str(), file.bytes)));
    }
    corpus_support::bindings::on_all_processors(sources, |source| {
        let reported = |no_profiles| {
            let options = Options { levels: levels.clone(), no_profiles, ..Options::default() };
            let compilation = check(source.clone(), &options);
            let texts = compilation.diagnostics.list().iter().map(|found| format!("{found:?}"));
            texts.collect::<Vec<_>>()
        };
        assert_eq!(reported(true), reported(false), "{}", source.name());
    });
}
