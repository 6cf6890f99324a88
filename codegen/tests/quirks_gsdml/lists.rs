//! Safety, diagnosis, log book and the other lists of a file.

use lexibus_codegen::ir::{Shape, Type, Value};

use crate::support::*;

/// An F-parameter record with these parameters.
fn f_record(parameters: &str) -> Checked {
    let submodule = format!(
        "<IOData/>\n<RecordDataList>\n<F_ParameterRecordDataItem Index=\"256\" F_ParamDescCRC=\"37734\" \
         F_SupportedParameters=\"F_SIL;F_CRC_Length\">\n{parameters}</F_ParameterRecordDataItem>\n</RecordDataList>\n"
    );
    read(&Parts { submodule: &submodule, ..Parts::default() })
}

const PLAIN: &str = "<F_Check_iPar/>\n<F_SIL/>\n<F_CRC_Length/>\n<F_Block_ID/>\n<F_Par_Version/>\n<F_Source_Add/>\n\
                     <F_Dest_Add/>\n<F_WD_Time/>\n<F_Par_CRC/>\n";

#[test]
fn f_parameters_have_the_defaults_of_the_schema() {
    let checked = f_record(PLAIN);
    checked.assert_clean();
    let found = checked.submodule("SUB").f_parameters.as_ref().expect("F-parameters");
    assert_eq!((found.index, found.transfer_sequence, found.description_crc), (256, 0, Some(37734)));
    let facts: Vec<_> = found
        .parameters
        .iter()
        .map(|own| (own.name.as_str(), own.label.as_str(), own.default, own.changeable, own.visible))
        .collect();
    let expected = [
        ("F_Check_iPar", "NoCheck", 0, false, false),
        ("F_SIL", "SIL3", 2, true, true),
        ("F_CRC_Length", "3-Byte-CRC", 0, false, false),
        ("F_Block_ID", "", 0, false, true),
        ("F_Par_Version", "", 1, false, true),
        ("F_Source_Add", "", 1, true, true),
        ("F_Dest_Add", "", 1, true, true),
        ("F_WD_Time", "", 150, true, true),
        ("F_Par_CRC", "", 53356, true, true),
    ];
    assert_eq!(facts, expected);
    assert_eq!(found.parameters[1].allowed_labels, ["SIL1", "SIL2", "SIL3", "NoSIL"]);
    assert_eq!(found.parameters[6].allowed, [(1, 65534)]);
    let attributes = &checked.submodule("SUB").attributes;
    assert_eq!(value_of(attributes, "F_ParameterRecordDataItem@F_SupportedParameters"), Some("F_SIL;F_CRC_Length"));
}

#[test]
fn f_parameters_as_they_are_written() {
    let parameters = PLAIN
        .replace("<F_SIL/>", "<F_SIL DefaultValue=\"SIL2\" AllowedValues=\"SIL1 SIL2\" Changeable=\"false\"/>")
        .replace("<F_WD_Time/>", "<F_WD_Time DefaultValue=\"125\" AllowedValues=\"10..60000\"/>")
        + "<F_iPar_CRC DefaultValue=\"1761318422\"/>\n";
    let checked = f_record(&parameters);
    checked.assert_clean();
    let found = checked.submodule("SUB").f_parameters.as_ref().expect("F-parameters");
    let of = |name: &str| found.parameters.iter().find(|own| own.name == name).expect("a parameter");
    assert_eq!((of("F_SIL").label.as_str(), of("F_SIL").default, of("F_SIL").changeable), ("SIL2", 1, false));
    assert_eq!(of("F_SIL").allowed_labels, ["SIL1", "SIL2"]);
    assert_eq!((of("F_WD_Time").default, of("F_WD_Time").allowed.as_slice()), (125, &[(10, 60000)][..]));
    assert_eq!(of("F_iPar_CRC").default, 1_761_318_422);
}

#[test]
fn f_parameters_with_faults() {
    let with = |from: &str, to: &str| f_record(&PLAIN.replace(from, to));
    with("<F_SIL/>", "<F_SIL DefaultValue=\"SIL9\"/>").assert_only("GSD005", "|SIL9");
    with("<F_SIL/>", "<F_SIL AllowedValues=\"SIL1 SIL9\"/>").assert_only("GSD005", "|SIL1 SIL9");
    with("<F_WD_Time/>", "<F_WD_Time DefaultValue=\"x\"/>").assert_only("GSD005", "\"|x\"");
    with("<F_WD_Time/>", "<F_WD_Time AllowedValues=\"a..b\"/>").assert_only("GSD005", "|a..b");
    let checked = with("<F_WD_Time/>\n", "");
    let found = checked.submodule("SUB").f_parameters.as_ref().expect("F-parameters");
    assert_eq!((found.parameters[7].name.as_str(), found.parameters[7].default), ("F_WD_Time", 150));
    checked.assert_only("GSD006", "<|F_ParameterRecordDataItem");
}

#[test]
fn channel_diagnosis() {
    let lists = "<ChannelDiagList>\n<ChannelDiagItem ErrorType=\"256\" MaintenanceAlarmState=\"D;MR\">\n\
                 <Name TextId=\"T_Fault\"/>\n<Help TextId=\"T_Help\"/>\n<ExtChannelDiagList>\n\
                 <ExtChannelDiagItem ErrorType=\"1\">\n<Name TextId=\"T_Off\"/>\n<ExtChannelAddValue>\n\
                 <DataItem Id=\"1\" DataType=\"Unsigned16\"/>\n<DataItem Id=\"2\" DataType=\"Float32\"/>\n\
                 </ExtChannelAddValue>\n</ExtChannelDiagItem>\n</ExtChannelDiagList>\n</ChannelDiagItem>\n\
                 <SystemDefinedChannelDiagItem ErrorType=\"16\">\n<ExtChannelDiagList>\n\
                 <ProfileExtChannelDiagItem API=\"14848\" ErrorType=\"36865\">\n<Name TextId=\"T_On\"/>\n\
                 </ProfileExtChannelDiagItem>\n</ExtChannelDiagList>\n</SystemDefinedChannelDiagItem>\n</ChannelDiagList>\n";
    let checked = read(&Parts { lists, ..Parts::default() });
    checked.assert_clean();
    let table = checked.table("channel_diagnosis");
    assert_eq!(table.columns, ["maintenance_alarm_state", "api"]);
    let text = |text: &str| Value::Text(text.into());
    assert_eq!((table.rows[0].code, table.rows[0].name.as_str()), (256, "Fault"));
    assert_eq!(table.rows[0].cells, [text("D;MR"), Value::Int(0)]);
    assert_eq!((table.rows[1].code, table.rows[1].name.as_str()), (16, ""));
    let table = checked.table("extended_channel_diagnosis");
    assert_eq!(table.columns, ["error_type", "maintenance_alarm_state", "api", "add_value"]);
    let add = text("1 Unsigned16, 2 Float32");
    assert_eq!(table.rows[0].cells, [Value::Int(256), text("D"), Value::Int(0), add]);
    assert_eq!(table.rows[1].cells, [Value::Int(16), text("D"), Value::Int(0x3A00), text("")]);
}

#[test]
fn what_is_within_the_error_of_a_profile_is_that_profiles() {
    let lists = "<ChannelDiagList>\n<ProfileChannelDiagItem API=\"14848\" ErrorType=\"36864\">\n<Name TextId=\"T_Fault\"/>\n\
                 <ExtChannelDiagList>\n<ExtChannelDiagItem ErrorType=\"1\">\n<Name TextId=\"T_Off\"/>\n</ExtChannelDiagItem>\n\
                 </ExtChannelDiagList>\n</ProfileChannelDiagItem>\n\
                 <ChannelDiagItem ErrorType=\"256\">\n<Name TextId=\"T_On\"/>\n<ExtChannelDiagList>\n\
                 <ProfileExtChannelDiagItem API=\"14848\" ErrorType=\"2\">\n<Name TextId=\"T_Mode\"/>\n\
                 </ProfileExtChannelDiagItem>\n</ExtChannelDiagList>\n</ChannelDiagItem>\n</ChannelDiagList>\n";
    let checked = read(&Parts { lists, ..Parts::default() });
    checked.assert_clean();
    let rows = &checked.table("extended_channel_diagnosis").rows;
    let text = |text: &str| Value::Text(text.into());
    assert_eq!(rows[0].cells, [Value::Int(36864), text("D"), Value::Int(0x3A00), text("")]);
    let rust = lexibus_codegen::backend::rust::emit_catalog(checked.catalog(), &Default::default()).expect("bindings");
    let rust: String = rust.split_whitespace().collect();
    // Each error has a name, and what is within it.
    for part in [
        "of_profile(0x3A00,0x9000,\"Fault\",\"\",&[rt::profinet::ExtendedError::new(0x0001,\"Off\"",
        "of_profile(0x3A00,0x0100,\"On\",\"\",&[rt::profinet::ExtendedError::new(0x0002,\"Mode\"",
        "new(0x0100,\"On\",\"\",&[])",
    ] {
        assert!(rust.contains(part), "{part}\n{rust}");
    }
}

#[test]
fn process_alarms_and_log_book() {
    let lists = "<ChannelProcessAlarmList>\n<ChannelProcessAlarmItem Reason=\"256\">\n<Name TextId=\"T_Fault\"/>\n\
                 <ExtChannelProcessAlarmList>\n<ExtChannelProcessAlarmItem Reason=\"2\">\n<Name TextId=\"T_Off\"/>\n\
                 </ExtChannelProcessAlarmItem>\n</ExtChannelProcessAlarmList>\n</ChannelProcessAlarmItem>\n\
                 </ChannelProcessAlarmList>\n<LogBookEntryList>\n<LogBookEntryItem Status=\"2130510\">\n<ErrorCode2List>\n\
                 <ErrorCode2Item ErrorCode2=\"3\">\n<Name TextId=\"T_On\"/>\n</ErrorCode2Item>\n</ErrorCode2List>\n\
                 </LogBookEntryItem>\n<LogBookEntryItem Status=\"1\">\n<ErrorCode2Value>\n<Name TextId=\"T_Mode\"/>\n\
                 <Help TextId=\"T_Help\"/>\n</ErrorCode2Value>\n</LogBookEntryItem>\n</LogBookEntryList>\n";
    let checked = read(&Parts { lists, ..Parts::default() });
    checked.assert_clean();
    let row = &checked.table("process_alarms").rows[0];
    assert_eq!((row.code, row.name.as_str()), (256, "Fault"));
    let row = &checked.table("extended_process_alarms").rows[0];
    assert_eq!((row.code, row.name.as_str(), &row.cells[0]), (2, "Off", &Value::Int(256)));
    let rows = &checked.table("log_book").rows;
    assert_eq!((rows[0].code, rows[0].last, rows[0].name.as_str()), (0x2082_4E03, None, "On"));
    assert_eq!((rows[1].code, rows[1].last, rows[1].name.as_str()), (0x100, Some(0x1FF), "Mode"));
    assert_eq!(rows[1].documentation.as_ref().unwrap().text, "Help");
    let lists = "<LogBookEntryList>\n<LogBookEntryItem Status=\"16777216\"/>\n</LogBookEntryList>\n";
    read(&Parts { lists, ..Parts::default() }).assert_only("GSD005", "|16777216");
    let lists =
        "<ChannelDiagList>\n<ChannelDiagItem>\n<Name TextId=\"T_On\"/>\n</ChannelDiagItem>\n</ChannelDiagList>\n";
    read(&Parts { lists, ..Parts::default() }).assert_only("GSD006", "<|ChannelDiagItem>");
}

#[test]
fn diagnosis_of_user_structures() {
    let lists = "<ValueList>\n<ValueItem ID=\"V\">\n<Assignments>\n<Assign TextId=\"T_Fault\" Content=\"20480\"/>\n\
                 </Assignments>\n</ValueItem>\n</ValueList>\n<UnitDiagTypeList>\n\
                 <UnitDiagTypeItem UserStructureIdentifier=\"2\">\n<Name TextId=\"T_Mode\"/>\n\
                 <Ref DataType=\"Unsigned16\" ByteOffset=\"2\" TextId=\"T_Fault\" ValueItemTarget=\"V\" DefaultValue=\"20480\"/>\n\
                 <Ref DataType=\"Bit\" ByteOffset=\"4\" BitOffset=\"5\" TextId=\"T_On\"/>\n</UnitDiagTypeItem>\n\
                 <ProfileUnitDiagTypeItem API=\"14848\" UserStructureIdentifier=\"36865\">\n<Name TextId=\"T_Off\"/>\n\
                 </ProfileUnitDiagTypeItem>\n</UnitDiagTypeList>\n";
    let checked = read(&Parts { lists, ..Parts::default() });
    checked.assert_clean();
    let [own, profile] = &checked.catalog().unit_diagnoses[..] else { panic!("not two structures") };
    assert_eq!((own.api, own.identifier, own.name.as_str()), (0, 2, "Mode"));
    assert_eq!((profile.api, profile.identifier, profile.name.as_str()), (0x3A00, 0x9001, "Off"));
    let [word, bit] = &own.fields[..] else { panic!("not two fields") };
    assert_eq!((word.name.as_str(), word.bit_offset, word.bits, word.ty), ("Fault", 16, 16, Type::Unsigned(16)));
    assert_eq!(word.default, Some(Value::Int(20480)));
    let def = &checked.catalog().types[word.values.expect("values").0 as usize];
    assert!(matches!(&def.shape, Shape::Enumeration { values, .. } if values[0].name == "Fault"));
    assert_eq!((bit.bit_offset, bit.bits, bit.ty), (37, 1, Type::Boolean));
}

#[test]
fn categories_and_pictures() {
    let lists = "<GraphicsList>\n<GraphicItem ID=\"G\" GraphicFile=\"pump\">\n<Embedded><svg:svg><svg:path d=\"M0\"/></svg:svg>\
                 </Embedded>\n</GraphicItem>\n</GraphicsList>\n<CategoryList>\n<CategoryItem ID=\"C\" TextId=\"T_Mode\">\n\
                 <InfoText TextId=\"T_Help\"/>\n</CategoryItem>\n</CategoryList>\n";
    let modules =
        "<ModuleItem ID=\"M\" ModuleIdentNumber=\"0x2\">\n<ModuleInfo CategoryRef=\"C\" SubCategory1Ref=\"D\">\n\
                   <Name TextId=\"T_Speed\"/>\n<OrderNumber Value=\"4711\"/>\n<HardwareRelease Value=\"A\"/>\n\
                   <SoftwareRelease Value=\"V1\"/>\n</ModuleInfo>\n<Graphics>\n\
                   <GraphicItemRef Type=\"DeviceSymbol\" GraphicItemTarget=\"H\"/>\n</Graphics>\n</ModuleItem>\n";
    let checked = read(&Parts { lists, modules, ..Parts::default() });
    let catalog = checked.catalog();
    assert_eq!((catalog.families[0].id.as_str(), catalog.families[0].descriptions[0].text.as_str()), ("C", "Help"));
    assert_eq!((catalog.graphics[0].id.as_str(), catalog.graphics[0].file.as_str()), ("G", "pump"));
    let drawing = extension(&catalog.extensions, "GraphicItem/Embedded").expect("a drawing");
    assert!(drawing.starts_with("<Embedded>") && drawing.ends_with("</Embedded>"));
    let module = &catalog.modules[0];
    assert_eq!((module.version.as_str(), module.revision.as_str()), ("V1", "A"));
    assert_eq!(module.identity.order_code, "4711");
    assert_eq!(extension(&module.extensions, "CategoryRef"), Some("C"));
    assert_eq!(extension(&module.extensions, "GraphicItemRef@DeviceSymbol"), Some("H"));
    // Both references that lead nowhere are told.
    assert_eq!(checked.codes(), ["GSD011"; 2]);
    assert_eq!(
        checked.places("GSD011"),
        [checked.place_of("SubCategory1Ref=\"|D"), checked.place_of("GraphicItemTarget=\"|H")]
    );
}
