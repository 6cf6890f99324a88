//! G03, G04, G09, G10, G13 to G15, G17, G18, G20: what a file consists of.

use lexibus_codegen::compile::{check, Options};
use lexibus_codegen::ir::{Numbers, SubmoduleKind, Value};
use lexibus_codegen::source::Source;

use crate::support::*;

fn module(id: &str, ident: &str, content: &str) -> String {
    format!(
        "<ModuleItem ID=\"{id}\" ModuleIdentNumber=\"{ident}\">\n<ModuleInfo><Name TextId=\"T_Speed\"/></ModuleInfo>\n\
         {content}</ModuleItem>\n"
    )
}

/// The numbers that a list names.
fn numbers(list: &Numbers) -> Vec<u16> {
    list.iter().collect()
}

#[test]
fn g03_ident_numbers_of_any_length() {
    for (written, ident) in [("0x430", 0x430), ("0x0130", 0x130), ("0x00000001", 1), ("0xFFFFFFFF", u32::MAX)] {
        let checked = read(&Parts { modules: &module("MOD", written, ""), ..Parts::default() });
        assert_eq!(checked.catalog().modules[0].number, ident);
        checked.assert_clean();
    }
    // Without its prefix it is taken for what it can only mean.
    let checked = read(&Parts { modules: &module("MOD", "000A", ""), ..Parts::default() });
    assert_eq!(checked.catalog().modules[0].number, 10);
    checked.assert_only("GSD005", "ModuleIdentNumber=\"|000A\"");
    let checked = read(&Parts { modules: &module("MOD", "0x1FFFFFFFF", ""), ..Parts::default() });
    checked.assert_only("GSD005", "|0x1FFFFFFFF");
}

#[test]
fn g04_lists_of_slots() {
    let modules = module("MOD", "0x2", "");
    let used = |places: &str| {
        let device =
            format!("<UseableModules>\n<ModuleItemRef ModuleItemTarget=\"MOD\" {places}/>\n</UseableModules>\n");
        read(&Parts { device: &device, modules: &modules, ..Parts::default() })
    };
    let checked = used("AllowedInSlots=\"1..3 4\" FixedInSlots=\"1 2\" UsedInSlots=\"3\"");
    let own = &checked.device().modules[0];
    assert_eq!(own.places.allowed.0.as_slice(), [(1, 3), (4, 4)]);
    assert_eq!((numbers(&own.places.allowed), numbers(&own.places.fixed)), (vec![1, 2, 3, 4], vec![1, 2]));
    assert_eq!(numbers(&own.places.used), [3]);
    assert_eq!(
        (numbers(&checked.settings().slots), numbers(&checked.settings().places.fixed)),
        ((0..=4).collect(), vec![0])
    );
    checked.assert_clean();
    for (list, numbers_of) in [("3..1", vec![1, 2, 3]), ("1 x 3", vec![1, 3]), ("70000", vec![])] {
        let checked = used(&format!("AllowedInSlots=\"{list}\""));
        assert_eq!(numbers(&checked.device().modules[0].places.allowed), numbers_of);
        checked.assert_only("GSD005", &format!("AllowedInSlots=\"|{list}"));
    }
    // Slots that the device doesn't have.
    let checked = used("AllowedInSlots=\"3..5\"");
    checked.assert_only("GSD020", "|<DeviceAccessPointItem ID");
}

#[test]
fn g09_one_identifier_for_elements_of_different_kinds() {
    let modules = module(
        "1",
        "0x2",
        "<VirtualSubmoduleList>\n<VirtualSubmoduleItem ID=\"1\" SubmoduleIdentNumber=\"0x1\">\n<IOData/>\n\
         </VirtualSubmoduleItem>\n</VirtualSubmoduleList>\n",
    );
    let submodules = "<SubmoduleItem ID=\"1\" SubmoduleIdentNumber=\"0x1\">\n<IOData/>\n\
                      <ModuleInfo CategoryRef=\"1\"><Name TextId=\"T_Torque\"/></ModuleInfo>\n</SubmoduleItem>\n";
    let lists = "<ValueList>\n<ValueItem ID=\"1\"/>\n</ValueList>\n<GraphicsList>\n\
                 <GraphicItem ID=\"1\" GraphicFile=\"pump\"/>\n</GraphicsList>\n<CategoryList>\n\
                 <CategoryItem ID=\"1\" TextId=\"T_Mode\"/>\n</CategoryList>\n";
    let device = "<UseableModules><ModuleItemRef ModuleItemTarget=\"1\"/></UseableModules>\n\
                  <UseableSubmodules><SubmoduleItemRef SubmoduleItemTarget=\"1\" AllowedInSubslots=\"2\"/>\
                  </UseableSubmodules>\n<Graphics><GraphicItemRef Type=\"DeviceIcon\" GraphicItemTarget=\"1\"/></Graphics>\n";
    let parts = Parts { device, modules: &modules, submodules, lists, ..Parts::default() };
    let checked = read(&parts);
    let catalog = checked.catalog();
    assert_eq!(checked.device().modules[0].module.0, 0);
    let pluggable = checked.device().submodules.last().expect("a submodule");
    assert_eq!(catalog.submodules[pluggable.submodule.0 as usize].name, "Torque");
    assert_eq!((catalog.graphics[0].file.as_str(), catalog.families[0].name.as_str()), ("pump", "Mode"));
    checked.assert_clean();
    // Of one kind, the first counts.
    let twice = modules.clone() + &module("1", "0x3", "").replace("T_Speed", "T_Fault");
    let checked = read(&Parts { modules: &twice, ..parts });
    assert_eq!(checked.device().modules[0].module.0, 0);
    checked.assert_only("GSD010", "<ModuleItem ID=\"|1\" ModuleIdentNumber=\"0x3\"");
}

#[test]
fn g10_several_device_access_points() {
    let text = file(&Parts { modules: &(module("A", "0x2", "") + &module("B", "0x3", "")), ..Parts::default() });
    let second = "<DeviceAccessPointItem ID=\"DAP 2\" ModuleIdentNumber=\"0x9\" PhysicalSlots=\"0..1\" FixedInSlots=\"0\">\n\
                  <ModuleInfo><Name TextId=\"T_Mode\"/></ModuleInfo>\n<UseableModules>\n\
                  <ModuleItemRef ModuleItemTarget=\"B\" AllowedInSlots=\"1\"/>\n\
                  <ModuleItemRef ModuleItemTarget=\"A\" FixedInSlots=\"1\"/>\n</UseableModules>\n</DeviceAccessPointItem>\n";
    let text = text.replace("</DeviceAccessPointList>", &format!("{second}</DeviceAccessPointList>"));
    let text = text.replace(
        "<VirtualSubmoduleList>",
        "<UseableModules>\n<ModuleItemRef ModuleItemTarget=\"A\"/>\n</UseableModules>\n<VirtualSubmoduleList>",
    );
    let checked = read_as(&text, &Options::default());
    checked.assert_clean();
    let [first, second] = &checked.catalog().devices[..] else { panic!("not two devices") };
    assert_eq!((first.name.as_str(), second.name.as_str()), ("Device", "Mode"));
    let modules = |device: &lexibus_codegen::ir::Device| -> Vec<String> {
        device.own_modules(&checked.catalog().modules).map(|module| module.id.to_string()).collect()
    };
    // Modules are shared, their places aren't.
    assert_eq!((modules(first), modules(second)), (vec!["A".to_owned()], vec!["B".to_owned(), "A".to_owned()]));
    assert!(first.modules[0].places.fixed.is_empty() && second.modules[1].places.fixed.contains(1));
    for device in [first, second] {
        assert_eq!((device.identity.vendor_id, device.identity.product_code), (Some(0xFFF), Some(1)));
        assert_eq!(device.identity.vendor_name, "Maker");
    }
    assert_eq!(second.identity.others, [("module_ident".into(), 9)]);
    assert_eq!(second.profinet.as_ref().unwrap().ident, 9);
}

#[test]
fn g13_elements_of_later_versions() {
    let submodule = "<IOData>\n<Input>\n<DataItem DataType=\"Unsigned16\" TextId=\"T_Speed\"/>\n\
                     <DataItem DataType=\"Unsigned8\" TextId=\"T_Mode\"/>\n\
                     <Channel Number=\"3\">\n<Data BitOffset=\"0\" BitLength=\"16\"/>\n\
                     <Quality BitOffset=\"16\" Format=\"Qualifier\" OppositeDirection=\"true\"/>\n</Channel>\n\
                     </Input>\n</IOData>\n<NewThing Colour=\"red\"><Part>x</Part></NewThing>\n";
    let checked = read_with(&Parts { submodule, device_attributes: "NewFlag=\"1\"", ..Parts::default() }, &["GSD004"]);
    let [channel] = &checked.input().channels[..] else { panic!("not one channel") };
    assert_eq!((channel.number, channel.data, channel.quality), (3, Some((0, 16)), Some((16, 1))));
    assert_eq!(channel.quality_format, "Qualifier");
    assert_eq!(value_of(&channel.attributes, "OppositeDirection"), Some("true"));
    assert_eq!(value_of(&checked.settings().attributes, "NewFlag"), Some("1"));
    let extensions = &checked.submodule("SUB").extensions;
    assert_eq!(extension(extensions, "VirtualSubmoduleItem/NewThing@Colour"), Some("red"));
    assert_eq!(extension(extensions, "NewThing/Part"), Some("x"));
    checked.assert_only("GSD004", "<|NewThing Colour");
    read(&Parts { submodule, ..Parts::default() }).assert_clean();
}

#[test]
fn g14_old_versions() {
    // No ProfileHeader, no name of the virtual submodule, no IDs of interface and port, relations at the device access point.
    let device = "<SystemDefinedSubmoduleList>\n\
                  <InterfaceSubmoduleItem SubmoduleIdentNumber=\"0x8000\" TextId=\"T_Mode\" SupportedRT_Class=\"Class1\"/>\n\
                  <PortSubmoduleItem SubmoduleIdentNumber=\"0x8001\" SubslotNumber=\"32769\" TextId=\"T_Off\"/>\n\
                  </SystemDefinedSubmoduleList>\n\
                  <ApplicationRelations AR_BlockVersion=\"1\">\n<TimingProperties SendClock=\"32 64\"/>\n\
                  </ApplicationRelations>\n";
    let text = file(&Parts { device, ..Parts::default() });
    let text = text.replace("<IOData/>\n<ModuleInfo><Name TextId=\"T_Device\"/></ModuleInfo>\n", "<IOData/>\n");
    let text = text.replace("ID=\"DAP\"", "RequiredSchemaVersion=\"V1.0\" ID=\"DAP\"");
    let checked = read_as(&text, &Options::default());
    checked.assert_clean();
    let settings = checked.settings();
    assert_eq!(value_of(&settings.attributes, "RequiredSchemaVersion"), Some("V1.0"));
    assert_eq!(value_of(&settings.attributes, "ApplicationRelations@AR_BlockVersion"), Some("1"));
    assert_eq!((settings.startup_modes.as_slice(), settings.relations), (&["Legacy".into()][..], 1));
    assert_eq!((numbers(&settings.send_clocks), settings.max_record_size), (vec![32, 64], 4068));
    let kinds: Vec<_> = checked.catalog().submodules.iter().map(|found| (found.kind, found.name.as_str())).collect();
    let expected = [(SubmoduleKind::Interface, "Mode"), (SubmoduleKind::Port, "Off"), (SubmoduleKind::Virtual, "")];
    assert_eq!(kinds, expected);
    let subslots: Vec<Vec<u16>> = checked.device().submodules.iter().map(|own| numbers(&own.places.fixed)).collect();
    assert_eq!(subslots, [[0x8000], [0x8001], [1]]);
    assert_eq!(checked.submodule("SUB").api, 0);
    // Without any of it, the defaults of the schema hold.
    let checked = read(&Parts::default());
    assert_eq!(numbers(&checked.settings().send_clocks), [32]);
}

#[test]
fn g15_malformed_files() {
    let text = file(&Parts::default());
    let cut: String = text.lines().take(12).map(|line| format!("{line}\n")).collect();
    for (text, place) in [
        (text.replace("</PrimaryLanguage>", "</Language>"), (36, 1)),
        (text.replace("<Name TextId=\"T_Device\"/>\n<InfoText", "<Name TextId=T_Device/>\n<InfoText"), (13, 7)),
        (cut, (12, 13)),
        (String::new(), (1, 1)),
    ] {
        let compilation = check(Source::new(NAME, text.clone().into_bytes()), &Options::default());
        assert!(compilation.catalog.is_none());
        let [error] = compilation.diagnostics.list() else { panic!("not one finding in\n{text}") };
        let found = compilation.sources[0].position(error.span.start);
        let code = if text.is_empty() { "IO002" } else { "XML001" };
        assert_eq!((error.code.id, (found.line, found.column)), (code, place), "{}", error.message);
        assert_eq!(error.severity.name(), "error");
    }
}

#[test]
fn g17_lists_of_tokens_and_large_records() {
    let interface = |relations: &str| {
        format!(
            "<SystemDefinedSubmoduleList>\n<InterfaceSubmoduleItem ID=\"IF\" SubmoduleIdentNumber=\"0x8000\" \
             TextId=\"T_Mode\" SupportedProtocols=\"SNMP;LLDP\">\n<ApplicationRelations {relations}>\n\
             <TimingProperties SendClock=\"32 64\" ReductionRatio=\"1 2 4\"/>\n</ApplicationRelations>\n\
             </InterfaceSubmoduleItem>\n</SystemDefinedSubmoduleList>\n"
        )
    };
    for (relations, modes, count) in [
        ("StartupMode=\"Legacy;Advanced\" NumberOfAR=\"2\"", &["Legacy", "Advanced"][..], 2),
        ("StartupMode=\"Advanced\"", &["Advanced"], 1),
        ("NumberOfAdditionalInputCR=\"1\"", &["Legacy"], 1),
    ] {
        let checked = read(&Parts { device: &interface(relations), ..Parts::default() });
        let settings = checked.settings();
        assert_eq!(settings.startup_modes, modes);
        assert_eq!((settings.relations, numbers(&settings.reduction_ratios)), (count, vec![1, 2, 4]));
        assert_eq!(value_of(&checked.submodule("IF").attributes, "SupportedProtocols"), Some("SNMP;LLDP"));
        checked.assert_clean();
    }
    let submodule = "<IOData/>\n<RecordDataList>\n<ParameterRecordDataItem Index=\"1\" Length=\"5000\">\n\
                     <Name TextId=\"T_Mode\"/>\n</ParameterRecordDataItem>\n</RecordDataList>\n";
    let large = read(&Parts { submodule, device_attributes: "MaxSupportedRecordSize=\"8192\"", ..Parts::default() });
    assert_eq!((large.settings().max_record_size, large.record().length), (8192, 5000));
    large.assert_clean();
    read(&Parts { submodule, ..Parts::default() }).assert_only("GSD019", "<ParameterRecordDataItem");
}

#[test]
fn g18_apis_of_profiles() {
    let submodules: String = [14848u32, 23296, 0]
        .iter()
        .map(|api| {
            format!(
                "<SubmoduleItem ID=\"S{api}\" SubmoduleIdentNumber=\"0x1\" API=\"{api}\">\n<IOData/>\n\
                 <ModuleInfo><Name TextId=\"T_Speed\"/></ModuleInfo>\n</SubmoduleItem>\n"
            )
        })
        .collect();
    let checked = read(&Parts { submodules: &submodules, ..Parts::default() });
    let apis = ["S14848", "S23296", "S0"].map(|id| checked.submodule(id).api);
    assert_eq!(apis, [0x3A00, 0x5B00, 0]);
    checked.assert_clean();
}

#[test]
fn g20_diagnosis_of_profiles_and_isochronous_submodules() {
    let submodule = "<IOData/>\n<IsochroneMode T_DC_Base=\"8\" T_DC_Min=\"1\" IsochroneModeRequired=\"true\"/>\n\
                     <PROFIenergy ProfileVersion=\"V1.3\">\n<EnergySavingModeList>\n<EnergySavingModeItem ID=\"1\"/>\n\
                     </EnergySavingModeList>\n</PROFIenergy>\n";
    let lists =
        "<ChannelDiagList>\n<ProfileChannelDiagItem API=\"14848\" ErrorType=\"36864\">\n<Name TextId=\"T_Fault\"/>\n\
                 <Help TextId=\"T_Help\"/>\n</ProfileChannelDiagItem>\n</ChannelDiagList>\n";
    let checked = read(&Parts { submodule, lists, ..Parts::default() });
    checked.assert_clean();
    let attributes = &checked.submodule("SUB").attributes;
    assert_eq!(value_of(attributes, "IsochroneMode@T_DC_Base"), Some("8"));
    assert_eq!(value_of(attributes, "EnergySavingModeItem@ID"), Some("1"));
    let row = &checked.table("channel_diagnosis").rows[0];
    assert_eq!((row.code, row.name.as_str(), &row.cells[1]), (0x9000, "Fault", &Value::Int(0x3A00)));
    assert_eq!(row.documentation.as_ref().unwrap().text, "Help");
}
