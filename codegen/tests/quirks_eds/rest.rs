//! E58 to E82: the header, comments, PDOs, modules, names and the rest.

use lexibus_codegen::compile::{check, Options};
use lexibus_codegen::diagnostics::Severity;
use lexibus_codegen::ir::{Access, DynamicChannel, Format, ObjectCode, Type, Value};
use lexibus_codegen::source::Source;

use crate::support::*;

const DEVICE: &str =
    "[DeviceInfo]\nVendorName=Maker\nVendorNumber=1\nProductName=Pump\nProductNumber=2\nRevisionNumber=3\n";

#[test]
fn e58_dummies() {
    let checked = read("[DummyUsage]\nDummy0001=0\nDummy0005=1\ndummy0006=1\n");
    let canopen = checked.device().canopen.as_ref().unwrap();
    assert!(canopen.dummies_given);
    assert_eq!(canopen.dummies, [5, 6]);
    assert_eq!(checked.codes(), [""; 0]);
    let without = read("");
    assert!(!without.device().canopen.as_ref().unwrap().dummies_given);
    assert_eq!(without.codes(), [""; 0]);
}

#[test]
fn e59_comments() {
    for (entries, lines) in [
        ("Line1=a\nLine2=b", &["a", "b"][..]),
        ("Lines=3\nLine1=a\nLine3=c", &["a", "c"]),
        ("Lines=1\nline5=Größe", &["Größe"]),
        ("Lines=2\nLine2=b\nLine1=a", &["a", "b"]),
        ("Lines=0", &[]),
        ("", &[]),
    ] {
        let checked = read(&format!("[Comments]\n{entries}\n"));
        assert_eq!(checked.device().header.comments, lines, "{entries}");
        assert_eq!(checked.codes(), [""; 0], "{entries}");
    }
    let other = read("[Comments]\nLines=0\nAuthor=me\n");
    assert_eq!(other.extension("Comments/Author"), Some("me"), "nothing is lost");
}

#[test]
fn e60_blanks_around_the_equals_sign() {
    let checked = read("[2000]\nParameterName = Speed \n\tObjectType\t=\t0x7\nDataType =0x0005\nAccessType= rw\n");
    assert_eq!(checked.item(0x2000, 0).name, "Speed");
    assert_eq!(checked.item(0x2000, 0).ty, Type::Unsigned(8));
    assert_eq!(checked.codes(), [""; 0]);
    let octal = read("[2000]\nParameterName = Speed\nDataType=5\nAccessType=rw\nDefaultValue \t= 012\n");
    assert_eq!(octal.places("EDS020"), [(5, 17)], "a place is where the value is, behind the blanks");
}

#[test]
fn e61_comment_behind_a_header() {
    for header in ["[2000] ; speed of it", "[2000]; speed of it", "[2000] # speed of it"] {
        let checked = read(&format!("{header}\nParameterName=Speed\nDataType=0x0005\nAccessType=rw\n"));
        assert_eq!(checked.item(0x2000, 0).name, "Speed");
        assert_eq!(value_of(&checked.group(0x2000).extensions, ";"), Some("speed of it"), "{header}");
        assert_eq!(checked.codes(), [""; 0], "{header}");
    }
    let text = "[2000]\nParameterName=Errors\nObjectType=8\nSubNumber=2\n\
                [2000sub0]\nParameterName=Count\nDataType=0x0005\nAccessType=ro\nDefaultValue=1\n\
                [2000sub1] # repeat until 2000subFE\nParameterName=Error\nDataType=0x0007\nAccessType=ro\n";
    let checked = read(text);
    assert_eq!(checked.subs(0x2000), [0, 1]);
    assert_eq!(value_of(&checked.item(0x2000, 1).extensions, ";"), Some("repeat until 2000subFE"));
    assert_eq!(checked.codes(), [""; 0]);
}

#[test]
fn e62_indented_header() {
    let checked = read("  [2000]\n  ParameterName=Speed\n  DataType=0x0005\n\tAccessType=rw\n");
    assert_eq!(checked.item(0x2000, 0).access, Access::ReadWrite);
    assert_eq!(checked.codes(), ["EDS006"]);
    assert_eq!(checked.places("EDS006"), [(1, 3)]);
}

#[test]
fn e63_flags_in_other_words() {
    for (text, mappable, code) in [
        ("True", true, "EDS032"),
        ("no", false, "EDS032"),
        ("0x1", true, "EDS032"),
        ("0x0", false, "EDS032"),
        ("2", true, "EDS032"),
        ("perhaps", false, "EDS032"),
        ("0;", false, "EDS015"),
        ("1 ; yes", true, "EDS015"),
    ] {
        let checked = read(&var(U8, &format!("PDOMapping={text}")));
        assert_eq!(checked.item(0x2000, 0).mappable.any(), mappable, "{text}");
        assert_eq!(checked.codes(), [code], "{text}");
        let column = 12 + if code == "EDS015" { text.find(';').unwrap() as u32 } else { 0 };
        assert_eq!(checked.places(code), [(6, column)], "{text}");
    }
    for text in ["0", "1", ""] {
        assert_eq!(read(&var(U8, &format!("PDOMapping={text}"))).codes(), [""; 0]);
    }
    // A tool that writes one flag so writes all of them so: that is one finding.
    let other = var(U8, "PDOMapping=0x0").replace("2000", "2001");
    let checked = read(&(var(U8, "PDOMapping=0x1") + &other));
    assert_eq!(checked.codes(), ["EDS032"]);
    assert!(checked.only("EDS032").message.starts_with("2 flags"));
}

#[test]
fn e64_lines_without_meaning() {
    let checked =
        read("[2000]\nParameterName=Speed\ngarbage line\nDataType=0x0005\n../../common/pump.dcf\nAccessType=rw\n=5\n");
    assert_eq!(checked.item(0x2000, 0).access, Access::ReadWrite, "the lines behind still count");
    assert_eq!(checked.codes(), ["EDS003"; 3]);
    assert_eq!(checked.places("EDS003"), [(3, 1), (5, 1), (7, 1)]);
    let above = read("../../common/pump.dcf\nx=5\n[2000]\nParameterName=Speed\nDataType=0x0005\nAccessType=rw\n");
    assert_eq!(above.codes(), ["EDS003", "EDS004"]);
    // A merge marker, which a stray `=` must not turn into an entry.
    let marker = read("[2000]\nParameterName=Speed\n=======\nDataType=0x0005\nAccessType=rw\n");
    assert_eq!(marker.codes(), ["EDS003"]);
}

#[test]
fn e65_unknown_keys() {
    let vector = format!(
        "; made by hand\n{DEVICE}1_Sub0=7\nNG_Slave=1\n\
         [2000]\nParameterName=Speed\nDataType=0x0005\nAccessType=rw\nUnit=rpm\nFactor=0.5\n;SEVCONFIELD a, b\n"
    );
    let checked = read(&vector);
    let extensions = &checked.group(0x2000).extensions;
    assert_eq!(value_of(extensions, "Unit"), Some("rpm"));
    assert_eq!(value_of(extensions, "Factor"), Some("0.5"));
    assert_eq!(value_of(extensions, ";"), Some("SEVCONFIELD a, b"));
    assert_eq!(
        (checked.extension("DeviceInfo/NG_Slave"), checked.extension("DeviceInfo/1_Sub0")),
        (Some("1"), Some("7"))
    );
    assert_eq!(checked.extension(";"), Some("made by hand"), "comments above the first section are kept, too");
    assert_eq!(checked.codes(), [""; 0]);
    let asked = read_with(&vector, &["unknown-key"]);
    assert_eq!(asked.places("EDS012"), [(8, 1), (9, 1), (14, 1), (15, 1)]);
    assert_eq!(asked.codes().len(), 4);
}

#[test]
fn e65_one_unknown_key_in_several_sections() {
    let checked = read(&format!("{}Unit=V\n[2000ObjectLinks]\nObjectLinks=0\nUnit=V\n", var(U8, "")));
    let units = checked.group(0x2000).extensions.iter().filter(|extension| extension.key == "Unit");
    assert_eq!((units.count(), checked.codes()), (2, vec![]));
    let twice = read(&var(U8, "Unit=V\nunit=A"));
    assert_eq!(twice.places("EDS008"), [(7, 1)]);
    assert_eq!(twice.only("EDS008").label, "both are kept");
    let device = format!("{DEVICE}ProductVersion=1\nProductVersion=2\nNrOfRXPDO=0\nNrOfTXPDO=0\n");
    assert_eq!(read(&device).codes(), ["EDS008"]);
    let module = "[M1ModuleInfo]\nProductName=A\n[M1FixedObjects]\nNrOfEntries=0\nFoo=1\n\
                  [M1SubExtends]\nNrOfEntries=0\nFoo=1\n";
    assert_eq!(read(&format!("[SupportedModules]\nNrOfEntries=1\n{module}")).codes(), [""; 0]);
}

#[test]
fn e65_unknown_sections() {
    let checked = read("[Vendor stuff]\nColour=grün\n; painted\n[Tools]\nItems=0\n");
    assert_eq!(checked.extension("Vendor stuff/Colour"), Some("grün"));
    assert_eq!(checked.extension("Vendor stuff/;"), Some("painted"));
    assert_eq!(checked.extension("Tools/Items"), Some("0"));
    assert_eq!(checked.codes(), ["EDS011"]);
    assert_eq!(checked.places("EDS011"), [(1, 2)]);
}

#[test]
fn e66_keys_of_the_header_in_other_case() {
    let checked = read(
        "[DeviceInfo]\nVendorname=Maker\nVendorNumber=1\nProductName=Pump\nProductNumber=2\nRevisionNumber=3\n\
         NrOfRxPDO=0\nNrOfTxPDO=0\nBaudrate_125=1\nbaudrate_1000=1\nBaudRate_50=0\n\
         SimpleBootupSlave=1\nLSS_supported=1\n",
    );
    let canopen = checked.device().canopen.as_ref().unwrap();
    assert_eq!(checked.device().identity.vendor_name, "Maker");
    assert_eq!((canopen.rx_pdos, canopen.tx_pdos), (Some(0), Some(0)));
    assert_eq!(canopen.bit_rates, [125, 1000]);
    assert!(canopen.boot_up_slave && canopen.lss && !canopen.boot_up_master);
    assert_eq!(checked.codes(), [""; 0]);
}

#[test]
fn e67_versions_dates_and_times() {
    let file_info = |entry: &str| {
        read(&format!("[FileInfo]\nFileName=a\nFileRevision=1\nEDSVersion=4.0\nFileVersion=1\n{entry}\n"))
    };
    for (key, text) in [
        ("FileVersion", "1.0"),
        ("FileVersion", "-"),
        ("CreationDate", "2016-03-25"),
        ("ModificationDate", "25.03.2016"),
        ("CreationTime", "17:24:43"),
        ("EDSVersion", "404"),
        ("EDSVersion", "4"),
        ("EDSVersion", "402"),
        ("EDSVersion", "5.0"),
    ] {
        let others = ["FileVersion=1", "EDSVersion=4.0"].into_iter().filter(|other| !other.starts_with(key));
        let vector = format!(
            "[FileInfo]\n{key}={text}\nFileName=a\nFileRevision=1\n{}\n",
            others.collect::<Vec<_>>().join("\n")
        );
        let checked = read(&vector);
        let header = serde_json::to_value(&checked.device().header).unwrap();
        assert!(header.as_object().unwrap().values().any(|value| value == text), "{key}={text} is kept");
        assert_eq!(checked.codes(), ["EDS052"], "{key}={text}");
        assert_eq!(checked.places("EDS052"), [(2, key.len() as u32 + 2)], "{key}={text}");
    }
    for fine in ["CreationTime=09:30AM", "ModificationTime=12:00pm", "CreationDate=12-31-2020", "Description=µ"] {
        assert_eq!(file_info(fine).codes(), [""; 0], "{fine}");
    }
    let none = read("[FileInfo]\nFileName=a\nFileVersion=1\nFileRevision=1\n");
    assert_eq!(none.device().header.format_version, "");
    assert_eq!(none.codes(), ["EDS053"], "no EDSVersion means 3.0");
    assert_eq!(none.places("EDS053"), [(1, 2)]);
}

#[test]
fn e68_both_spellings_of_commissioning() {
    for name in ["DeviceComissioning", "DeviceCommissioning", "devicecommissioning"] {
        let own = "NodeID=17\nNodeName=Gerät\nBaudrate=250\nNetNumber=3\nCANopenManager=1";
        let text = file(&format!("[{name}]\n{own}\n"));
        let checked = read_as(&text, "configuration", &Options::default());
        assert_eq!(checked.0.format, Some(Format::Dcf), "the section makes it a DCF");
        let own = checked.device().commissioning.as_ref().unwrap();
        assert_eq!((own.node_id, own.bit_rate, own.net_number, own.manager), (Some(17), Some(250), Some(3), true));
        assert_eq!(own.node_name, "Gerät");
        assert_eq!(checked.codes(), [""; 0], "{name}");
    }
}

#[test]
fn e69_node_id_of_a_configuration_resolves_formulas() {
    let checked = read_dcf(&format!(
        "{}[DeviceComissioning]\nNodeID=0x11\nBaudrate=125\n",
        var(U32, "DefaultValue=$NODEID+0x180\nParameterValue=$NODEID+0x200")
    ));
    let node_id = checked.device().commissioning.as_ref().unwrap().node_id.unwrap();
    assert_eq!(node_id, 0x11);
    let item = checked.item(0x2000, 0);
    assert_eq!(item.default.as_ref().unwrap().resolved(node_id), Value::Int(0x191));
    assert_eq!(item.initial().unwrap().resolved(node_id), Value::Int(0x211));
    assert_eq!(checked.codes(), [""; 0]);
    assert!(checked.rust().contains("rt::NodeId::new(17)"));
    let none = read_dcf("[DeviceComissioning]\nNodeID=200\nBaudrate=125\n");
    assert_eq!(none.device().commissioning.as_ref().unwrap().node_id, None);
    assert_eq!(none.places("EDS064"), [(2, 8)]);
}

#[test]
fn e70_compact_pdos() {
    let checked = read(&format!("{DEVICE}CompactPDO=0x17\nNrOfRXPDO=2\nNrOfTXPDO=5\n"));
    let present = |index| checked.device().object(index).is_some();
    assert!(present(0x1400) && present(0x1401) && !present(0x1402) && present(0x1600) && present(0x1601));
    assert!(present(0x1804) && present(0x1A04) && !present(0x1805));
    assert_eq!(checked.subs(0x1400), [0, 1, 2, 3, 5]);
    assert_eq!(checked.default(0x1401, 1), Some(Value::NodeId(0x300)));
    assert_eq!(checked.default(0x1800, 1), Some(Value::NodeId(0x180)));
    assert_eq!(checked.default(0x1804, 1), Some(Value::Int(0x8000_0000)), "only four have an identifier by default");
    assert_eq!(checked.default(0x1400, 0), Some(Value::Int(5)));
    assert_eq!(checked.group(0x1600).origin.line, 0, "it stands nowhere");
    let pdos = &checked.device().process_data.pdos;
    let mappings: Vec<u16> = pdos.iter().filter(|pdo| pdo.implicit).map(|pdo| pdo.mapping_index).collect();
    assert_eq!(mappings, [0x1600, 0x1601, 0x1A00, 0x1A01, 0x1A02, 0x1A03, 0x1A04]);
    let info = checked.info();
    assert_eq!(info["devices"][0]["rx_pdos"].as_array().unwrap().len(), 0);
    assert_eq!(info["devices"][0]["objects"], 3, "what follows from a number isn't declared");
    assert_eq!(checked.codes(), [""; 0]);
}

#[test]
fn e71_modules() {
    let device = format!("{DEVICE}NrOfRXPDO=0\nNrOfTXPDO=0\n[SupportedModules]\nNrOfEntries=1\n");
    let module = "[M1ModuleInfo]\nProductName=Eingänge\nProductVersion=1\nProductRevision=2\nOrderCode=X\n\
                  [M1Comments]\nLines=1\nLine1=note\n\
                  [M1SubExtends]\nNrOfEntries=1\n1=0x6000\n\
                  [M1SubExt6000]\nParameterName=Input\nDataType=0x0005\nAccessType=ro\nPDOMapping=1\nCount=0;2\n\
                  ObjExtend=1\n\
                  [M1FixedObjects]\nNrOfEntries=1\n1=0x2010\n\
                  [M1Fixed2010]\nParameterName=Filter\nObjectType=7\nDataType=0x0006\nAccessType=rw\n";
    let checked = read(&format!("{device}{module}"));
    let module_1 = &checked.0.catalog.as_ref().unwrap().modules[0];
    assert_eq!((module_1.number, module_1.name.as_str(), module_1.identity.order_code.as_str()), (1, "Eingänge", "X"));
    assert_eq!((module_1.version.as_str(), module_1.revision.as_str()), ("1", "2"));
    assert_eq!(module_1.comments, ["note"]);
    let extension = &module_1.sub_extensions[0];
    assert_eq!((extension.index, extension.count, extension.per, extension.extends_object), (0x6000, 0, Some(2), true));
    assert_eq!((extension.template.name.as_str(), extension.template.ty), ("Input", Type::Unsigned(8)));
    assert_eq!(module_1.fixed_objects[0].index(), Some(0x2010));
    assert_eq!(checked.codes(), [""; 0]);
    // With asking, Count and ObjExtend still are keys of the standard.
    assert_eq!(read_with(&format!("{device}{module}"), &["unknown-key"]).codes(), [""; 0]);
    for (missing, place) in [("[M1SubExt6000]", (21, 3)), ("[M1Fixed2010]", (31, 3))] {
        let unresolved = read(&format!("{device}{}", module.replace(missing, "[Tools]")));
        assert!(unresolved.codes().contains(&"EDS054"), "{missing}");
        assert_eq!(unresolved.places("EDS054"), [place], "{missing}");
    }
    let announced = read(&format!("{DEVICE}[SupportedModules]\nNrOfEntries=2\n{module}"));
    assert_eq!(announced.codes(), ["EDS054"]);
    assert_eq!(announced.places("EDS054"), [(8, 13)]);
}

#[test]
fn e71_extension_of_another_type() {
    let device = format!("{DEVICE}NrOfRXPDO=0\nNrOfTXPDO=0\n[SupportedModules]\nNrOfEntries=1\n");
    let module = "[M1ModuleInfo]\nProductName=A\n[M1SubExtends]\nNrOfEntries=1\n1=0x6000\n\
                  [M1SubExt6000]\nParameterName=Input\nCount=1\n";
    let extended = |more: &str| read_with(&format!("{device}{module}{more}"), &["not-allowed-entry"]);
    let template =
        |checked: &Checked| checked.0.catalog.as_ref().unwrap().modules[0].sub_extensions[0].template.clone();
    let domain = extended("ObjectType=2\n");
    assert_eq!((template(&domain).ty, domain.codes()), (Type::Domain, vec![]));
    let others = extended("ObjectType=0x8\nSubNumber=3\nCompactSubObj=4\nDataType=5\nAccessType=ro\n");
    assert_eq!(template(&others).ty, Type::Unsigned(8));
    assert_eq!(value_of(&template(&others).extensions, "SubNumber"), Some("3"));
    assert_eq!(value_of(&template(&others).extensions, "CompactSubObj"), Some("4"));
    assert_eq!(others.codes(), ["EDS067", "EDS070", "EDS070"]);
    assert_eq!((others.places("EDS067"), others.places("EDS070")), (vec![(19, 12)], vec![(20, 1), (21, 1)]));
}

#[test]
fn e71_connected_modules() {
    let checked = read_dcf("[ConnectedModules]\nNrOfEntries=2\n1=4\n2=7\nSlots=3\n");
    let own = checked.device().commissioning.as_ref().unwrap();
    assert_eq!(own.connected_modules, [4, 7]);
    assert_eq!(checked.extension("ConnectedModules/Slots"), Some("3"));
    assert_eq!(checked.codes(), [""; 0]);
}

#[test]
fn e72_object_links_and_dynamic_channels() {
    let checked = read(&format!(
        "{}[2000ObjectLinks]\nObjectLinks=2\n1=0x1000\n2=0x1001\n\
         [DynamicChannels]\nNrOfSeg=2\nType1=0x0005\nDir1=rww\nRange1=0xA080-0xA0BF\nPPOffset1=0, 1\n\
         Type2=0x0007\nDir2=ro\nRange2=0xA100-0xA13F\nPPOffset2=0x10\n",
        var(U8, "")
    ));
    assert_eq!(checked.group(0x2000).links, [0x1000, 0x1001]);
    let channels = &checked.device().canopen.as_ref().unwrap().dynamic_channels;
    let first = DynamicChannel {
        data_type: 5,
        direction: "rww".into(),
        range: "0xA080-0xA0BF".into(),
        offset: 0,
        difference: Some(1),
        max_number: None,
    };
    assert_eq!(channels[0], first);
    assert_eq!((channels[1].offset, channels[1].difference), (16, None));
    assert_eq!(checked.codes(), [""; 0]);
    let unknown = read("[DynamicChannels]\nNrOfSeg=1\nType1=5\nPPOffset1=far away\n");
    assert_eq!(unknown.places("EDS022"), [(4, 11)]);
}

#[test]
fn e73_object_flags() {
    for (text, flags) in [("0x3", 3), ("0x12345678", 0x1234_5678), ("4294967295", u32::MAX), ("0", 0), ("", 0)] {
        let checked = read(&var(U8, &format!("ObjFlags={text}")));
        assert_eq!(checked.item(0x2000, 0).flags, flags, "{text}");
        assert_eq!(checked.codes(), [""; 0], "{text}");
    }
    let too_large = read(&var(U8, "ObjFlags=0x100000000"));
    assert_eq!(too_large.places("EDS022"), [(6, 10)]);
}

/// A RECORD at `index` whose sub-index 0 has the default `count` (line 9) and whose sub-index 1 is the last.
fn record(index: u16, count: &str) -> String {
    format!(
        "[{index:04X}]\nParameterName=Record\nObjectType=0x9\nSubNumber=2\n\
         [{index:04X}sub0]\nParameterName=Count\nDataType=0x0005\nAccessType=rw\nDefaultValue={count}\n\
         [{index:04X}sub1]\nParameterName=First\nDataType=0x0007\nAccessType=rw\n"
    )
}

#[test]
fn e74_sub_0_is_not_the_highest_sub_index() {
    let checked = read(&record(0x2000, "3"));
    assert_eq!(checked.default(0x2000, 0), Some(Value::Int(3)));
    assert_eq!(checked.codes(), ["EDS049"]);
    assert_eq!(checked.places("EDS049"), [(9, 14)]);
    assert_eq!(checked.only("EDS049").fix.as_deref(), Some("1"));
    for (index, count) in [(0x2000, "1"), (0x2000, ""), (0x1003, "0")] {
        assert_eq!(read(&record(index, count)).codes(), [""; 0], "0x{index:04X} {count}");
    }
}

#[test]
fn e75_defaults_and_limits() {
    for (more, code, place) in [
        ("LowLimit=5\nHighLimit=9\nDefaultValue=10", "EDS050", (8, 14)),
        ("LowLimit=5\nHighLimit=9\nDefaultValue=4", "EDS050", (8, 14)),
        ("LowLimit=9\nHighLimit=5\nDefaultValue=7", "EDS051", (6, 10)),
    ] {
        let checked = read(&var(I16, more));
        assert_eq!(checked.codes(), [code], "{more}");
        assert_eq!(checked.places(code), [place], "{more}");
    }
    let checked = read(&var(I16, "LowLimit=9\nHighLimit=5\nDefaultValue=7"));
    assert_eq!(checked.item(0x2000, 0).limits.low, Some(Value::Int(9)), "the limits are kept");
    assert!(!checked.rust().contains("Range::"), "and not checked, because nothing would pass");
    assert!(read(&var(I16, "LowLimit=5\nHighLimit=9")).rust().contains("Range::Between(5, 9)"));
    assert_eq!(read(&var(REAL32, "LowLimit=0.5\nHighLimit=2\nDefaultValue=2.5")).codes(), ["EDS050"]);
    assert_eq!(read(&var(I16, "LowLimit=5\nHighLimit=9\nDefaultValue=9")).codes(), [""; 0]);
    let configured = read_dcf(&var(I16, "LowLimit=5\nHighLimit=9\nParameterValue=10"));
    assert_eq!(configured.places("EDS050"), [(8, 16)]);
}

#[test]
fn e76_long_line() {
    let name = |length: usize| "ä".repeat(length - "ParameterName=".len());
    let checked = read(&format!("[2000]\nParameterName={}\nDataType=0x0005\nAccessType=rw\n", name(256)));
    assert_eq!(checked.group(0x2000).name, name(256));
    assert_eq!(checked.codes(), ["EDS009"]);
    assert_eq!(checked.places("EDS009"), [(2, 1)]);
    let fits = read(&format!("[2000]\nParameterName={}\nDataType=0x0005\nAccessType=rw\n", name(255)));
    assert_eq!(fits.codes(), [""; 0], "characters count, not bytes");
}

#[test]
fn e77_sub_index_255_is_the_structure() {
    let text = |count: u8| {
        format!(
            "[2000]\nParameterName=Speeds\nObjectType=0x8\nSubNumber={count}\n\
             [2000sub0]\nParameterName=Count\nDataType=0x0005\nAccessType=ro\nDefaultValue=1\n\
             [2000sub1]\nParameterName=Speed\nDataType=0x0006\nAccessType=ro\n\
             [2000subFF]\nParameterName=Structure\nDataType=0x0007\nAccessType=ro\nDefaultValue=0x00000608\n"
        )
    };
    let counted = read(&text(3));
    assert_eq!(counted.names(0x2000), ["Count", "Speed", "Structure"], "it is documented");
    assert_eq!(counted.codes(), ["EDS066"], "but neither the highest sub-index nor an element");
    assert_eq!(counted.places("EDS066"), [(4, 11)]);
    assert_eq!(read(&text(2)).codes(), [""; 0]);
    assert_eq!(read(&text(4)).codes(), ["EDS046"]);
}

#[test]
fn e78_ethernet_ip_eds() {
    let text = "$ made by hand\n[File]\nDescText = \"Pump\";\nRevision = 1.0;\n\
                [Device]\nVendCode = 1;\nProdName = \"Gerät\";\n";
    let checked = read_as(text, "pump.eds", &Options::default());
    assert!(checked.0.catalog.is_none());
    assert_eq!(checked.codes(), ["EDS001"]);
    assert_eq!(checked.places("EDS001"), [(2, 2)]);
    let found = checked.only("EDS001");
    assert!(found.message.contains("this is an EtherNet/IP EDS"), "{}", found.message);
    assert_eq!(found.severity, Severity::Error);
    let empty = check(Source::new("pump.eds", b"[Tools]\n".to_vec()), &Options::default());
    assert_eq!(empty.diagnostics.list()[0].code.id, "EDS002");
}

#[test]
fn e78_headers_without_their_first_bracket() {
    let text = "FileInfo]\nFileName=a\n1000]\nObjectType=7\n";
    let compilation = check(Source::new("x.eds", text.into()), &Options::default());
    let codes: Vec<&str> = compilation.diagnostics.list().iter().map(|found| found.code.id).collect();
    assert_eq!(codes, ["EDS002", "EDS003", "EDS004", "EDS003", "EDS004"], "and why it is none");
}

/// Names of the methods that take a client's device to an object or to an entry.
fn methods(rust: &str) -> Vec<&str> {
    let lines = rust.lines().map(str::trim_start).filter_map(|line| line.strip_prefix("pub fn "));
    lines.filter_map(|line| Some(line.split_once('(')?.0)).collect()
}

#[test]
fn e79_equal_names() {
    let object =
        |index: u16, name: &str| format!("[{index:04X}]\nParameterName={name}\nDataType=0x0007\nAccessType=rw\n");
    let record = "[2003]\nParameterName=Record\nObjectType=9\nSubNumber=3\n\
                  [2003sub0]\nParameterName=Count\nDataType=0x0005\nAccessType=ro\nDefaultValue=10\n\
                  [2003sub1]\nParameterName=PDO_MappingEntry\nDataType=0x0007\nAccessType=rw\n\
                  [2003subA]\nParameterName=PDO_MappingEntry\nDataType=0x0007\nAccessType=rw\n";
    let checked = read(&(object(0x2000, "Speed") + &object(0x2001, "speed") + record));
    let rust = checked.rust();
    let found = methods(&rust);
    for name in ["speed_2000", "speed_2001", "record", "count", "pdo_mapping_entry_1", "pdo_mapping_entry_10"] {
        assert!(found.contains(&name), "{name} among {found:?}");
    }
    assert!(!found.contains(&"speed"), "a further object of that name would take it away");
    // Neither the order in the file nor a further object changes a name.
    let other = read(&(object(0x2002, "SPEED") + record + &object(0x2001, "speed") + &object(0x2000, "Speed")));
    let rust = other.rust();
    let found = methods(&rust);
    for name in ["speed_2000", "speed_2001", "speed_2002", "pdo_mapping_entry_1", "pdo_mapping_entry_10"] {
        assert!(found.contains(&name), "{name} among {found:?}");
    }
    assert_eq!(checked.names(0x2003), ["Count", "PDO_MappingEntry", "PDO_MappingEntry"]);
    assert_eq!((checked.codes(), other.codes()), (vec![], vec![]));
}

#[test]
fn e80_names_that_are_no_identifiers() {
    let long = "very ".repeat(50) + "long";
    for (name, method) in [
        ("Gerätetemperatur", "geraetetemperatur"),
        ("Zeit µs", "zeit_us"),
        ("Winkel °", "winkel_deg"),
        ("Ein/Aus", "ein_aus"),
        ("50% duty", "_50_percent_duty"),
        ("2nd encoder", "_2nd_encoder"),
        ("type", "r#type"),
        ("self", "self_2000"),
        ("?!", "object_2000"),
        (long.as_str(), "very_very_very_very_very_very_very_very_very"),
    ] {
        let checked = read(&format!("[2000]\nParameterName={name}\nDataType=0x0007\nAccessType=rw\n"));
        let rust = checked.rust();
        assert!(methods(&rust).iter().any(|found| found.starts_with(method)), "{method} among {:?}", methods(&rust));
        let shown = name.trim_end_matches(['?', '!']).trim();
        assert!(rust.lines().any(|line| line.contains("///") && line.contains(shown)), "{name} is in the docs");
        assert_eq!(checked.group(0x2000).name, name);
        // A name of 269 characters makes a line of over 255.
        let codes: &[&str] = if name.len() > 200 { &["EDS009"] } else { &[] };
        assert_eq!(checked.codes(), codes, "{name}");
    }
    let empty = read("[2000]\nParameterName=\nDataType=0x0007\nAccessType=rw\n");
    assert!(methods(&empty.rust()).contains(&"object_2000"));
    assert_eq!(empty.codes(), ["EDS038"]);
    assert_eq!(empty.places("EDS038"), [(2, 1)]);
}

#[test]
fn e81_types_and_short_indices_among_the_objects() {
    let twice = read(&format!("{}[ManufacturerObjects]\nSupportedObjects=2\n1=0x2000\n2=0x2000\n", var(U8, "")));
    assert_eq!(twice.codes(), ["EDS044"]);
    assert_eq!(twice.places("EDS044"), [(10, 3)]);
    // An object that is no type, in the area of types.
    let object = read(
        "[0100]\nParameterName=Speed\nObjectType=7\nDataType=0x0005\nAccessType=ro\n\
         [OptionalObjects]\nSupportedObjects=0\n",
    );
    assert_eq!(object.codes(), ["EDS068"]);
    assert_eq!(object.places("EDS068"), [(1, 2)]);
    // A type that is listed like an object.
    let listed = read("[00A0]\nParameterName=Speed\nObjectType=5\n[OptionalObjects]\nSupportedObjects=1\n1=0x00A0\n");
    assert_eq!(listed.codes(), ["EDS045"]);
    assert_eq!(listed.places("EDS045"), [(6, 3)]);
    for short in ["A0", "0A0"] {
        let checked = read(&format!("[{short}]\nParameterName=Speed\nObjectType=5\n"));
        assert_eq!(checked.group(0xA0).object_code(), Some(ObjectCode::DefType));
        assert_eq!(checked.codes(), ["EDS010"], "{short}");
        assert_eq!(checked.places("EDS010"), [(1, 2)]);
        assert_eq!(checked.only("EDS010").fix.as_deref(), Some("00A0"));
    }
}

#[test]
fn e82_granularity_is_a_number() {
    for (text, granularity, codes) in [
        ("8", Some(8), &[][..]),
        ("0", Some(0), &[]),
        ("1", Some(1), &[]),
        ("64", Some(64), &[]),
        ("", None, &[]),
        ("65", Some(65), &["EDS064"]),
        ("256", None, &["EDS022"]),
        ("true", None, &["EDS022"]),
    ] {
        let checked = read(&format!("{DEVICE}Granularity={text}\n"));
        assert_eq!(checked.device().canopen.as_ref().unwrap().granularity, granularity, "{text}");
        assert_eq!(checked.codes(), codes, "{text}");
        codes.iter().for_each(|code| assert_eq!(checked.places(code), [(7, 13)], "{text}"));
    }
}
