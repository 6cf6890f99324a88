//! X01 to X07, X23, X24, X27: files, roots, vendors, names and what a file refers to.

use std::path::PathBuf;

use lexibus_codegen::compile::{check, Options};
use lexibus_codegen::ir::Type;
use lexibus_codegen::source::{Encoding, FileId, Source};

use crate::support::*;

fn bytes(bytes: &[u8]) -> Checked {
    Checked(check(Source::new("slave.xml", bytes.to_vec()), &Options::default()))
}

#[test]
fn x01_encodings() {
    let named = |declaration: &str, name: &[u8]| {
        let (head, tail) = ("<EtherCATInfo><Vendor><Id>1</Id><Name>", "</Name></Vendor></EtherCATInfo>");
        let mut text = declaration.as_bytes().to_vec();
        for part in [head.as_bytes(), name, tail.as_bytes()] {
            text.extend(part);
        }
        bytes(&text)
    };
    let encoding = |checked: &Checked| checked.0.sources[0].encoding();
    let marked = named("\u{feff}<?xml version='1.0'?>", b"A");
    assert_eq!((encoding(&marked), marked.found()), (Encoding::Utf8Bom, vec![]));
    for label in ["ISO-8859-1", "ISO8859-1", "windows-1252"] {
        let latin = named(&format!("<?xml version='1.0' encoding='{label}'?>"), b"M\xfcller");
        assert_eq!((encoding(&latin), latin.found()), (Encoding::Windows1252, vec![]), "{label}");
        assert!(latin.0.sources[0].text().contains("Müller"));
    }
    let chinese = named("<?xml version='1.0' encoding='gb2312'?>", b"\xd6\xd0");
    assert!(chinese.0.sources[0].text().contains('中'));
    let undeclared = named("", b"M\xfcller");
    assert_eq!(undeclared.found(), ["XML003 1:40"]);
    let wrong = named("<?xml version='1.0' encoding='iso-8859-1'?>", "ü".as_bytes());
    assert_eq!(wrong.found(), ["XML003 1:82"]);
    // Other names of UTF-8, of Windows-1252, and what has no such letter.
    for (label, name) in
        [("utf8", "ü".as_bytes()), ("UTF_8", b"A"), ("us-ascii", b"\xfc"), ("utf-16", b"A"), ("", b"A")]
    {
        let other = named(&format!("<?xml version='1.0' encoding='{label}'?>"), name);
        assert_eq!(other.found(), NOTHING, "{label}");
    }
    for (declaration, name, message) in [
        ("<?xml version='1.0' encoding='utf-16'?>", &b"\xfc"[..], "neither UTF-8 nor"),
        ("<?xml version='1.0' encoding='klingon'?>", b"\xfc", "can't be read here"),
        ("<?xml version='1.0' encoding='gb2312'?>", b"\xd6\xd0\xff\xff", "bytes that are no letters"),
        ("\u{feff}<?xml version='1.0'?>", b"\xfc", "begins with the mark of UTF-8"),
        ("\u{feff}<?xml version='1.0' encoding='iso-8859-1'?>", "ü".as_bytes(), "declares another"),
    ] {
        let checked = named(declaration, name);
        assert!(checked.only("XML003").message.contains(message), "{declaration}: {}", checked.only("XML003").message);
        assert_eq!(checked.found().len(), 1);
    }
    let wide = |text: &str, more: &[u8]| {
        let mut wide = vec![0xFF, 0xFE];
        wide.extend(text.encode_utf16().flat_map(u16::to_le_bytes));
        wide.extend(more);
        bytes(&wide).found()
    };
    let root = "<EtherCATInfo><Vendor><Id>1</Id><Name>A</Name></Vendor></EtherCATInfo>";
    assert_eq!(wide(&format!("<?xml version='1.0' encoding='utf-16'?>{root}"), b""), NOTHING);
    assert_eq!(wide(&format!("<?xml version='1.0'?>{root}<!--"), b"\0\xD8-\0-\0>\0"), ["XML003 1:96"]);
    assert_eq!(wide(&format!("<?xml version='1.0' encoding='utf-8'?>{root}"), b""), ["XML003 1:1"]);
}

#[test]
fn x02_junk_behind_the_root() {
    for junk in ["</Descriptions>", "<EtherCATInfo/>", "0>", "<", "<a b></a>"] {
        let checked = read_text(&format!("{}\n{junk}", device_file("")));
        assert_eq!(checked.device().name, "Drive", "{junk}");
        assert_eq!(checked.found().len(), 1, "{junk}");
        assert!(checked.found()[0].starts_with("XML004 6:"), "{junk}: {:?}", checked.found());
    }
    // Before the end of the root nothing is repaired.
    let broken = read_text("<EtherCATInfo>\n<Vendor></EtherCATInfo>");
    assert!(broken.0.catalog.is_none());
    assert_eq!(broken.found(), ["XML001 2:9"]);
    let cut = read_text("<EtherCATInfo>\n<Vendor>");
    assert_eq!(cut.found(), ["XML001 2:8"]);
}

#[test]
fn x03_roots() {
    let slave = |name: &str| {
        format!(
            "<EtherCATInfo><Vendor><Id>2</Id></Vendor><Descriptions><Devices><Device>\
             <Type ProductCode='7'>{name}</Type></Device></Devices></Descriptions></EtherCATInfo>"
        )
    };
    let list = read_text(&format!("<EtherCATInfoList>{}{}</EtherCATInfoList>", slave("A"), slave("B")));
    let ids: Vec<_> = list.catalog().devices.iter().map(|device| device.id.as_str()).collect();
    assert_eq!(ids, ["A", "B"]);
    assert_eq!(list.device().identity.vendor_id, Some(2));
    for root in ["EtherCATTest", "SscToolConfiguration", "EtherCATConfig"] {
        let other = read_text(&format!("<{root}/>"));
        assert_eq!(other.found(), ["IO002 1:2"], "{root}");
    }
    let modules =
        "<EtherCATModule><Vendor><Id>1</Id></Vendor><Modules><Module><Type ModuleIdent='#x5'>M</Type></Module>\
                   </Modules></EtherCATModule>";
    let modules = read_text(modules);
    assert_eq!((modules.module().number, modules.module().identity.vendor_id), (5, Some(1)));
}

#[test]
fn x03_dictionaries_and_messages_alone() {
    let dictionary = read_text(&format!(
        "<EtherCATDict><Dictionary><DataTypes>{}</DataTypes><Objects>{}</Objects></Dictionary></EtherCATDict>",
        basic("UINT", 16),
        var("#x2000", "UINT", "<DefaultValue>5</DefaultValue>")
    ));
    assert!(dictionary.device().dictionary_only);
    assert_eq!(dictionary.default(0x2000, 0), int(5));
    let messages = read_text(
        "<EtherCATDiag><DiagMessages><DiagMessage><TextId>#xF008</TextId><MessageText>Too hot</MessageText>\
         <Flags><DiagClass>error</DiagClass></Flags><CauseRemedy Idx='0'><Cause>No fan</Cause><Remedy>Add one</Remedy>\
         </CauseRemedy></DiagMessage><DiagType><Text>Runtime</Text><Enum>3</Enum></DiagType></DiagMessages></EtherCATDiag>",
    );
    let [table, types] = &messages.catalog().code_tables[..] else { panic!("two tables") };
    assert_eq!((table.rows[0].code, table.rows[0].name.as_str()), (0xF008, "Too hot"));
    assert_eq!(table.rows[0].documentation.as_ref().unwrap().text, "Cause: No fan\n\nRemedy: Add one");
    assert_eq!((types.name.as_str(), types.rows[0].code), ("DiagType", 3));
    assert!(dictionary.found().is_empty() && messages.found().is_empty());
}

#[test]
fn messages_in_several_languages() {
    let of = |elements: &str| {
        let checked = read_text(&format!(
            "<EtherCATDiag><DiagMessages><DiagMessage><TextId>1</TextId><MessageText>X</MessageText>{elements}\
             </DiagMessage></DiagMessages></EtherCATDiag>"
        ));
        checked.catalog().code_tables[0].rows[0].documentation.clone().unwrap()
    };
    let said = of("<CauseRemedy><Cause LcId='1031'>Kein L\u{fc}fter</Cause><Cause LcId='1033'>No fan</Cause>\
         <Remedy LcId='1033'>Add one</Remedy></CauseRemedy><CauseRemedy><Cause LcId='1033'>Dust</Cause></CauseRemedy>\
         <Hint LcId='1033'>Hot</Hint><Hint LcId='1031'>Hei\u{df}</Hint><Hint LcId='1033'>Loud</Hint>");
    assert_eq!(said.text, "Cause: No fan\n\nRemedy: Add one\n\nCause: Dust\n\nHint: Hot\n\nHint: Loud");
    let [german] = &said.translations[..] else { panic!("{:?}", said.translations) };
    let twice = of("<Description>A</Description><Description>B</Description><Hint LcId='1033'>C</Hint><Hint>D</Hint>");
    assert_eq!((twice.text.as_str(), twice.translations.len()), ("A\n\nB\n\nHint: C\n\nHint: D", 0));
    let in_turn =
        "<Hint LcId='1033'>1</Hint><Hint LcId='1033'>2</Hint><Hint LcId='1031'>a</Hint><Hint LcId='1031'>b</Hint>";
    assert_eq!(of(in_turn).translations[0].text, "Hint: a\n\nHint: b");
    // What isn't translated stays as it is.
    let text = "Cause: Kein L\u{fc}fter\n\nRemedy: Add one\n\nCause: Dust\n\nHint: Hei\u{df}\n\nHint: Loud";
    assert_eq!((german.language.as_str(), german.text.as_str()), ("de-DE", text));
}

#[test]
fn x04_no_version() {
    for (version, expected) in [("", ""), (" Version='0.1'", "0.1"), (" Version='1.17'", "1.17")] {
        let checked = read_text(&device_file("").replace("<EtherCATInfo>", &format!("<EtherCATInfo{version}>")));
        assert_eq!(checked.device().header.format_version, expected);
        assert_eq!(checked.found(), NOTHING);
    }
}

#[test]
fn x05_vendor_numbers() {
    for (text, id) in [("#xF3F", 0xF3F), ("0xF3F", 0xF3F), ("0", 0), ("1337", 1337), ("#X0000000a", 10)] {
        let checked = read_text(&device_file("").replace("#x1", text));
        assert_eq!(checked.device().identity.vendor_id, Some(id), "{text}");
        assert_eq!(checked.found(), NOTHING);
    }
    let empty = read_text(&device_file("").replace("#x1", ""));
    assert_eq!(empty.device().identity.vendor_id, None);
    assert_eq!(empty.found(), ["ESI060 1:1"]);
    let text = read_text(&device_file("").replace("#x1", "ask us"));
    assert_eq!(text.found(), ["ESI001 1:27"]);
}

#[test]
fn x06_any_order() {
    let ordered = "<Name>N</Name><Type ProductCode='1'>T</Type><Sm>Inputs</Sm>";
    let pdo = tx_pdo("#x1A00", &entry("#x6000", 1, 8, "OWN"));
    let types =
        "<DataTypes><DataType><Name>OWN</Name><BaseType>USINT</BaseType><BitSize>8</BitSize></DataType></DataTypes>";
    let objects = format!("<Objects>{}</Objects>", var("#x2000", "OWN", "<DefaultValue>1</DefaultValue>"));
    let profile = format!("<Profile><Dictionary>{objects}{types}</Dictionary></Profile>");
    let slots =
        "<Slots><SlotGroupData SlotGroup='1'><Name>G</Name></SlotGroupData><Slot MinInstances='0' MaxInstances='2'>\
                 <ModuleIdent>1</ModuleIdent></Slot></Slots>";
    let device = format!("<Device>{pdo}{slots}{profile}<Info><Electrical/></Info>{ordered}</Device>");
    let module = "<Modules><Module><Type ModuleIdent='1'>M</Type></Module></Modules>";
    let text = format!(
        "<EtherCATInfo><Descriptions>{module}<Devices>{device}</Devices></Descriptions>\
         <Vendor><Name>V</Name><Id>9</Id></Vendor></EtherCATInfo>"
    );
    let checked = read_text(&text);
    assert_eq!((checked.device().name.as_str(), checked.device().id.as_str()), ("N", "T"));
    assert_eq!(checked.device().identity.vendor_id, Some(9));
    assert_eq!(checked.pdo(0x1A00).entries[0].ty, lexibus_codegen::ir::Type::Unsigned(8));
    assert_eq!(checked.default(0x2000, 0), int(1));
    assert_eq!(checked.device().modules.len(), 1);
    // The object that the PDO maps and its sync manager are left out of the vector.
    let found = checked.found();
    assert!(found.iter().all(|found| found.starts_with("PDO001") || found.starts_with("PDO019")), "{found:?}");
}

#[test]
fn x07_names_by_lcid() {
    let names = |names: &str| {
        let checked = read_text(&device_file("").replace("<Name>Drive</Name>", names));
        let device = checked.device();
        let others = device.names.iter().map(|text| format!("{} {}", text.language, text.text)).collect::<Vec<_>>();
        assert_eq!(checked.found(), NOTHING);
        (device.name.to_string(), others.join(", "))
    };
    let three = "<Name LcId='1031'>Antrieb</Name><Name LcId='1033'>Drive</Name><Name LcId='2052'>驱动</Name>";
    assert_eq!(names(three), ("Drive".into(), "de-DE Antrieb, zh-CN 驱动".into()));
    assert_eq!(names("<Name LcId='2052'>驱动</Name>"), ("驱动".into(), "".into()));
    assert_eq!(names("<Name LcId='1031'>Antrieb</Name><Name LcId='0'>D</Name>"), ("D".into(), "de-DE Antrieb".into()));
    assert_eq!(names("<Name LcId='1'>D</Name><Name LcId='4660'>X</Name>"), ("D".into(), "lcid:4660 X".into()));
    assert_eq!(names("<Name LcId='1041'>J</Name><Name>D</Name>"), ("D".into(), "ja-JP J".into()));
    let bad = read_text(&device_file("").replace("<Name>Drive", "<Name LcId='en'>Drive"));
    assert_eq!((bad.device().name.as_str(), bad.found()), ("Drive", vec!["ESI001 2:93".to_owned()]));
}

#[test]
fn x23_revisions_and_hidden_types() {
    let one = |code: &str, revision: &str| {
        format!("<Device Physics='YY'><Type ProductCode='{code}' {revision}>T</Type><Name>N</Name></Device>")
    };
    let two = one("#x10", "RevisionNo='#x00110000'").replace("<Name>", "<HideType RevisionNo='#x00100000'/><Name>");
    let text = file(&format!("<Devices>{}{two}{}</Devices>", one("16", "RevisionNo='#x00100000'"), one("16", "")));
    let checked = read_text(&text);
    let identities: Vec<_> = checked
        .catalog()
        .devices
        .iter()
        .map(|device| (device.identity.product_code, device.identity.revision_number))
        .collect();
    assert_eq!(identities, [(Some(16), Some(0x10_0000)), (Some(16), Some(0x11_0000)), (Some(16), None)]);
    assert_eq!(checked.catalog().devices[1].ethercat.as_ref().unwrap().hides, [(None, Some(0x10_0000))]);
    assert_eq!(checked.found(), NOTHING);
    let none = read_text(&file("<Devices><Device Physics=''>\n<Type>T</Type></Device><Device/></Devices>"));
    assert_eq!(none.found(), ["ESI060 3:1", "ESI060 3:24"]);
}

/// A folder with these files; the first is the description.
fn folder(name: &str, files: &[(&str, &str)]) -> (PathBuf, Checked) {
    let folder = std::env::temp_dir().join(format!("lexibus-esi-{name}-{}", std::process::id()));
    for (name, text) in files {
        let path = folder.join(name);
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(path, text).unwrap();
    }
    let checked = Checked(check(Source::read(&folder.join(files[0].0)).unwrap(), &Options::default()));
    (folder, checked)
}

fn main_file() -> String {
    let device = |product: u32| {
        format!(
            "<Device Physics='Y'><Type ProductCode='{product}'>T</Type><Name>N</Name>\
             <Slots><Slot MinInstances='1' MaxInstances='1'><ModuleIdent>5</ModuleIdent></Slot></Slots>\
             <Profile><DictionaryFile>Dicts\\dict.xml</DictionaryFile><DiagFile>diag.xml</DiagFile></Profile></Device>"
        )
    };
    file(&format!("<Devices>{}{}</Devices>", device(1), device(2)))
        .replace("<Vendor>", "<InfoReference>modules.xml</InfoReference><Vendor>")
}

#[test]
fn types_of_a_dictionary_file_for_entries() {
    let dictionary = "<EtherCATDict><Dictionary><DataTypes>\
        <DataType><Name>OWN</Name><BaseType>USINT</BaseType><BitSize>8</BitSize></DataType>\
        <DataType><Name>UINT_Mode</Name><BaseType>UINT</BaseType><BitSize>16</BitSize>\
        <EnumInfo><Text>On</Text><Enum>1</Enum></EnumInfo></DataType>\
        <DataType><Name>E</Name><BaseType>USINT</BaseType><BitSize>8</BitSize><Own>x</Own>\
        <EnumInfo><Text>On</Text><Enum>1</Enum></EnumInfo></DataType></DataTypes><Objects/></Dictionary></EtherCATDict>";
    let entries: String = [("OWN", 8), ("E", 8), ("E", 16), ("NONE", 8), ("UINT", 16), ("UINT_Mode", 16)]
        .iter()
        .map(|(name, bits)| format!("{}\n", entry("#x6000", 1, *bits, name)))
        .collect();
    let of = |profile: &str| {
        let main = device_file(&format!("{}<Profile>{profile}</Profile>", tx_pdo("#x1A00", &entries)));
        let (folder, checked) = folder("types", &[("main.xml", main.as_str()), ("dict.xml", dictionary)]);
        std::fs::remove_dir_all(folder).unwrap();
        checked
    };
    let checked = of("<DictionaryFile>dict.xml</DictionaryFile>");
    let device = checked.device();
    let types: Vec<_> = device.process_data.pdos[0].entries.iter().map(|entry| entry.ty).collect();
    let [own, one, other, none, basic, mode] = types[..] else { panic!("{types:?}") };
    assert_eq!((own, basic, none), (Type::Unsigned(8), Type::Unsigned(16), Type::Opaque(None)));
    assert!(matches!(mode, Type::Named(_)), "no guess");
    let Type::Named(id) = one else { panic!("{one:?}") };
    assert_eq!((one, device.types[id.0 as usize].name.as_str()), (other, "E"));
    let found: Vec<_> = checked.found().iter().map(|one| one.split(' ').next().unwrap().to_owned()).collect();
    assert_eq!(found, ["ESI044", "ESI010"], "{:?}", checked.found());
    assert_eq!(value_of(&device.extensions, "E/DataType/Own"), Some("x"));
    // Where the file isn't there, nothing says what the types are.
    let missing = of("<DictionaryFile>none.xml</DictionaryFile>");
    assert_eq!(missing.found().iter().filter(|one| one.starts_with("ESI010")).count(), 4);
    assert_eq!(missing.device().process_data.pdos[0].entries[5].ty, Type::Unsigned(16), "a guess");
}

#[test]
fn x24_files_beside_the_description() {
    let dictionary = format!(
        "<EtherCATDict>\n<Dictionary><DataTypes><DataType><Name>E</Name><BaseType>USINT</BaseType><BitSize>8</BitSize>\
         <EnumInfo><Text>On</Text><Enum>1</Enum></EnumInfo></DataType></DataTypes><Objects>\n{}</Objects></Dictionary>\
         </EtherCATDict>",
        var("#x2000", "E", "<DefaultValue>1</DefaultValue>")
    );
    // One file refers back to another, and to itself.
    let modules = "<EtherCATModule><InfoReference>main.xml</InfoReference><InfoReference>./modules.xml</InfoReference>\
                   <Vendor><Id>1</Id></Vendor><Modules><Module><Type ModuleIdent='5'>M</Type></Module></Modules>\
                   </EtherCATModule>";
    let diag = "<EtherCATDiag><DiagMessages><DiagMessage><TextId>1</TextId><MessageText>X</MessageText></DiagMessage>\
                </DiagMessages></EtherCATDiag>";
    let main = main_file();
    let files =
        [("main.xml", main.as_str()), ("Dicts/dict.xml", &dictionary), ("modules.xml", modules), ("diag.xml", diag)];
    let (folder, checked) = folder("all", &files);
    std::fs::remove_dir_all(folder).unwrap();
    assert_eq!(checked.found(), NOTHING);
    assert_eq!(checked.0.sources.len(), 4);
    for device in &checked.catalog().devices {
        let object = device.object(0x2000).unwrap();
        assert_eq!((object.origin.span.file != FileId(0), object.origin.line), (true, 3));
        // A table of codes is that of the file, another one the profile's.
        assert_eq!((device.types.len(), device.code_tables.len(), device.modules.len()), (1, 2, 1));
    }
}

#[test]
fn x24_devices_of_a_file_that_is_referred_to() {
    let other = file("<Devices><Device><Type ProductCode='7'>O</Type><Name>O</Name></Device></Devices>");
    let main = file("<Devices><Device><Type ProductCode='1'>T</Type><Name>N</Name></Device></Devices>")
        .replace("<Vendor>", "<InfoReference>other.xml</InfoReference><Vendor>");
    let list = "<EtherCATInfo><InfoReference>other.xml</InfoReference></EtherCATInfo>";
    // They are another file's, and come only where nothing else can be meant.
    for (main, product, own) in [(main.as_str(), 1, 1), (list, 7, 0)] {
        let (folder, checked) = folder("devices", &[("main.xml", main), ("other.xml", &other)]);
        std::fs::remove_dir_all(folder).unwrap();
        let products: Vec<_> = checked.catalog().devices.iter().map(|device| device.identity.product_code).collect();
        assert_eq!(products, [Some(product)]);
        assert_eq!(lexibus_codegen::backend::json::info(&checked.0).devices.len(), own);
    }
}

#[test]
fn x23_the_numbers_of_the_device_select_it() {
    let fields = [("N", "USINT", 8, 0), ("V", "UDINT", 32, 16), ("P", "UDINT", 32, 48), ("R", "UDINT", 32, 80)];
    let fields = (0..).zip(fields).map(|(sub, (name, ty, bits, at))| sub_item(sub, name, ty, bits, at));
    let ty = format!("<DataType><Name>DT1018</Name><BitSize>112</BitSize>{}</DataType>", fields.collect::<String>());
    let default = |name: &str, value: u32| {
        format!("<SubItem><Name>{name}</Name><Info><DefaultValue>{value}</DefaultValue></Info></SubItem>")
    };
    let defaults = [default("N", 3), default("V", 1), default("P", 2), default("R", 1)].concat();
    let identity = profile(&(basic("USINT", 8) + &basic("UDINT", 32) + &ty), &var("#x1018", "DT1018", &defaults));
    // Zero is a revision as any other, whatever the object says, and one that is missing fits any.
    for (revision, expected) in [("RevisionNo='0'", Some(0)), ("", None), ("RevisionNo='1'", Some(1))] {
        let checked = read_text(&device_file(&identity).replace("RevisionNo='#x3'", revision));
        assert_eq!(checked.device().identity.revision_number, expected);
        let mismatch = checked.found().iter().any(|found| found.starts_with("EDS061"));
        assert_eq!(mismatch, expected == Some(0), "{:?}", checked.found());
    }
}

#[test]
fn x24_files_that_are_not_there() {
    let (dir, checked) = folder("none", &[("main.xml", &main_file())]);
    std::fs::remove_dir_all(dir).unwrap();
    assert_eq!(checked.catalog().devices.len(), 2);
    let found = checked.found();
    assert_eq!(found.iter().filter(|found| found.starts_with("XML005")).count(), 3, "{found:?}");
    assert!(found.contains(&"XML005 1:30".to_owned()));
    // In memory there is no folder, and outside of it nothing is read.
    let memory = read_text(&main_file().replace("modules.xml", "../modules.xml"));
    assert_eq!(memory.found().iter().filter(|found| found.starts_with("XML005")).count(), 3);
    let (dir, broken) = folder("broken", &[("main.xml", &main_file()), ("modules.xml", "<EtherCATModule>")]);
    std::fs::remove_dir_all(dir).unwrap();
    assert_eq!(broken.catalog().devices.len(), 2);
    assert!(broken.found().contains(&"XML005 1:30".to_owned()));
    let (dir, wrong) = folder("wrong", &[("main.xml", &main_file()), ("diag.xml", "<EtherCATInfo/>")]);
    std::fs::remove_dir_all(dir).unwrap();
    assert!(wrong.0.diagnostics.list().iter().any(|found| found.message.contains("has no diagnosis messages")));
}

#[test]
fn x27_product_codes_and_booleans() {
    for (code, expected) in [("#X0BBC3052", 0x0BBC_3052), (" #x2 ", 2), ("0x2", 2), ("196882514", 0x0BBC_3052)] {
        let checked = read_text(&device_file("").replace("'#x2'", &format!("'{code}'")));
        assert_eq!(checked.device().identity.product_code, Some(expected), "{code}");
        assert_eq!(checked.found(), NOTHING);
    }
    for (text, fixed) in [("1", true), ("true", true), ("0", false), ("false", false)] {
        let checked = device(&format!("<RxPdo Fixed='{text}'><Index>#x1600</Index><Name>P</Name></RxPdo>"));
        assert_eq!(checked.pdo(0x1600).fixed, fixed);
        assert_eq!(checked.found(), NOTHING);
    }
    let odd = device("<RxPdo Fixed='TRUE'><Index>#x1600</Index><Name>P</Name></RxPdo>");
    assert!(odd.pdo(0x1600).fixed);
    assert_eq!(odd.found(), ["ESI001 3:15"]);
}
