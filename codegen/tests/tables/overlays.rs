//! Tests overlays: which facts they change or keep, and which errors they cause.

use lexibus_codegen::compile::{check, Compilation, Options};
use lexibus_codegen::facts::doubts;
use lexibus_codegen::ir::{Access, Device, Fact, FactOrigin, Item, OverlayOrigin, Shape, Type, Value};
use lexibus_codegen::limits;
use lexibus_codegen::source::Source;
use lexibus_codegen::Builder;

const EDS: &str = "[DeviceInfo]\nVendorNumber=0x6A\nProductName=Pump 3\nProductNumber=7\nRevisionNumber=2\n\
    [1018]\nParameterName=Identity\nObjectType=9\nSubNumber=2\n\
    [1018sub0]\nParameterName=Entries\nDataType=5\nAccessType=ro\nDefaultValue=1\n\
    [1018sub1]\nParameterName=Vendor\nDataType=7\nAccessType=ro\nDefaultValue=0x6A\n\
    [2000]\nParameterName=Speed\nDataType=6\nAccessType=rw\nDefaultValue=5\n\
    [2001]\nParameterName=Mode\nDataType=5\nAccessType=rw\n\
    [2002]\nParameterName=Flags\nDataType=6\nAccessType=ro\n\
    [2003]\nParameterName=Name\nDataType=9\nAccessType=const\n\
    [2010]\nParameterName=Gains\nObjectType=8\nSubNumber=3\n\
    [2010sub0]\nParameterName=Entries\nDataType=5\nAccessType=ro\nDefaultValue=2\n\
    [2010sub1]\nParameterName=P\nDataType=6\nAccessType=rw\n\
    [2010sub2]\nParameterName=I\nDataType=6\nAccessType=rw\n";

const HEAD: &str = "lexibus = 1\n[overlay]\nwhy = \"as the manual has it\"\n[[chapters]]\n";

fn apply(text: &str) -> Compilation {
    apply_to("pump.eds", EDS, text)
}

fn apply_to(name: &str, description: &str, text: &str) -> Compilation {
    let overlays = vec![Source::new("pump.overlay.toml", text.as_bytes().to_vec())];
    let options = Options { overlays, no_profiles: true, ..Options::default() };
    check(Source::new(name, description.as_bytes().to_vec()), &options)
}

fn rows(rows: &str) -> String {
    format!("{HEAD}[chapters.objects]\n{rows}")
}

fn device(compilation: &Compilation) -> &Device {
    &compilation.catalog.as_ref().expect("a catalog").devices[0]
}

fn item(compilation: &Compilation, index: u16, sub: u8) -> &Item {
    device(compilation).entry(index, sub).unwrap_or_else(|| panic!("0x{index:04X}:{sub} exists"))
}

/// Returns the codes of the diagnostics in the overlay, each with the text that the diagnostic marks.
fn findings(compilation: &Compilation) -> Vec<(&'static str, String)> {
    let diagnostics = compilation.diagnostics.list().iter().filter(|finding| finding.span.file.0 == 1);
    diagnostics
        .map(|finding| (finding.code.id, compilation.sources[1].text()[finding.span.range()].to_owned()))
        .collect()
}

fn words(item: &Item) -> &str {
    item.documentation.as_ref().map_or("", |documentation| &*documentation.text)
}

#[test]
fn a_row_changes_what_it_says_and_nothing_else() {
    let text = rows(
        "0x2000 = { unit = \"rpm\", min = 1, max = 3000, why = \"page 12\" }\n\
         \"0x2010:1..2\" = { type = \"i16\", name = \"Gain {sub}\", doc = \"A gain.\" }\n",
    );
    let compilation = apply(&text);
    assert_eq!(findings(&compilation), []);
    let before = apply(HEAD);
    let (old, new) = (item(&before, 0x2000, 0), item(&compilation, 0x2000, 0));
    assert_eq!(new.quantity.as_ref().expect("a unit").unit, "rpm");
    assert_eq!((&new.limits.low, &new.limits.high), (&Some(Value::Int(1)), &Some(Value::Int(3000))));
    assert_eq!((&new.name, new.ty, new.access, &new.default), (&old.name, old.ty, old.access, &old.default));
    assert_eq!((new.origin, new.at.name, new.at.ty), (old.origin, old.at.name, old.at.ty));
    assert_eq!(words(new), "Changed by an overlay: page 12.");
    let (file, why) = ("pump.overlay.toml".into(), "page 12".into());
    let origin = FactOrigin::Overlay(Box::new(OverlayOrigin { file, line: 6, replaces: false, why }));
    assert_eq!((new.origins.get(Fact::Unit), new.origins.get(Fact::Type)), (Some(&origin), None));
    assert_eq!(&compilation.sources[1].text()[new.at.others.low.range()], "1", "the limit comes from the overlay");
    let gain = item(&compilation, 0x2010, 2);
    assert_eq!((gain.name.as_str(), gain.ty), ("Gain 2", Type::Integer(16)));
    assert_eq!(words(gain), "A gain.\nChanged by an overlay: as the manual has it.");
    assert_eq!(compilation.catalog.as_ref().map(|catalog| catalog.files.len()), Some(2));
    let rust = compilation.rust(&Options::default().rust).expect("bindings");
    assert!(rust.contains("Changed by an overlay: page 12."), "the generated documentation states the reason");
}

#[test]
fn bits_and_values_get_their_names() {
    let text = rows("0x2001 = { enum = \"Mode\" }\n0x2002 = { bits = { 0 = \"on\", \"3-1\" = { name = \"phase\", number = true } } }\n")
        + "[enums.Mode.values]\n0 = \"off\"\n1 = \"on\"\n";
    let compilation = apply(&text);
    assert_eq!(findings(&compilation), []);
    let shape = |index| match item(&compilation, index, 0).ty {
        Type::Named(id) => &device(&compilation).types[id.0 as usize].shape,
        ty => panic!("{ty}"),
    };
    assert!(matches!(shape(0x2001), Shape::Enumeration { base: Type::Unsigned(8), values, .. } if values.len() == 2));
    assert!(matches!(shape(0x2002), Shape::BitField { base: Type::Unsigned(16), fields } if fields.len() == 2));
    let rust = compilation.rust(&Options::default().rust).expect("bindings");
    assert!(rust.contains("pub enum Mode"), "{rust}");
}

#[test]
fn items_go_by_name_too() {
    let text = format!("{HEAD}[chapters.registers]\nSpeed = {{ unit = \"rpm\" }}\n\"Gains/I\" = {{ unit = \"ms\" }}\n");
    let compilation = apply(&text);
    assert_eq!(findings(&compilation), []);
    assert_eq!(item(&compilation, 0x2010, 2).quantity.as_ref().expect("a unit").unit, "ms");
    let text = format!("{HEAD}[chapters.registers]\nEntries = {{ unit = \"rpm\" }}\nSped = {{ unit = \"rpm\" }}\n");
    let compilation = apply(&text);
    assert_eq!(findings(&compilation), [("TAB006", "Entries".to_owned()), ("TAB030", "Sped".to_owned())]);
    let help = compilation
        .diagnostics
        .list()
        .iter()
        .find(|found| found.code.id == "TAB030")
        .and_then(|diagnostic| diagnostic.help.clone());
    assert_eq!(help.as_deref(), Some("did you mean `Speed`?"));
}

#[test]
fn what_matches_or_changes_nothing_is_told() {
    let text = rows(
        "0x2100 = { unit = \"rpm\" }\n0x2000 = { type = \"u16\", access = \"rw\", default = 5 }\n\"0x2010:9\" = { remove = true }\n\
         0x2001 = { add = true, type = \"u8\", access = \"rw\" }\n\"0x1018:1\" = { name = \"Vendor\" }\n",
    );
    let expected = [("TAB030", "0x2100"), ("TAB031", "0x2000"), ("TAB030", "\"0x2010:9\""), ("TAB031", "0x2001")];
    let mut expected: Vec<_> = expected.map(|(code, mark)| (code, mark.to_owned())).to_vec();
    expected.push(("TAB031", "\"0x1018:1\"".to_owned()));
    assert_eq!(findings(&apply(&text)), expected);
    let unused = rows("0x2000 = { unit = \"rpm\" }\n")
        + "[enums.Nobody.values]\n0 = \"x\"\n[units]\nlost = { symbol = \"m\" }\n";
    let expected = [("TAB030", "Nobody".to_owned()), ("TAB030", "lost".to_owned())];
    assert_eq!(findings(&apply(&unused)), expected);
}

#[test]
fn objects_are_added_and_removed() {
    let text = rows(
        "0x2003 = { remove = true, why = \"it was never there\" }\n\"0x2010:2\" = { remove = true }\n\
         0x2005 = { add = true, name = \"Temperature\", type = \"i16\", access = \"ro\", unit = \"°C\" }\n\
         \"0x2010:5\" = { add = true, name = \"D\", type = \"u16\", access = \"rw\" }\n",
    );
    let compilation = apply(&text);
    assert_eq!(findings(&compilation), []);
    let device = device(&compilation);
    assert!(device.object(0x2003).is_none() && device.entry(0x2010, 2).is_none());
    assert!(device
        .extensions
        .iter()
        .any(|extension| extension.key == "overlay/removed 0x2003" && extension.value == "it was never there"));
    let added = item(&compilation, 0x2005, 0);
    assert_eq!((added.name.as_str(), added.ty, added.access), ("Temperature", Type::Integer(16), Access::ReadOnly));
    assert_eq!(words(added), "Added by an overlay: as the manual has it.");
    let is_of_overlay = |origin: Option<&FactOrigin>| matches!(origin, Some(FactOrigin::Overlay(row)) if !row.replaces);
    assert!([Fact::Name, Fact::Type, Fact::Access].iter().all(|fact| is_of_overlay(added.origins.get(*fact))));
    assert!(is_of_overlay(device.object(0x2005).expect("the object").origins.get(Fact::Name)));
    assert_eq!(item(&compilation, 0x2010, 5).name, "D");
    assert_eq!(words(item(&compilation, 0x2010, 1)), "", "the next sub-index is unchanged");
    assert!(device.groups.is_sorted_by_key(|group| group.index()));
    compilation.rust(&Options::default().rust).expect("bindings");
}

#[test]
fn tables_of_the_device_are_added_or_replaced() {
    let text = rows("0x2000 = { unit = \"rpm\" }\n")
        + "[codes.alarm.rows]\n1 = { name = \"hot\", doubt = { says = \"d\", chose = \"e\", why = \"f\" } }\n\
           [machines.pump]\ndoubt = { says = \"g\", chose = \"h\", why = \"i\" }\nstatus = \"0x2002\"\ncontrol = \"Mode\"\n[machines.pump.states]\noff = { mask = 1, value = 0 }\n\
           [procedures.start]\nsteps = [{ write = \"Mode\", value = 1 }]\n\
           [[doubts]]\nsays = \"a\"\nchose = \"b\"\nwhy = \"c\"\n";
    let compilation = apply(&text);
    assert_eq!(findings(&compilation), []);
    let device = device(&compilation);
    assert_eq!((device.code_tables.len(), device.procedures.len(), device.doubts.len()), (1, 1, 1));
    assert_eq!((device.code_tables[0].doubts.len(), device.machines[0].doubts.len()), (1, 1));
    assert_eq!(device.machines[0].status_item, "Flags", "an object refers to its item");
    // A second overlay with the same names replaces the rows and machines of the first.
    let first = Source::new("a.toml", text.as_bytes().to_vec());
    let more = "lexibus = 1\n[overlay]\n[codes.alarm.rows]\n1 = \"too hot\"\n\
                2 = { name = \"cold\", doubt = { says = \"j\", chose = \"k\", why = \"l\" } }\n[machines.pump]\nstatus = \"Flags\"\n";
    let second = Source::new("b.toml", more.as_bytes().to_vec());
    let options = Options { overlays: vec![first, second], no_profiles: true, ..Options::default() };
    let compilation = check(Source::new("pump.eds", EDS.into()), &options);
    assert!(!compilation.diagnostics.has_errors());
    let device = self::device(&compilation);
    let names: Vec<&str> = device.code_tables[0].rows.iter().map(|row| row.name.as_str()).collect();
    assert_eq!((names, device.machines.len()), (vec!["too hot", "cold"], 1));
    let origin = |origin: &Option<Box<FactOrigin>>| match origin.as_deref() {
        Some(FactOrigin::Overlay(row)) => (row.file.to_string(), row.replaces),
        other => panic!("{other:?}"),
    };
    let table = &device.code_tables[0];
    let parts: Vec<&str> = table.doubts.iter().map(|doubt| doubt.part.as_str()).collect();
    assert_eq!((parts, device.machines[0].doubts.len()), (vec!["1", "2"], 0), "a machine is replaced with its doubts");
    assert_eq!(origin(&table.stated_by), ("a.toml".to_owned(), false));
    let rows: Vec<_> = table.rows.iter().map(|row| origin(&row.stated_by)).collect();
    assert_eq!(rows, [("b.toml".to_owned(), true), ("b.toml".to_owned(), false)]);
    assert_eq!(origin(&device.machines[0].stated_by), ("b.toml".to_owned(), true));
    let rust = compilation.rust(&Options::default().rust).expect("bindings");
    assert!(rust.contains("Definition from overlay b.toml:3 instead of the description."), "{rust}");
    assert!(device.machines[0].states.is_empty());
    // A state machine that exceeds a limit must not replace the state machine with the same name.
    let states: String =
        (0..limits::MAX_MACHINE_ROWS).map(|at| format!("s{at} = {{ mask = 0xFFFF, value = {at} }}\n")).collect();
    let huge = format!("lexibus = 1\n[overlay]\n[machines.pump]\nstatus = \"Flags\"\n[machines.pump.states]\n{states}");
    let overlays = [text.as_str(), &huge].map(|text| Source::new("o.toml", text.as_bytes().to_vec()));
    let options = Options { overlays: overlays.into(), no_profiles: true, ..Options::default() };
    let compilation = check(Source::new("pump.eds", EDS.into()), &options);
    let codes: Vec<_> = compilation.diagnostics.list().iter().map(|found| found.code.id).collect();
    assert!(codes.contains(&"IO003"), "{codes:?}");
    let kept: Vec<_> =
        self::device(&compilation).machines.iter().map(|machine| machine.states[0].name.as_str()).collect();
    assert_eq!(kept, ["off"]);
}

#[test]
fn mistakes_are_told_at_their_place() {
    let cases: [(String, &str, &str); 9] = [
        (rows("0x2000 = { unti = \"rpm\" }\n"), "TAB003", "unti"),
        (rows("x2000 = { unit = \"rpm\" }\n"), "TAB006", "x2000"),
        (rows("0x1018 = { type = \"u8\" }\n"), "TAB006", "0x1018"),
        (rows("0x2000 = { enum = \"None\" }\n"), "TAB005", "\"None\""),
        (rows("0x2003 = { bits = { 0 = \"on\" } }\n"), "TAB004", "{ 0 = \"on\" }"),
        (rows("0x2000 = { bits = \"B\" }\n") + "[bits.B]\nbase = \"u32\"\nat = { 0 = \"x\" }\n", "TAB004", "\"B\""),
        (rows("0x2000 = { add = true, remove = true }\n"), "TAB004", "0x2000"),
        (rows("0x2000 = { when = { Nothing = [1] } }\n"), "TAB005", "Nothing"),
        (
            "lexibus = 1\n[overlay]\n[[chapters]]\n[chapters.objects]\n0x2000 = { unit = \"rpm\" }\n".into(),
            "TAB004",
            "0x2000",
        ),
    ];
    for (text, code, mark) in cases {
        let compilation = apply(&text);
        assert_eq!(findings(&compilation), [(code, mark.to_owned())], "{text}");
        assert!(compilation.diagnostics.has_errors());
    }
    let compilation = apply(&format!("{HEAD}[spaces.x]\nbits = 8\n"));
    assert_eq!(findings(&compilation).first().map(|(code, _)| *code), Some("TAB003"), "an overlay has no spaces");
    let compilation = apply("lexibus = 1\n[device]\nname = \"x\"\n");
    let mut messages = compilation.diagnostics.list().iter().map(|finding| finding.message.as_str());
    assert!(messages.any(|message| message == "the table has no `[overlay]`"));
    let input = check(Source::new("o.toml", HEAD.into()), &Options::default());
    assert!(input.diagnostics.list()[0].help.as_deref().is_some_and(|help| help.contains("--overlay")));
}

#[test]
fn an_overlay_is_for_some_devices() {
    let with = |applies: &str| {
        let text = format!(
            "lexibus = 1\n[overlay]\nwhy = \"w\"\nfor = {{ {applies} }}\n[[chapters]]\n[chapters.objects]\n0x2000 = {{ unit = \"rpm\" }}\n"
        );
        let compilation = apply(&text);
        (
            item(&compilation, 0x2000, 0).quantity.is_some(),
            findings(&compilation).iter().map(|(code, _)| *code).collect(),
        )
    };
    let none: Vec<&str> = Vec::new();
    for fits in [
        "vendor_id = 0x6A",
        "product_code = 7, revision = 2",
        "device = \"pump*\"",
        "vendor_id = 0x6A, device = \"*3\"",
    ] {
        assert_eq!(with(fits), (true, none.clone()), "{fits}");
    }
    for other in ["vendor_id = 1", "product_code = 7, revision = 3", "device = \"valve*\"", "module = \"*\""] {
        assert_eq!(with(other), (false, vec!["TAB032"]), "{other}");
    }
}

const ESI: &str = "<EtherCATInfo><Vendor><Id>1</Id></Vendor><Descriptions><Devices>\
    <Device><Type ProductCode=\"1\" RevisionNo=\"1\">A</Type>DICT</Device>\
    <Device><Type ProductCode=\"2\" RevisionNo=\"1\">B</Type>DICT\
    <Slots><Slot MinInstances=\"0\" MaxInstances=\"1\"><ModuleIdent>#x10</ModuleIdent></Slot></Slots></Device>\
    </Devices><Modules><Module><Type ModuleIdent=\"#x10\">M</Type><Name>Analogue in</Name>DICT</Module></Modules>\
    </Descriptions></EtherCATInfo>";

const DICTIONARY: &str =
    "<Profile><Dictionary><DataTypes><DataType><Name>UINT</Name><BitSize>16</BitSize></DataType></DataTypes>\
    <Objects><Object><Index>#x2000</Index><Name>Value</Name><Type>UINT</Type><BitSize>16</BitSize></Object></Objects>\
    </Dictionary></Profile>";

#[test]
fn several_devices_and_modules_are_told_apart() {
    let esi = ESI.replace("DICT", DICTIONARY);
    let text = rows("0x2000 = { unit = \"V\", scale = 0.01, nonsense = 1 }\n");
    let compilation = apply_to("x.xml", &esi, &text);
    assert_eq!(findings(&compilation).len(), 1, "an error is reported once for both devices");
    let unit =
        |item: Option<&Item>| item.and_then(|item| item.quantity.as_ref()).map(|quantity| quantity.unit.to_string());
    let catalog = compilation.catalog.as_ref().expect("a catalog");
    assert!(catalog.devices.iter().all(|device| unit(device.entry(0x2000, 0)).as_deref() == Some("V")));
    let of_module = |compilation: &Compilation| {
        let module = &compilation.catalog.as_ref().expect("a catalog").modules[0];
        unit(module.groups.iter().find(|group| group.index() == Some(0x2000)).and_then(|group| group.items.first()))
    };
    assert_eq!(of_module(&compilation), None);
    let text = text.replace(", nonsense = 1", "");
    for module in ["module = \"analogue*\"", "module = \"M\"", "module = \"0x10\"", "module = \"M\", product_code = 2"]
    {
        let text = text.replace("why =", &format!("for = {{ {module} }}\nwhy ="));
        let compilation = apply_to("x.xml", &esi, &text);
        assert_eq!((of_module(&compilation).as_deref(), findings(&compilation)), (Some("V"), vec![]), "{module}");
    }
    let text = text.replace("why =", "for = { module = \"M\", product_code = 1 }\nwhy =");
    assert_eq!(findings(&apply_to("x.xml", &esi, &text)).len(), 1, "the first device accepts no module");
}

#[test]
fn names_within_a_module_are_those_of_its_items() {
    let esi = ESI.replace("DICT", DICTIONARY);
    let applied = |row: &str| {
        let text = rows(row).replacen("why =", "for = { module = \"M\" }\nwhy =", 1);
        apply_to("x.xml", &esi, &text)
    };
    let typo = applied("0x2000 = { unit = \"V\", same_as = \"Valu\" }\n");
    assert_eq!(findings(&typo), [("TAB005", "\"Valu\"".to_owned())]);
    let doubt = "doubt = { says = \"V and mV\", chose = \"V\", why = \"the scale\" }";
    let actual = applied(&format!("0x2000 = {{ enum = \"E\" }}\n[enums.E]\n{doubt}\nvalues = {{ 0 = \"off\" }}\n"));
    assert_eq!(findings(&actual), []);
    let catalog = actual.catalog.as_ref().expect("a catalog");
    let doubts = catalog.devices.iter().map(|device| doubts::of_device(catalog, device).len());
    assert_eq!(doubts.collect::<Vec<_>>(), [0, 1], "the device that accepts the module lists the doubts of its types");
    let rust = actual.rust(&Options::default().rust).expect("bindings");
    assert!(rust.contains("Note: V and mV. Assumed: V (the scale)."), "the type of the module shows its doubts");
}

#[test]
fn an_overlay_for_a_module_has_doubts_and_no_behavior() {
    let esi = ESI.replace("DICT", DICTIONARY);
    let applied = |more: &str| {
        let text =
            rows("0x2000 = { unit = \"V\", scale = 1 }\n").replacen("why =", "for = { module = \"M\" }\nwhy =", 1);
        apply_to("x.xml", &esi, &format!("{text}{more}"))
    };
    let doubtful = applied("[[doubts]]\nsays = \"V and mV\"\nchose = \"V\"\nwhy = \"the scale\"\n");
    assert_eq!(findings(&doubtful), []);
    let devices = &doubtful.catalog.as_ref().expect("a catalog").devices;
    let doubts: Vec<usize> = devices.iter().map(|device| device.doubts.len()).collect();
    assert_eq!(doubts, [0, 1], "the device that accepts the module has its doubts");
    let behavior = [
        ("[axes]\ncount = 2\n", ""),
        ("[codes.Faults]\nrows = { 1 = \"Short\" }\n", "Faults"),
        (
            "[machines.Main]\nstatus = \"0x2000\"\ncontrol = \"0x2000\"\nstates = { Off = { mask = 1, value = 0 } }\n",
            "Main",
        ),
        ("[procedures.Home]\ndoc = \"It goes home.\"\n", "Home"),
    ];
    for (table, name) in behavior {
        let found = findings(&applied(table));
        assert_eq!(found.len(), 1, "{table}: {found:?}");
        assert_eq!(found[0].0, "TAB004", "{table}");
        assert!(found[0].1.contains(name), "{table}: {found:?}");
    }
}

/// Returns a device access point that accepts the submodules `S` and `T`.
fn access_point(name: &str, number: u32) -> String {
    format!(
        "<DeviceAccessPointItem ID=\"{name}\" ModuleIdentNumber=\"{number}\" PhysicalSlots=\"0..4\" FixedInSlots=\"0\">\
         <ModuleInfo><Name TextId=\"{name}\"/></ModuleInfo><UseableSubmodules>\
         <SubmoduleItemRef SubmoduleItemTarget=\"S\" AllowedInSubslots=\"2\"/>\
         <SubmoduleItemRef SubmoduleItemTarget=\"T\" AllowedInSubslots=\"3\"/></UseableSubmodules>\
         </DeviceAccessPointItem>"
    )
}

/// Returns a GSDML with two device access points and two submodules that have one parameter each.
fn gsdml() -> String {
    let submodule = |id: &str, number: u32, parameter: &str| {
        format!(
            "<SubmoduleItem ID=\"{id}\" SubmoduleIdentNumber=\"{number}\"><IOData/><RecordDataList>\
             <ParameterRecordDataItem Index=\"10\" Length=\"2\"><Name TextId=\"{id}\"/>\
             <Ref DataType=\"Unsigned16\" ByteOffset=\"0\" DefaultValue=\"5\" TextId=\"{parameter}\"/>\
             </ParameterRecordDataItem></RecordDataList><ModuleInfo><Name TextId=\"{id}\"/></ModuleInfo></SubmoduleItem>"
        )
    };
    let texts: String = ["A", "B", "S", "T", "Speed", "Limit"]
        .map(|text| format!("<Text TextId=\"{text}\" Value=\"{text}\"/>"))
        .concat();
    let (a, b) = (access_point("A", 1), access_point("B", 2));
    let (s, t) = (submodule("S", 1, "Speed"), submodule("T", 2, "Limit"));
    format!(
        "<?xml version=\"1.0\"?><ISO15745Profile xmlns=\"http://www.profibus.com/GSDML/2003/11/DeviceProfile\"><ProfileBody>\
         <DeviceIdentity VendorID=\"1\" DeviceID=\"1\"><VendorName Value=\"Maker\"/></DeviceIdentity><ApplicationProcess>\
         <DeviceAccessPointList>{a}{b}</DeviceAccessPointList><SubmoduleList>{s}{t}</SubmoduleList>\
         <ExternalTextList><PrimaryLanguage>{texts}</PrimaryLanguage></ExternalTextList></ApplicationProcess>\
         </ProfileBody></ISO15745Profile>"
    )
}

#[test]
fn a_submodule_of_several_devices_is_changed_once() {
    let applied = |applies: &str, row: &str| {
        let text = format!(
            "lexibus = 1\n[overlay]\nwhy = \"w\"\n{applies}[[chapters]]\n[chapters.registers]\nSpeed = {{ {row} }}\n"
        );
        apply_to("GSDML-x.xml", &gsdml(), &text)
    };
    let speed = |compilation: &Compilation| {
        let catalog = compilation.catalog.as_ref().expect("a catalog");
        assert_eq!((catalog.devices.len(), catalog.submodules.len()), (2, 2));
        catalog.submodules[0].records[0].items[0].clone()
    };
    let doubt = "doubt = { says = \"a and b\", chose = \"a\", why = \"c\" }";
    let both = applied("", &format!("doc = \"Told.\", na = {{ 0 = \"off\" }}, {doubt}"));
    assert_eq!(findings(&both), []);
    let item = speed(&both);
    assert_eq!((words(&item), item.doubts.len()), ("Told.\nChanged by an overlay: w.", 1));
    let origin = item.origins.get(Fact::Description);
    assert!(matches!(origin, Some(FactOrigin::Overlay(row)) if row.why == "w"), "{origin:?}");
    let one = applied("for = { device = \"A\" }\n", "unit = \"rpm\"");
    let found: Vec<_> = findings(&one).into_iter().map(|(code, _)| code).collect();
    assert_eq!((found, speed(&one).quantity.is_some()), (vec!["TAB053"], true), "B also has the description");
    // An unknown name must be reported. The compiler must not search for the name in another submodule.
    let typo = applied("", "same_as = \"Sped\"");
    assert_eq!(findings(&typo), [("TAB005", "\"Sped\"".to_owned())]);
    assert_eq!(findings(&applied("", "same_as = \"Speed\"")), []);
}

#[test]
fn a_corrected_type_is_what_process_data_have() {
    let eds = format!(
        "{EDS}[1A00]\nParameterName=Mapping\nObjectType=9\nSubNumber=2\n\
         [1A00sub0]\nParameterName=n\nDataType=5\nAccessType=ro\nDefaultValue=1\n\
         [1A00sub1]\nParameterName=e\nDataType=7\nAccessType=ro\nDefaultValue=0x20020010\n"
    );
    let compilation = apply_to("pump.eds", &eds, &rows("0x2002 = { type = \"i16\", pdo = \"tx\" }\n"));
    assert_eq!(device(&compilation).process_data.pdos[0].entries[0].ty, Type::Integer(16));
}

#[test]
fn parameters_of_profinet_go_by_name() {
    let gsdml = std::fs::read_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/../../shared/corpus/gsdml"));
    let Ok(files) = gsdml else {
        eprintln!("skipped: there is no corpus");
        return;
    };
    let options = Options { no_profiles: true, ..Options::default() };
    let mut tried = 0;
    for path in
        files.filter_map(|file| Some(file.ok()?.path())).filter(|path| path.extension().is_some_and(|e| e == "xml"))
    {
        let source = Source::read(&path).expect("a file of the corpus");
        let compilation = check(source.clone(), &options);
        let Some(catalog) = compilation.catalog.as_ref() else { continue };
        let unique = |submodule: &&lexibus_codegen::ir::Submodule| {
            !submodule.id.is_empty() && submodule.records.len() == 1 && submodule.records[0].items.len() == 1
        };
        let Some(submodule) = catalog.submodules.iter().find(unique) else { continue };
        let (item, id) = (&submodule.records[0].items[0], submodule.id.clone());
        if item.name.contains(['"', '\\', '/']) || id.contains(['"', '\\', '*']) || item.name.is_empty() {
            continue;
        }
        let text = format!(
            "lexibus = 1\n[overlay]\nwhy = \"w\"\nfor = {{ module = \"{id}\" }}\n[[chapters]]\n[chapters.registers]\n\"{}\" = {{ doc = \"Told.\" }}\n",
            item.name
        );
        let overlays = vec![Source::new("o.toml", text.clone().into_bytes())];
        let compilation = check(source, &Options { overlays, ..options.clone() });
        let changed =
            compilation.catalog.as_ref().expect("a catalog").submodules.iter().find(|submodule| submodule.id == id);
        let is_changed = changed.is_some_and(|entry| words(&entry.records[0].items[0]).starts_with("Told.\nChanged"));
        assert!(is_changed, "{}: {text}\n{:?}", path.display(), findings(&compilation));
        tried += 1;
    }
    assert!(tried > 5, "only {tried} submodules with one parameter");
}

#[test]
fn the_builder_takes_overlays() {
    let folder = std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join("overlay-builder");
    std::fs::create_dir_all(&folder).expect("a folder");
    let (input, overlay) = (folder.join("pump.eds"), folder.join("pump.toml"));
    std::fs::write(&input, EDS).expect("the description");
    std::fs::write(&overlay, rows("0x2000 = { unit = \"rpm\" }\n")).expect("the overlay");
    let builder = Builder::new().quiet();
    let text = builder.clone().overlay(&overlay).generate(&input).expect("bindings");
    assert!(text.contains("Unit rpm") && !builder.generate(&input).expect("bindings").contains("Unit rpm"));
    let missing = builder.overlay(folder.join("none.toml")).generate(&input).expect_err("no such file");
    assert!(missing.to_string().contains("none.toml"), "{missing}");
}

#[test]
fn an_overlay_changes_no_lints_of_the_rest() {
    // The device has two objects with the name `Speed`. For an EDS, TAB040 reports them only if the level of TAB040 is set.
    let eds = EDS.replace("DataType=6\nAccessType=ro\n", "DataType=6\nAccessType=ro\nPDOMapping=1\n");
    let eds = eds.replace("ParameterName=Mode", "ParameterName=Speed");
    let alone =
        check(Source::new("pump.eds", eds.as_bytes().to_vec()), &Options { no_profiles: true, ..Options::default() });
    let with = apply_to("pump.eds", &eds, &rows("0x2000 = { unit = \"rpm\" }\n"));
    let codes =
        |found: &Compilation| found.diagnostics.list().iter().map(|diagnostic| diagnostic.code.id).collect::<Vec<_>>();
    assert_eq!(codes(&alone), codes(&with));
    let mut options = Options { no_profiles: true, ..Options::default() };
    options.levels.set("TAB040", lexibus_codegen::diagnostics::Level::Warn).unwrap();
    let asked = check(Source::new("pump.eds", eds.into_bytes()), &options);
    assert_eq!(codes(&asked).iter().filter(|code| **code == "TAB040").count(), 1);
}

#[test]
fn findings_about_what_an_overlay_said_are_in_the_overlay() {
    let text = rows("0x2000 = { min = 1, max = 9, same_as = \"Mode\" }\n0x2001 = { min = 2, max = 9 }\n");
    let found = findings(&apply(&text));
    assert_eq!(found, [("TAB022", "\"Mode\"".to_owned())]);
    let table = "lexibus = 1\n[device]\nname = \"P\"\n[[chapters]]\n[chapters.objects]\n\
                 0x2000 = { name = \"Speed\", type = \"u16\", access = \"rw\" }\n";
    let text = rows("0x2000 = { doc = \"As object 0x2010\" }\n");
    let found = apply_to("pump.toml", table, &text);
    let found = findings(&found);
    assert_eq!(found.len(), 1);
    assert!(found[0].0 == "TAB025" && found[0].1.starts_with("0x2000 ="), "{found:?}");
}

#[test]
fn items_get_other_addresses_and_keep_their_own() {
    let compilation = apply(&rows(
        "0x2000 = { ascii = \"SPEED\", param = 7, variants = [{ buses = [\"canopen\"], max = 9 }] }\n\
         \"0x2010:1..2\" = { ascii = \"G{sub}\" }\n",
    ));
    assert_eq!(findings(&compilation), []);
    assert_eq!((item(&compilation, 0x2000, 0).bindings.len(), item(&compilation, 0x2000, 0).variants.len()), (3, 1));
    assert!(compilation
        .rust(&Options::default().rust)
        .is_some_and(|rust| rust.contains("Name in the device's ASCII protocol: G2")));
    for row in ["reg = 1", "obj = 0x2005", "part = 3", "swap = true", "count = 2"] {
        let found = findings(&apply(&rows(&format!("0x2000 = {{ {row}, unit = \"rpm\" }}"))));
        assert_eq!(found, [("TAB004", "0x2000".to_owned())], "{row}");
    }
}
