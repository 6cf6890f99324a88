//! Tests the limit on copies of a text that many items share.

use std::path::PathBuf;

use lexibus_codegen::compile::{check, Compilation, Options};
use lexibus_codegen::limits;
use lexibus_codegen::source::Source;

fn read(name: &str, text: &str) -> Compilation {
    check(Source::new(name, text.as_bytes().to_vec()), &Options::default())
}

/// Asserts that a text was shortened with a single diagnostic and that the output is within the limit.
fn is_bounded(compilation: &Compilation) {
    let devices = compilation.catalog.iter().flat_map(|catalog| &catalog.devices);
    let items = devices.map(|device| 1 + device.groups.iter().map(|group| 1 + group.items.len()).sum::<usize>()).sum();
    is_bounded_by(compilation, items);
}

/// Asserts the same as `is_bounded`, with a limit for an output of `items` items.
fn is_bounded_by(compilation: &Compilation, items: usize) {
    let found = compilation.diagnostics.list().iter().filter(|found| found.code.id == "IO003").count();
    assert_eq!(found, 1, "{}", compilation.diagnostics.list().len());
    let made = serde_json::to_vec(&compilation.catalog).expect("a catalog").len();
    let given: usize = compilation.sources.iter().map(|source| source.text().len()).sum();
    // An item without texts, or with an empty text, takes a few hundred bytes of the output.
    let most = given * (limits::MAX_COPIES_PER_BYTE + 20) + items * 2_000;
    assert!(made < most, "{made} bytes from {given}");
}

/// Returns an ESI with the vendor name `vendor` and one device, which has the data types `types` and the objects
/// `objects`.
fn esi(vendor: &str, types: &str, objects: &str) -> String {
    format!(
        "<EtherCATInfo><Vendor><Id>1</Id><Name>{vendor}</Name></Vendor><Descriptions><Devices><Device Physics='YY'>\
         <Type ProductCode='1' RevisionNo='1'>T</Type><Name>T</Name><Profile><Dictionary><DataTypes>{types}</DataTypes>\
         <Objects>{objects}</Objects></Dictionary></Profile></Device></Devices></Descriptions></EtherCATInfo>"
    )
}

/// Returns a record type with `count` sub-items of one byte. Each sub-item contains the XML elements `elements`.
fn record(count: usize, elements: &str) -> String {
    let subs: String = (1..=count)
        .map(|at| {
            format!(
                "<SubItem><SubIdx>{at}</SubIdx><Name>S</Name><Type>USINT</Type><BitSize>8</BitSize><BitOffs>{}</BitOffs>\
                 {elements}</SubItem>",
                at * 8
            )
        })
        .collect();
    format!("<DataType><Name>R</Name><BitSize>{}</BitSize>{subs}</DataType>", count * 8 + 8)
}

fn object(index: usize, elements: &str) -> String {
    format!("<Object><Index>{index}</Index><Name>O</Name><Type>R</Type><BitSize>0</BitSize>{elements}</Object>\n")
}

fn long(letter: &str) -> String {
    letter.repeat(60_000)
}

#[test]
fn flags_of_an_object_for_its_entries() {
    let flags = format!("<Flags><Access WriteRestrictions='{}'>rw</Access></Flags>", long("PreOP_"));
    is_bounded(&read("flags.xml", &esi("V", &record(250, ""), &object(0x2000, &flags))));
}

#[test]
fn what_a_data_type_says_for_the_objects_of_it() {
    let objects: String = (0x2000..0x2800).map(|index| object(index, "")).collect();
    for elements in [
        format!("<DefaultString>{}</DefaultString>", long("d")),
        format!("<MaxValue>{}</MaxValue>", long("9")),
        format!("<Unit>{}</Unit>", long("u")),
        format!("<Flags><SafetyMapping>{}</SafetyMapping></Flags>", long("s")),
        "<Comment>x</Comment>".repeat(3_000),
    ] {
        is_bounded(&read("type.xml", &esi("V", &record(1, &elements), &objects)));
    }
}

#[test]
fn the_name_of_a_vendor_for_its_devices() {
    let device = "<Device><Type ProductCode='1'>T</Type></Device>";
    let text = esi(&long("v"), "", "").replace("<Devices>", &format!("<Devices>{}", device.repeat(5_000)));
    let compilation = read("vendor.xml", &text);
    is_bounded(&compilation);
    let devices = &compilation.catalog.as_ref().expect("a catalog").devices;
    assert!(devices.iter().all(|device| device.identity.vendor_id == Some(1)));
}

#[test]
fn mistakes_of_a_data_type_for_the_objects_of_it() {
    let objects: String = (0x2000..0x3000).map(|index| object(index, "")).collect();
    let subs = "<SubItem><SubIdx>300</SubIdx><Name>S</Name><Type>USINT</Type></SubItem>".repeat(1_000);
    let ty = format!("<DataType><Name>R</Name><BitSize>8</BitSize>{subs}</DataType>");
    let compilation = read("mistakes.xml", &esi("V", &ty, &objects));
    assert!(compilation.diagnostics.list().len() < 20_000, "{}", compilation.diagnostics.list().len());
}

#[test]
fn texts_of_a_message_for_its_languages() {
    let of = |languages: usize| {
        let names: String = (0..languages).map(|at| format!("<Description LcId='{at}'>a</Description>")).collect();
        read(
            "message.xml",
            &format!(
                "<EtherCATDiag><DiagMessages><DiagMessage><TextId>1</TextId>{names}<Info>{}</Info></DiagMessage>\
                 </DiagMessages></EtherCATDiag>",
                long("i")
            ),
        )
    };
    is_bounded(&of(5_000));
    let few = of(3);
    assert_eq!(few.diagnostics.list().len(), 0);
    let rows = &few.catalog.as_ref().expect("a catalog").code_tables[0].rows;
    assert_eq!(rows[0].documentation.as_ref().expect("texts").translations.len(), 2);
}

#[test]
fn the_header_of_a_gsdml_for_its_devices() {
    let (name, device) = (long("v"), "<DeviceAccessPointItem ID='D' PhysicalSlots='0' ModuleIdentNumber='1'/>");
    let text = format!(
        "<ISO15745Profile xmlns='http://www.profibus.com/GSDML/2003/11/DeviceProfile'><ProfileBody><DeviceIdentity VendorID='1' \
         DeviceID='1'><VendorName Value='{name}'/></DeviceIdentity><ApplicationProcess><DeviceAccessPointList>{}\
         </DeviceAccessPointList></ApplicationProcess></ProfileBody></ISO15745Profile>",
        device.repeat(2_000)
    );
    is_bounded(&read("GSDML-V2.35-V-D-20240101.xml", &text));
}

#[test]
fn the_name_of_an_object_for_the_entries_that_map_it() {
    let entries = "<Entry><Index>#x2000</Index><BitLen>8</BitLen></Entry>".repeat(5_000);
    let object = format!(
        "<Object><Index>#x2000</Index><Name>{}</Name><Type>USINT</Type><BitSize>8</BitSize></Object>",
        long("n")
    );
    let text = esi("V", "", &object)
        .replace("</Device>", &format!("<RxPdo Sm='2'><Index>#x1600</Index><Name>P</Name>{entries}</RxPdo></Device>"));
    let compilation = read("entries.xml", &text);
    let pdo = &compilation.catalog.as_ref().expect("a catalog").devices[0].process_data.pdos[0];
    assert!(pdo.entries.iter().all(|entry| entry.name.len() == 64));
}

#[test]
fn a_dictionary_for_many_devices() {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("shared-dictionary");
    std::fs::create_dir_all(&folder).expect("a folder for temporary files");
    let values: String = (0..5_000).map(|at| format!("<EnumInfo><Text>V</Text><Enum>{at}</Enum></EnumInfo>")).collect();
    let ty = format!("<DataType><Name>E</Name><BaseType>UINT</BaseType><BitSize>16</BitSize>{values}</DataType>");
    let dictionary = format!(
        "<EtherCATDict><Dictionary><DataTypes>{ty}</DataTypes><Objects><Object><Index>1</Index><Name>O</Name>\
         <Type>E</Type></Object></Objects></Dictionary></EtherCATDict>"
    );
    std::fs::write(folder.join("dict.xml"), dictionary).expect("a file");
    let device =
        "<Device><Type ProductCode='1'>T</Type><Profile><DictionaryFile>dict.xml</DictionaryFile></Profile></Device>";
    let of = |devices: usize| {
        let text = esi("V", "", "").replace("<Devices>", &format!("<Devices>{}", device.repeat(devices)));
        check(Source::new("main.xml", text.into_bytes()).in_folder(&folder), &Options::default())
    };
    let found = |compilation: &Compilation| compilation.diagnostics.list().iter().any(|one| one.code.id == "IO003");
    assert!(!found(&of(30)));
    let many = of(300);
    assert!(found(&many));
    let types =
        many.catalog.iter().flat_map(|catalog| &catalog.devices).map(|device| device.types.len()).sum::<usize>();
    assert!((30..60).contains(&types), "{types}");
}

#[test]
fn groups_of_a_parameter_for_the_objects_that_refer_to_it() {
    let groups = "<parameterRef uniqueIDRef='p'/>".repeat(3_000);
    let objects: String =
        (0x2000..0x3000).map(|index| format!("<CANopenObject index='{index:04X}' uniqueIDRef='p'/>")).collect();
    let text = format!(
        "<?xml version='1.0'?><ISO15745ProfileContainer xmlns='http://www.canopen.org/xml/1.0'><ISO15745Profile>\
         <ProfileBody><ApplicationProcess><parameterList><parameter uniqueID='p'><USINT/></parameter></parameterList>\
         <parameterGroupList><parameterGroup uniqueID='g'><label lang='en'>Motion</label>{groups}</parameterGroup>\
         </parameterGroupList></ApplicationProcess></ProfileBody></ISO15745Profile><ISO15745Profile><ProfileBody>\
         <ApplicationLayers><CANopenObjectList>{objects}</CANopenObjectList></ApplicationLayers></ProfileBody>\
         </ISO15745Profile></ISO15745ProfileContainer>"
    );
    is_bounded(&read("groups.xdd", &text));
}

fn table(rest: &str) -> String {
    format!("lexibus = 1\n[device]\nname = \"X\"\nbuses = [\"serial\"]\n[spaces.s]\nparameter = {{}}\n{rest}")
}

#[test]
fn long_rows_that_stand_for_many_items() {
    let values: String = (0..1_000).map(|at| format!("{at} = \"v{at}\", ")).collect();
    for (name, keys) in [
        ("a".to_owned(), format!("enum = {{ {values} }}")),
        ("a".to_owned(), format!("doc = \"{}\"", long("d"))),
        ("a".to_owned(), "writable = [\"0..1000\"]".to_owned()),
        (long("n"), "doc = \"d\"".to_owned()),
    ] {
        let row = format!(
            "[[chapters]]\nspace = \"s\"\n[chapters.registers]\n\
             \"{name} {{n}}\" = {{ reg = 0, count = 65535, type = \"u16\", access = \"rw\", {keys} }}\n"
        );
        is_bounded_by(&read("rows.toml", &table(&row)), limits::MAX_DERIVED_ITEMS);
        let objects = format!(
            "[[chapters]]\n[chapters.objects]\n\"0x1000..0xFFFF\" = {{ name = \"{name}\", type = \"u16\", access = \"ro\", {keys} }}\n"
        );
        let compilation = read("objects.toml", &table(&objects).replace("serial", "canopen"));
        is_bounded_by(&compilation, limits::MAX_DERIVED_ITEMS);
    }
}

#[test]
fn long_defaults_and_units_for_many_rows() {
    let rows = |keys: &str| -> String {
        (0..10_000).map(|at| format!("a{at} = {{ reg = {at}, type = \"u16\", access = \"ro\"{keys} }}\n")).collect()
    };
    let na = format!("na = {{ 7 = \"{}\" }}\n", long("n"));
    let is_bounded = |text: &str| {
        let compilation = read("rows.toml", text);
        assert_eq!(compilation.diagnostics.list().iter().filter(|found| found.code.id == "IO003").count(), 1);
        let devices = compilation.catalog.iter().flat_map(|catalog| &catalog.devices);
        let items: Vec<_> = devices.flat_map(|device| &device.groups).flat_map(|group| &group.items).collect();
        let quantities = items.iter().filter_map(|item| item.quantity.as_deref());
        let copies =
            quantities.filter(|quantity| quantity.unit.len() > 1_000 || !quantity.sentinels.is_empty()).count();
        assert_eq!(items.len(), 10_000);
        assert!((2_000..9_000).contains(&copies), "{copies}");
    };
    for defaults in [
        format!("[defaults]\n{na}[[chapters]]\nspace = \"s\"\n"),
        format!("[[chapters]]\nspace = \"s\"\ndefaults = {{ {} }}\n", na.trim()),
    ] {
        is_bounded(&table(&format!("{defaults}[chapters.registers]\n{}", rows(""))));
    }
    let unit = format!("[units.u]\nsymbol = \"{}\"\n[[chapters]]\nspace = \"s\"\n[chapters.registers]\n", long("u"));
    is_bounded(&table(&(unit + &rows(", unit = \"u\""))));
}
