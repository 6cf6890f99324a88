//! Diagnostics that no quirk calls for, and input that nobody would write by hand.

use lexibus_codegen::compile::{check, Options};
use lexibus_codegen::diagnostics::{codes, Diagnostics};
use lexibus_codegen::frontend::gsdml;
use lexibus_codegen::source::{FileId, Source};

use crate::support::*;

#[test]
fn another_root() {
    let source = Source::new(NAME, b"<a>\n<b/></a>".to_vec());
    let mut diagnostics = Diagnostics::default();
    assert!(gsdml::read(&source, FileId(0), &mut diagnostics).is_none());
    let [error] = diagnostics.list() else { panic!("not one finding") };
    assert_eq!((error.code.id, source.position(error.span.start).column), ("GSD001", 2));
}

#[test]
fn no_device_access_point() {
    let text = file(&Parts::default());
    let (start, rest) = text.split_once("<DeviceAccessPointItem").unwrap();
    let (_, end) = rest.split_once("</DeviceAccessPointItem>").unwrap();
    let checked = read_as(&format!("{start}{end}"), &Options::default());
    assert!(checked.catalog().devices.is_empty());
    checked.assert_only("GSD002", "<|ISO15745Profile xmlns");
}

#[test]
fn attributes_in_another_case() {
    let text = file(&Parts::default()).replace("VendorID=", "VendorId=");
    let checked = read_as(&text, &Options::default());
    assert_eq!(checked.device().identity.vendor_id, Some(0xFFF));
    let found = checked.assert_only("GSD007", "<DeviceIdentity |VendorId");
    assert_eq!(found.fix.as_deref(), Some("VendorID"));
}

#[test]
fn mandatory_attributes() {
    let text = file(&Parts::default());
    for (written, place) in [
        ("VendorID=\"0x0FFF\" ", "<|DeviceIdentity"),
        ("DeviceID=\"0x0001\"", "<|DeviceIdentity"),
        ("ID=\"DAP\" ", "<|DeviceAccessPointItem"),
        ("ModuleIdentNumber=\"0x00000001\" ", "<|DeviceAccessPointItem"),
        (" SubmoduleIdentNumber=\"0x00000001\"", "<|VirtualSubmoduleItem"),
        ("ID=\"SUB\" ", "<|VirtualSubmoduleItem"),
        ("<VendorName Value=\"Maker\"/>", ""),
    ] {
        let checked = read_as(&text.replace(written, ""), &Options::default());
        if place.is_empty() {
            checked.assert_clean();
        } else {
            checked.assert_only("GSD006", place);
        }
    }
    let checked = read_as(&text.replace(" Value=\"Maker\"", ""), &Options::default());
    checked.assert_only("GSD006", "<|VendorName");
}

#[test]
fn elements_that_occur_twice() {
    let submodule = "<IOData>\n<Input>\n<DataItem DataType=\"Unsigned8\" TextId=\"T_Speed\"/>\n</Input>\n<Input>\n\
                     <DataItem DataType=\"Unsigned16\" TextId=\"T_Mode\"/>\n</Input>\n</IOData>\n";
    let checked = read(&Parts { submodule, ..Parts::default() });
    assert_eq!(checked.fields(), [("Mode", 0, 16)]);
    checked.assert_only("GSD010", "</Input>\n|<Input>");
}

#[test]
fn numbers_and_kinds_of_consistency() {
    let submodule = "<IOData>\n<Input Consistency=\"Some\">\n<DataItem DataType=\"Unsigned8\" TextId=\"T_Speed\"/>\n</Input>\n</IOData>\n";
    read(&Parts { submodule, ..Parts::default() }).assert_only("GSD005", "|Some");
    let checked = read(&Parts { device_attributes: "MinDeviceInterval=\"0x20\"", ..Parts::default() });
    assert_eq!(checked.settings().min_device_interval, Some(32));
    let found = checked.assert_only("GSD005", "|0x20");
    assert_eq!(found.fix.as_deref(), Some("32"));
    read(&Parts { device_attributes: "MinDeviceInterval=\"65536\"", ..Parts::default() })
        .assert_only("GSD005", "|65536");
}

#[test]
fn references_that_lead_nowhere() {
    let device = "<UseableModules>\n<ModuleItemRef ModuleItemTarget=\"M\"/>\n</UseableModules>\n<UseableSubmodules>\n\
                  <SubmoduleItemRef SubmoduleItemTarget=\"S\"/>\n</UseableSubmodules>\n";
    let checked = read(&Parts { device, ..Parts::default() });
    assert!(checked.device().modules.is_empty() && checked.device().submodules.len() == 1);
    let expected = [checked.place_of("ModuleItemTarget=\"|M"), checked.place_of("SubmoduleItemTarget=\"|S")];
    assert_eq!(checked.places("GSD011"), expected);
}

#[test]
fn submodules_in_one_subslot() {
    let item = |id: &str, more: &str| {
        format!(
            "<VirtualSubmoduleItem ID=\"{id}\" SubmoduleIdentNumber=\"0x1\" {more}><IOData/></VirtualSubmoduleItem>\n"
        )
    };
    let modules = |second: &str| {
        format!(
            "<ModuleItem ID=\"M\" ModuleIdentNumber=\"0x2\" PhysicalSubslots=\"1..2\">\n<ModuleInfo><Name TextId=\"T_Mode\"/>\
             </ModuleInfo>\n<SubslotList>\n<SubslotItem SubslotNumber=\"2\" TextId=\"T_On\"/>\n</SubslotList>\n\
             <VirtualSubmoduleList>\n{}{}</VirtualSubmoduleList>\n</ModuleItem>\n",
            item("A", ""),
            item("B", second)
        )
    };
    let checked = read(&Parts { modules: &modules("FixedInSubslots=\"2\""), ..Parts::default() });
    checked.assert_clean();
    let module = &checked.catalog().modules[0];
    assert_eq!((module.subslot_names[0].number, module.subslot_names[0].name.as_str()), (2, "On"));
    assert_eq!(module.subslots.0.as_slice(), [(1, 2)]);
    let checked = read(&Parts { modules: &modules(""), ..Parts::default() });
    checked.assert_only("GSD021", "|<VirtualSubmoduleItem ID=\"B\"");
}

#[test]
fn slots_with_names() {
    let device = "<SlotList>\n<SlotItem SlotNumber=\"3\" TextId=\"T_Torque\"/>\n</SlotList>\n<SubslotList>\n\
                  <SubslotItem SubslotNumber=\"32768\" TextId=\"T_On\"/>\n</SubslotList>\n\
                  <CertificationInfo ConformanceClass=\"B\" ApplicationClass=\"\"/>\n";
    let checked = read(&Parts { device, ..Parts::default() });
    checked.assert_clean();
    let slot = &checked.device().slots[0];
    assert_eq!((slot.number, slot.name.as_str()), (3, "Torque"));
    assert_eq!(checked.settings().subslot_names[0].name, "On");
    assert_eq!(value_of(&checked.settings().attributes, "CertificationInfo@ConformanceClass"), Some("B"));
}

/// Every code of the family is the subject of some test here: the codes that the tests' sources name.
#[test]
fn every_code_is_tested() {
    let sources = [
        include_str!("text.rs"),
        include_str!("structure.rs"),
        include_str!("data.rs"),
        include_str!("records.rs"),
        include_str!("lists.rs"),
        include_str!("rest.rs"),
    ];
    for code in codes::CODES.iter().filter(|code| code.id.starts_with("GSD")) {
        let quoted = format!("\"{}\"", code.id);
        assert!(sources.iter().any(|source| source.contains(&quoted)), "{} is tested nowhere", code.id);
    }
}

/// A file with everything in it, cut off or damaged anywhere, ends in an error at worst.
#[test]
fn damage_anywhere_is_no_reason_to_panic() {
    let submodule = record_list(
        "<Const Data=\"0x01,0x02\"/>\n<Ref DataType=\"BitArea\" ByteOffset=\"3\" BitOffset=\"1\" BitLength=\"9\" DefaultValue=\"1\" \
         AllowedValues=\"0 2..7\" TextId=\"T_Speed\" ValueItemTarget=\"V\"/>",
    )
    .replace(
        "<IOData/>",
        "<IOData><Input><DataItem DataType=\"Unsigned16\" UseAsBits=\"true\" TextId=\"T_On\"><BitDataItem BitOffset=\"9\" \
         TextId=\"T_Off\"/></DataItem><DataItem DataType=\"OctetString_S\" Length=\"3\" TextId=\"T_On\"/></Input></IOData>",
    );
    let lists = "<ValueList><ValueItem ID=\"V\"><Assignments><Assign TextId=\"T_On\" Content=\"1..3\"/></Assignments>\
                 </ValueItem></ValueList>\n<LogBookEntryList><LogBookEntryItem Status=\"5\"/></LogBookEntryList>\n";
    let text = file(&Parts { submodule: &submodule, lists, ..Parts::default() });
    for at in (0..text.len()).step_by(3) {
        let Some(cut) = text.get(..at) else { continue };
        check(Source::new(NAME, cut.as_bytes().to_vec()), &Options::default());
    }
    for (at, _) in text.match_indices(|letter: char| letter.is_ascii_digit()) {
        for digit in ["-", "99999999999", ".", "\u{e4}", ""] {
            let mut damaged = text.clone();
            damaged.replace_range(at..=at, digit);
            check(Source::new(NAME, damaged.into_bytes()), &Options::default());
        }
    }
}
