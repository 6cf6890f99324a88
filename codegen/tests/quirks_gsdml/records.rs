//! G05, G06, G11: parameter records.

use lexibus_codegen::compile::{check, Options};
use lexibus_codegen::ir::{Access, Binding, EnumValue, GroupKind, Limits, Shape, Type, TypeId, Value};
use lexibus_codegen::source::Source;

use crate::support::*;

fn ints(ranges: &[(i128, i128)]) -> Vec<(Value, Value)> {
    ranges.iter().map(|&(first, last)| (Value::Int(first), Value::Int(last))).collect()
}

#[test]
fn g05_allowed_values() {
    let limits = |data_type: &str, allowed: &str, default: &str| {
        let checked =
            parameter(&format!("DataType=\"{data_type}\" AllowedValues=\"{allowed}\" DefaultValue=\"{default}\""));
        checked.assert_clean();
        checked.parameter(0).limits.clone()
    };
    let of = |low: i128, high: i128, allowed: &[(i128, i128)]| Limits {
        low: Some(Value::Int(low)),
        high: Some(Value::Int(high)),
        allowed: ints(allowed).into(),
    };
    assert_eq!(limits("Unsigned8", "0 1 3", "3"), of(0, 3, &[(0, 0), (1, 1), (3, 3)]));
    assert_eq!(limits("Integer8", "-128..127", "-1"), of(-128, 127, &[]));
    assert_eq!(limits("Unsigned16", "200 0..100", "200"), of(0, 200, &[(200, 200), (0, 100)]));
    assert_eq!(limits("Unsigned64", "0..18446744073709551615", "0"), of(0, u64::MAX.into(), &[]));
    assert_eq!(limits("Bit", "0..1", "1"), of(0, 1, &[]));
    assert_eq!(limits("Unsigned8", "7", "7"), of(7, 7, &[]));
    let expected = Limits { low: Some(Value::Real(-1e38)), high: Some(Value::Real(1e38)), ..Limits::default() };
    assert_eq!(limits("Float32", "-1.0000e38..1.0000e38", "0"), expected);
    let steps = limits("Float64", "-0.5 0.5 1e3..2e3", "0.5");
    assert_eq!((steps.low, steps.high, steps.allowed.len()), (Some(Value::Real(-0.5)), Some(Value::Real(2e3)), 3));
}

#[test]
fn g05_allowed_values_with_faults() {
    let with = |allowed: &str, default: &str| {
        parameter(&format!("DataType=\"Unsigned8\" AllowedValues=\"{allowed}\" DefaultValue=\"{default}\""))
    };
    let checked = with("0 x 3", "0");
    assert_eq!(checked.parameter(0).limits.allowed, ints(&[(0, 0), (3, 3)]));
    checked.assert_only("GSD014", "AllowedValues=\"|0 x 3");
    // A default that is within the limits, but in a gap.
    with("0..3 7", "5").assert_only("EDS050", "DefaultValue=\"|5\"");
    with("0..3 7", "8").assert_only("EDS050", "DefaultValue=\"|8\"");
    let checked = with("9 5..3", "4");
    assert_eq!(checked.parameter(0).limits.allowed, ints(&[(9, 9), (3, 5)]));
    checked.assert_only("GSD014", "AllowedValues=\"|9 5..3");
    with("0..256", "4").assert_only("EDS025", "AllowedValues=\"|0..256");
    // A string has no limits; what the file says of them is kept.
    let checked = parameter("DataType=\"VisibleString\" Length=\"4\" AllowedValues=\"1..4\" DefaultValue=\"abc\"");
    assert!(checked.parameter(0).limits.is_empty());
    assert_eq!(extension(&checked.parameter(0).extensions, "AllowedValues"), Some("1..4"));
    checked.assert_clean();
}

#[test]
fn g06_defaults_of_every_type() {
    let default = |attributes: &str| {
        let checked = parameter(attributes);
        checked.assert_clean();
        let item = checked.parameter(0);
        (item.ty, item.default.clone().expect("a default"))
    };
    let text = |text: &str| Value::Text(text.into());
    for (attributes, ty, value) in [
        (
            "DataType=\"VisibleString\" Length=\"15\" DefaultValue=\"0.0.0.0\"",
            Type::VisibleString(Some(15)),
            text("0.0.0.0"),
        ),
        ("DataType=\"VisibleString\" Length=\"5\" DefaultValue=\"\"", Type::VisibleString(Some(5)), text("")),
        ("DataType=\"VisibleString\" Length=\"5\" DefaultValue=\" 1 \"", Type::VisibleString(Some(5)), text(" 1 ")),
        ("DataType=\"Float32\" DefaultValue=\"4.51\"", Type::Real32, Value::Real(4.51)),
        ("DataType=\"Float64\" DefaultValue=\"-1e-3\"", Type::Real64, Value::Real(-1e-3)),
        ("DataType=\"Bit\" BitOffset=\"7\" DefaultValue=\"1\"", Type::Boolean, Value::Bool(true)),
        ("DataType=\"Boolean\" DefaultValue=\"0\"", Type::Boolean, Value::Bool(false)),
        ("DataType=\"BitArea\" BitOffset=\"1\" BitLength=\"3\" DefaultValue=\"7\"", Type::Unsigned(3), Value::Int(7)),
        ("DataType=\"Integer16\" DefaultValue=\"-32768\"", Type::Integer(16), Value::Int(-32768)),
        (
            "DataType=\"Unsigned64\" DefaultValue=\"18446744073709551615\"",
            Type::Unsigned(64),
            Value::Int(u64::MAX.into()),
        ),
        (
            "DataType=\"OctetString\" Length=\"2\" DefaultValue=\"0x01,0xfF\"",
            Type::OctetString(Some(2)),
            Value::Bytes(vec![1, 255]),
        ),
    ] {
        assert_eq!(default(attributes), (ty, value), "{attributes}");
    }
    assert_eq!(default("DataType=\"N2\" DefaultValue=\"-16384\""), (Type::Named(TypeId(0)), Value::Int(-16384)));
}

#[test]
fn g06_defaults_with_faults() {
    let raw = |text: &str| Some(Value::Raw(text.into()));
    for (data_type, written, value) in [
        ("Unsigned8", "on", raw("on")),
        ("Unsigned8", "", raw("")),
        ("Unsigned8", "1.5", raw("1.5")),
        ("Unsigned8", "0x10", Some(Value::Int(16))),
        ("Bit", "2", raw("2")),
        ("Float32", "inf", raw("inf")),
        ("Date", "2020-01-31", raw("2020-01-31")),
        ("OctetString\" Length=\"2", "01,02", raw("01,02")),
        ("Float32+Unsigned8", "1", raw("1")),
    ] {
        let checked = parameter(&format!("DataType=\"{data_type}\" DefaultValue=\"{written}\""));
        assert_eq!(checked.parameter(0).default, value, "{written}");
        checked.assert_only("GSD013", &format!("DefaultValue=\"|{written}\""));
    }
    for (data_type, written) in [("Unsigned8", "256"), ("Integer8", "-129"), ("VisibleString\" Length=\"2", "abc")] {
        let checked = parameter(&format!("DataType=\"{data_type}\" DefaultValue=\"{written}\""));
        checked.assert_only("EDS025", &format!("DefaultValue=\"|{written}\""));
    }
    parameter("DataType=\"Unsigned8\"").assert_only("GSD006", "<|Ref ByteOffset");
}

#[test]
fn g11_constants_and_parameters_compose() {
    let checked = record(
        "<Const Data=\"0x01,0x02,0x03\"/>\n<Const ByteOffset=\"8\" Data=\"0xAA\"/>\n\
         <Ref DataType=\"Unsigned16\" ByteOffset=\"1\" DefaultValue=\"5\" TextId=\"T_Speed\"/>\n\
         <Ref DataType=\"Bit\" ByteOffset=\"9\" BitOffset=\"6\" DefaultValue=\"1\" TextId=\"T_On\"/>\n\
         <Ref DataType=\"BitArea\" ByteOffset=\"9\" BitOffset=\"1\" BitLength=\"4\" DefaultValue=\"1\" TextId=\"T_Mode\"/>",
    );
    checked.assert_clean();
    let record = checked.record();
    assert_eq!((record.index, record.length, record.transfer_sequence), (10, 16, 0));
    // Shorter than the record, and with a parameter over it: what neither covers is 0.
    assert_eq!(record.constants, [(0, vec![1, 2, 3]), (8, vec![0xAA])]);
    let bindings: Vec<_> = checked.group().items.iter().map(|item| item.bindings[0].clone()).collect();
    let at = |bit_offset, bits| Binding::Record { index: 10, bit_offset, bits };
    assert_eq!(bindings, [at(8, 16), at(78, 1), at(73, 4)]);
    assert_eq!(checked.group().name, "Mode");
}

#[test]
fn what_does_not_fit_into_a_record() {
    let at = |offset: u32, name: &str| {
        format!("<Ref DataType=\"Unsigned32\" ByteOffset=\"{offset}\" DefaultValue=\"0\" TextId=\"T_{name}\"/>\n")
    };
    record(&at(12, "Speed")).assert_clean();
    record(&at(13, "Speed")).assert_only("GSD015", "|<Ref ");
    record("<Const ByteOffset=\"15\" Data=\"0x00,0x00\"/>").assert_only("GSD015", "|<ParameterRecordDataItem");
    record(&(at(4, "Speed") + &at(0, "On"))).assert_clean();
    let checked = record(&(at(4, "Speed") + &at(2, "On")));
    checked.assert_only("GSD016", "|<Ref DataType=\"Unsigned32\" ByteOffset=\"4\"");
    // An offset that no record reaches is no reason to panic.
    assert_eq!(record(&at(u32::MAX, "Speed")).codes(), ["GSD005"]);
    assert_eq!(record(&at(u32::MAX / 8 - 1, "Speed")).codes(), ["GSD015"]);
}

#[test]
fn constants_that_are_no_octets() {
    let checked = record("<Const Data=\"0x01,2\"/>");
    assert!(checked.record().constants.is_empty());
    assert_eq!(extension(&checked.group().extensions, "Const@Data"), Some("0x01,2"));
    checked.assert_only("GSD005", "Data=\"|0x01,2");
    record("<Const/>").assert_only("GSD006", "<|Const/>");
}

#[test]
fn access_and_visibility() {
    let flags = |attributes: &str| {
        let checked = parameter(&format!("DataType=\"Unsigned8\" DefaultValue=\"0\" ID=\"P1\" {attributes}"));
        checked.assert_clean();
        let item = checked.parameter(0);
        assert_eq!(extension(&item.extensions, "ID"), Some("P1"));
        (item.access, item.behaviour.as_ref().is_some_and(|behaviour| behaviour.hidden))
    };
    assert_eq!(flags(""), (Access::ReadWrite, false));
    assert_eq!(flags("Changeable=\"false\" Visible=\"0\""), (Access::Constant, true));
    let checked = parameter("DataType=\"Unsigned8\" DefaultValue=\"0\" Visible=\"yes\"");
    checked.assert_only("GSD005", "Visible=\"|yes");
}

#[test]
fn named_values_are_enumerations() {
    let values = "<ValueList>\n<ValueItem ID=\"V_Mode\">\n<Help TextId=\"T_Help\"/>\n<Assignments>\n\
                  <Assign TextId=\"T_Off\" Content=\"0\"/>\n<Assign TextId=\"T_On\" Content=\"1..3\"/>\n\
                  <Assign TextId=\"T_Fault\" Content=\"-1\"/>\n</Assignments>\n</ValueItem>\n\
                  <ValueItem ID=\"V_Unused\">\n<Assignments>\n<Assign TextId=\"T_On\" Content=\"300\"/>\n</Assignments>\n\
                  </ValueItem>\n</ValueList>\n";
    let reference = |data_type: &str, offset: u32| {
        format!(
            "<Ref DataType=\"{data_type}\" ByteOffset=\"{offset}\" DefaultValue=\"0\" TextId=\"T_Mode\" \
             ValueItemTarget=\"V_Mode\"/>\n"
        )
    };
    let content =
        reference("Unsigned8", 0) + &reference("Unsigned8", 1) + &reference("Bit", 2) + &reference("Integer16", 4);
    let checked = read(&Parts { submodule: &record_list(&content), lists: values, ..Parts::default() });
    checked.assert_clean();
    let types: Vec<_> = checked.group().items.iter().map(|item| item.ty).collect();
    // One type for a value list and what has its values.
    assert_eq!(types, [0, 0, 1, 2].map(|id| Type::Named(TypeId(id))));
    let bases = [Type::Unsigned(8), Type::Unsigned(1), Type::Integer(16), Type::Unsigned(16)];
    for (def, expected) in checked.catalog().types.iter().zip(bases) {
        let Shape::Enumeration { base, values, closed } = &def.shape else { panic!("{def:?}") };
        assert_eq!((*base, *closed, def.bits), (expected, false, expected.bits()));
        let facts = |value: &EnumValue| (value.name.to_string(), value.value, value.last);
        let found: Vec<_> = values.iter().map(facts).collect();
        if def.name == "V_Mode" {
            let expected = [("Off".to_owned(), 0, None), ("On".to_owned(), 1, Some(3)), ("Fault".to_owned(), -1, None)];
            assert_eq!(found, expected);
            assert_eq!(def.documentation.as_ref().unwrap().text, "Help");
        } else {
            assert_eq!((def.name.as_str(), found), ("V_Unused", vec![("On".to_owned(), 300, None)]));
        }
    }
}

#[test]
fn named_values_with_faults() {
    let target = |data_type: &str, values: &str| {
        let content = format!(
            "<Ref DataType=\"{data_type}\" ByteOffset=\"0\" DefaultValue=\"0\" TextId=\"T_Mode\" ValueItemTarget=\"V\"/>"
        );
        let lists = format!(
            "<ValueList>\n<ValueItem ID=\"V\">\n<Assignments>\n{values}\n</Assignments>\n</ValueItem>\n</ValueList>\n"
        );
        read(&Parts { submodule: &record_list(&content), lists: &lists, ..Parts::default() })
    };
    for content in ["0.5", "x", "3..1"] {
        let checked = target("Unsigned8", &format!("<Assign TextId=\"T_On\" Content=\"{content}\"/>"));
        checked.assert_only("GSD005", &format!("Content=\"|{content}"));
    }
    target("Unsigned8", "<Assign TextId=\"T_On\" Content=\"2.0\"/>").assert_clean();
    target("Unsigned8", "<Assign TextId=\"T_On\"/>").assert_only("GSD006", "<|Assign TextId");
    let checked = target("Float32", "");
    assert_eq!(extension(&checked.parameter(0).extensions, "ValueItemTarget"), Some("V"));
    checked.assert_only("GSD005", "ValueItemTarget=\"|V\"");
    let checked = parameter("DataType=\"Unsigned8\" DefaultValue=\"0\" ValueItemTarget=\"V_None\"");
    assert_eq!(checked.type_def("V_None").shape, Shape::Alias(Type::Unsigned(8)));
    checked.assert_only("GSD011", "ValueItemTarget=\"|V_None\"");
}

#[test]
fn records_in_order_of_transfer() {
    let item = |index: u16, more: &str| {
        format!("<ParameterRecordDataItem Index=\"{index}\" Length=\"1\" {more}>\n<Name TextId=\"T_Mode\"/>\n</ParameterRecordDataItem>\n")
    };
    let records = item(1, "")
        + &item(2, "TransferSequence=\"7\" ChangeableWithBump=\"true\"")
        + &item(3, "TransferSequence=\"5\"");
    let submodule = format!("<IOData/>\n<RecordDataList>\n{records}</RecordDataList>\n");
    let checked = read(&Parts { submodule: &submodule, ..Parts::default() });
    checked.assert_clean();
    let order: Vec<_> = checked
        .submodule("SUB")
        .records
        .iter()
        .map(|group| match &group.kind {
            GroupKind::Record(record) => (record.index, record.transfer_sequence, record.changeable_with_bump),
            other => panic!("{other:?}"),
        })
        .collect();
    assert_eq!(order, [(3, 5, None), (2, 7, Some(true)), (1, 0, None)]);
    let submodule = "<IOData/>\n<RecordDataList>\n<ParameterRecordDataItem Length=\"1\"/>\n</RecordDataList>\n";
    let checked = read(&Parts { submodule, ..Parts::default() });
    assert!(checked.submodule("SUB").records.is_empty());
    checked.assert_only("GSD006", "<|ParameterRecordDataItem");
}

#[test]
fn menus_and_records_of_other_places() {
    let content = "<Ref ID=\"P\" DataType=\"Unsigned8\" ByteOffset=\"0\" DefaultValue=\"0\" TextId=\"T_Mode\"/>\n<MenuList>\n\
                   <MenuItem ID=\"M1\">\n<Name TextId=\"T_Speed\"/>\n<ParameterRef ParameterTarget=\"P\"/>\n\
                   <MenuRef MenuTarget=\"M2\"/>\n</MenuItem>\n<MenuItem ID=\"M2\">\n<Name TextId=\"T_On\"/>\n</MenuItem>\n</MenuList>";
    let checked = record(content);
    checked.assert_clean();
    let menus = &checked.submodule("SUB").menus;
    assert_eq!((menus[0].id.as_str(), menus[0].name.as_str(), menus[1].name.as_str()), ("M1", "Speed", "On"));
    assert_eq!(menus[0].targets, ["P", "M2"]);
    let device = format!(
        "<ARVendorBlock>\n<Request Length=\"4\" API=\"14848\" APStructureIdentifier=\"5\">\n<Const Data=\"0x01\"/>\n{content}\n\
         </Request>\n</ARVendorBlock>\n<SystemDefinedSubmoduleList>\n\
         <InterfaceSubmoduleItem ID=\"IF\" SubmoduleIdentNumber=\"0x8000\" TextId=\"T_On\">\n<RecordDataList>\n\
         <ParameterRecordDataItem Index=\"9\" Length=\"2\">\n<Name TextId=\"T_Off\"/>\n</ParameterRecordDataItem>\n\
         </RecordDataList>\n</InterfaceSubmoduleItem>\n</SystemDefinedSubmoduleList>\n"
    );
    let checked = read(&Parts { device: &device, ..Parts::default() });
    checked.assert_clean();
    let [block] = &checked.settings().vendor_blocks[..] else { panic!("not one block") };
    assert_eq!((block.api, block.identifier, block.menus.len()), (0x3A00, 5, 2));
    assert_eq!(block.record.items[0].name, "Mode");
    assert_eq!(checked.submodule("IF").records[0].name, "Off");
}

#[test]
fn named_values_do_not_multiply() {
    let values = "<Assign TextId=\"T_On\" Content=\"1\"/>\n".repeat(10_000);
    let lists =
        format!("<ValueList><ValueItem ID=\"V\"><Assignments>\n{values}</Assignments></ValueItem></ValueList>\n");
    let content: String = (1..=40)
        .map(|bits| {
            format!(
                "<Ref DataType=\"BitArea\" BitLength=\"{bits}\" ByteOffset=\"{}\" DefaultValue=\"0\" TextId=\"T_Mode\" \
                 ValueItemTarget=\"V\"/>\n",
                bits * 8
            )
        })
        .collect();
    let submodule = record_list(&content).replace("\"10\" Length=\"16\"", "\"10\" Length=\"400\"");
    let text = file(&Parts { submodule: &submodule, lists: &lists, ..Parts::default() });
    let compilation = check(Source::new(NAME, text.into_bytes()), &Options::default());
    let codes: Vec<&str> = compilation.diagnostics.list().iter().map(|found| found.code.id).collect();
    // The first of 40 types needs no copy, and 20 copies are within the limit.
    assert_eq!(codes, ["IO003"; 19]);
}
