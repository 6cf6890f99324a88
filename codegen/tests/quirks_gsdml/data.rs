//! G07, G16, G19: data items.

use lexibus_codegen::ir::{Direction, PdoEntryKind, Scale, Shape, TimeFormat, Type, TypeId};

use crate::support::*;

#[test]
fn g07_data_items_of_every_length() {
    let checked = inputs(
        "<DataItem DataType=\"OctetString\" Length=\"950\" TextId=\"T_Mode\"/>\n\
         <DataItem DataType=\"Float32\" TextId=\"T_Speed\"/>\n<DataItem DataType=\"Integer32\" TextId=\"T_Torque\"/>\n\
         <DataItem DataType=\"Float64\" TextId=\"T_Ready\"/>\n<DataItem DataType=\"Boolean\" TextId=\"T_On\"/>",
    );
    let expected = [("Mode", 0, 7600), ("Speed", 7600, 32), ("Torque", 7632, 32), ("Ready", 7664, 64), ("On", 7728, 8)];
    assert_eq!(checked.fields(), expected);
    let types = ["Mode", "Speed", "Torque", "Ready", "On"].map(|name| checked.field(name).ty);
    let expected = [Type::OctetString(Some(950)), Type::Real32, Type::Integer(32), Type::Real64, Type::Boolean];
    assert_eq!(types, expected);
    let image = &checked.input().image;
    assert_eq!((image.length, image.overhead, image.big_endian), (967, 0, true));
    assert_eq!((image.direction, checked.input().consistent), (Direction::Transmit, false));
    checked.assert_clean();
}

#[test]
fn every_data_type_has_its_length() {
    for (name, bytes, ty) in [
        ("Integer8", 1, Type::Integer(8)),
        ("Integer16", 2, Type::Integer(16)),
        ("Integer64", 8, Type::Integer(64)),
        ("Unsigned8", 1, Type::Unsigned(8)),
        ("Unsigned16", 2, Type::Unsigned(16)),
        ("Unsigned32", 4, Type::Unsigned(32)),
        ("Unsigned64", 8, Type::Unsigned(64)),
        ("V2", 2, Type::Unsigned(16)),
        ("L2", 2, Type::Unsigned(16)),
        ("Date", 7, Type::Time(TimeFormat::Date)),
        ("TimeOfDay with date indication", 6, Type::TimeOfDay),
        ("TimeOfDay without date indication", 4, Type::Time(TimeFormat::TimeOfDay)),
        ("TimeDifference with date indication", 6, Type::TimeDifference),
        ("TimeDifference without date indication", 4, Type::Time(TimeFormat::TimeDifference)),
        ("NetworkTime", 8, Type::Time(TimeFormat::NetworkTime)),
        ("NetworkTimeDifference", 8, Type::Time(TimeFormat::NetworkTimeDifference)),
        ("TimeStamp", 12, Type::Time(TimeFormat::TimeStamp)),
        ("TimeStampDifference", 12, Type::Time(TimeFormat::TimeStampDifference)),
        ("TimeStampDifferenceShort", 8, Type::Time(TimeFormat::TimeStampDifferenceShort)),
    ] {
        let checked = inputs(&format!("<DataItem DataType=\"{name}\" TextId=\"T_Speed\"/>"));
        assert_eq!((checked.field("Speed").ty, checked.input().image.length), (ty, bytes), "{name}");
        checked.assert_clean();
    }
    for (name, ty) in [
        ("VisibleString", Type::VisibleString(Some(10))),
        ("OctetString", Type::OctetString(Some(10))),
        ("UnicodeString8", Type::Named(TypeId(0))),
        ("61131_STRING", Type::Named(TypeId(0))),
        ("61131_WSTRING", Type::Named(TypeId(0))),
    ] {
        let checked = inputs(&format!("<DataItem DataType=\"{name}\" Length=\"10\" TextId=\"T_Speed\"/>"));
        assert_eq!((checked.field("Speed").ty, checked.input().image.length), (ty, 10), "{name}");
        if matches!(ty, Type::Named(_)) {
            assert_eq!(checked.type_def(name).shape, Shape::Alias(Type::OctetString(Some(10))));
        }
        checked.assert_clean();
    }
}

#[test]
fn numbers_of_profiles_are_types_of_the_catalogue() {
    for (name, base, factor) in [
        ("N2", Type::Integer(16), Some(100.0 / 16384.0)),
        ("N4", Type::Integer(32), Some(100.0 / f64::from(1 << 30))),
        ("E2", Type::Integer(16), Some(1.0 / 128.0)),
        ("C4", Type::Integer(32), Some(1e-4)),
        ("X2", Type::Integer(16), None),
        ("X4", Type::Integer(32), None),
        ("T2", Type::Unsigned(16), None),
        ("T4", Type::Unsigned(32), None),
        ("D2", Type::Unsigned(16), None),
        ("R2", Type::Unsigned(16), None),
        ("Unipolar2.16", Type::Unsigned(16), None),
    ] {
        let items = format!("<DataItem DataType=\"{name}\" TextId=\"T_Speed\"/>\n").repeat(2);
        let checked = inputs(&items);
        let shape = match factor {
            Some(factor) => Shape::Scaled { base, scale: Scale::Linear { factor, offset: 0.0 } },
            None => Shape::Alias(base),
        };
        // Both items have one type.
        let [def] = &checked.catalog().types[..] else { panic!("not one type") };
        assert_eq!((def.name.as_str(), &def.shape, def.bits), (name, &shape, base.bits()));
        assert!(checked.input().image.fields.iter().all(|field| field.ty == Type::Named(TypeId(0))));
        checked.assert_clean();
    }
}

#[test]
fn a_value_and_its_status_are_two_fields() {
    for (name, length, first, bits, suffix) in [
        ("Float32+Unsigned8", "", Type::Real32, 32, "status"),
        ("Float32+Status8", "", Type::Real32, 32, "status"),
        ("Unsigned8+Unsigned8", "", Type::Unsigned(8), 8, "2"),
        ("OctetString2+Unsigned8", "", Type::OctetString(Some(2)), 16, "status"),
        ("Unsigned16_S", "", Type::Unsigned(16), 16, "status"),
        ("Integer16_S", "", Type::Integer(16), 16, "status"),
        ("Unsigned8_S", "", Type::Unsigned(8), 8, "status"),
        ("OctetString_S", "Length=\"5\"", Type::OctetString(Some(4)), 32, "status"),
    ] {
        let checked = inputs(&format!(
            "<DataItem DataType=\"Unsigned8\" TextId=\"T_Mode\"/>\n<DataItem DataType=\"{name}\" {length} TextId=\"T_Speed\"/>"
        ));
        let second = format!("Speed {suffix}");
        assert_eq!(checked.fields()[1..], [("Speed", 8, bits), (second.as_str(), 8 + bits, 8)], "{name}");
        assert_eq!((checked.field("Speed").ty, checked.field(&second).ty), (first, Type::Unsigned(8)));
        let [item] = &checked.input().items[..] else { panic!("{name}: not one item") };
        assert_eq!((item.name.as_str(), item.data_type.as_str()), ("Speed", name));
        assert_eq!((item.first_field, item.fields, item.bit_offset, item.bits), (1, 2, 8, bits + 8));
        checked.assert_clean();
    }
}

#[test]
fn the_second_half_of_a_nameless_item_has_no_name_of_another() {
    let checked = inputs(
        "<DataItem DataType=\"Unsigned8\" TextId=\"T_Mode\"/>\n<DataItem DataType=\"Unsigned8\" TextId=\"T_Speed\"/>\n\
         <DataItem DataType=\"Unsigned8\" TextId=\"T_Ready\"/>\n<DataItem DataType=\"Unsigned8+Unsigned8\"/>",
    );
    let names: Vec<&str> = checked.fields().iter().map(|(name, ..)| *name).collect();
    assert_eq!(names[..3], ["Mode", "Speed", "Ready"]);
    assert!(names[3..].iter().all(|name| !["Mode", "Speed", "Ready"].contains(name)), "{names:?}");
    assert_eq!(names.last(), Some(&"2"));
}

#[test]
fn bits_of_big_endian_numbers() {
    let item = |data_type: &str, bits: &[u32]| {
        let names = ["Speed", "Torque", "Ready", "Fault"];
        let bits: String = bits
            .iter()
            .zip(names)
            .map(|(bit, name)| format!("<BitDataItem BitOffset=\"{bit}\" TextId=\"T_{name}\"/>\n"))
            .collect();
        inputs(&format!("<DataItem {data_type} UseAsBits=\"true\" TextId=\"T_Mode\">\n{bits}</DataItem>"))
    };
    let checked = item("DataType=\"Unsigned8\"", &[7, 0, 3]);
    assert_eq!(checked.fields(), [("Torque", 0, 1), ("Ready", 3, 1), ("Speed", 7, 1)]);
    let kinds: Vec<_> = checked.input().image.fields.iter().map(|field| (field.kind, field.bits)).collect();
    let (bit, padding) = (PdoEntryKind::Item, PdoEntryKind::Padding);
    assert_eq!(kinds, [(bit, 1), (padding, 2), (bit, 1), (padding, 3), (bit, 1)]);
    assert_eq!(checked.field("Ready").ty, Type::Boolean);
    checked.assert_clean();
    // Bit 0 is in the last byte, which a number of several bytes ends with.
    let checked = item("DataType=\"Unsigned16\"", &[0, 7, 8, 15]);
    assert_eq!(checked.fields(), [("Ready", 0, 1), ("Fault", 7, 1), ("Speed", 8, 1), ("Torque", 15, 1)]);
    let checked = item("DataType=\"Unsigned32\"", &[0, 31]);
    assert_eq!(checked.fields(), [("Torque", 7, 1), ("Speed", 24, 1)]);
    let checked = item("DataType=\"Unsigned64\"", &[0, 63]);
    assert_eq!(checked.fields(), [("Torque", 7, 1), ("Speed", 56, 1)]);
    // Octets aren't a number.
    let checked = item("DataType=\"OctetString\" Length=\"2\"", &[0, 9]);
    assert_eq!(checked.fields(), [("Speed", 0, 1), ("Torque", 9, 1)]);
    let [of_bits] = &checked.input().items[..] else { panic!("not one item") };
    assert_eq!((of_bits.name.as_str(), of_bits.fields, of_bits.bits), ("Mode", 4, 16));
    // Without names of its bits an item is a number.
    let checked = item("DataType=\"Unsigned16\"", &[]);
    assert_eq!((checked.field("Mode").ty, checked.fields()), (Type::Unsigned(16), vec![("Mode", 0, 16)]));
    checked.assert_clean();
}

#[test]
fn bits_that_do_not_go_with_their_item() {
    let item = |attributes: &str, bits: &str| {
        inputs(&format!("<DataItem DataType=\"Unsigned8\" {attributes} TextId=\"T_Mode\">\n{bits}\n</DataItem>"))
    };
    let bits = "<BitDataItem BitOffset=\"1\" TextId=\"T_Speed\"/>";
    let checked = item("", bits);
    assert_eq!(checked.fields(), [("Speed", 1, 1)]);
    checked.assert_only("GSD017", "<|DataItem DataType");
    let checked = item("UseAsBits=\"true\"", &format!("{bits}\n<BitDataItem BitOffset=\"8\" TextId=\"T_On\"/>"));
    assert_eq!(checked.fields(), [("Speed", 1, 1)]);
    checked.assert_only("GSD017", "<BitDataItem BitOffset=\"8\"");
    let checked = item("UseAsBits=\"true\"", &format!("{bits}\n<BitDataItem BitOffset=\"1\" TextId=\"T_On\"/>"));
    assert_eq!(checked.fields(), [("Speed", 1, 1)]);
    checked.assert_only("GSD017", "|<BitDataItem BitOffset=\"1\" TextId=\"T_On\"");
}

#[test]
fn g16_data_types_that_gsdml_does_not_have() {
    let checked = inputs(
        "<DataItem DataType=\"Float\" Length=\"4\" TextId=\"T_Speed\"/>\n<DataItem DataType=\"Unsigned8\" TextId=\"T_Mode\"/>",
    );
    assert_eq!(checked.fields(), [("Speed", 0, 32), ("Mode", 32, 8)]);
    let field = checked.field("Speed");
    assert_eq!((field.ty, field.kind), (Type::Opaque(None), PdoEntryKind::Unknown));
    let found = checked.assert_only("GSD012", "DataType=\"|Float\"");
    assert!(found.help.as_ref().is_some_and(|help| help.contains("Float32")));
    // Without a length nobody knows where the next item is.
    let checked = inputs("<DataItem DataType=\"Float\" TextId=\"T_Speed\"/>");
    assert_eq!(checked.fields(), [("Speed", 0, 0)]);
    assert_eq!(checked.codes(), ["GSD006", "GSD012"]);
    let checked = parameter("DataType=\"Float\" Length=\"4\" DefaultValue=\"1.5\"");
    assert_eq!(checked.parameter(0).ty, Type::Opaque(None));
    assert_eq!(checked.codes(), ["GSD012", "GSD013"]);
}

#[test]
fn g16_data_types_in_another_case() {
    let checked =
        inputs("<DataItem DataType=\"unsigned16\" TextId=\"T_Speed\"/>\n<DataItem DataType=\"n2\" TextId=\"T_Mode\"/>");
    assert_eq!(checked.fields(), [("Speed", 0, 16), ("Mode", 16, 16)]);
    assert_eq!((checked.field("Speed").ty, checked.codes()), (Type::Unsigned(16), vec!["GSD012", "GSD012"]));
}

#[test]
fn g19_trailers_of_safety_messages() {
    for (name, bytes) in [("F_MessageTrailer4Byte", 4), ("F_MessageTrailer5Byte", 5)] {
        let submodule = format!(
            "<IOData F_IO_StructureDescVersion=\"2\" F_IO_StructureDescCRC=\"4047501373\" IOPS_Length=\"1\">\n<Input \
             Consistency=\"All items consistency\">\n<DataItem DataType=\"Unsigned16\" TextId=\"T_Speed\"/>\n\
             <DataItem DataType=\"{name}\" TextId=\"T_Mode\"/>\n</Input>\n<Output>\n\
             <DataItem DataType=\"{name}\" TextId=\"T_Mode\"/>\n</Output>\n</IOData>\n"
        );
        let checked = read(&Parts { submodule: &submodule, ..Parts::default() });
        let image = &checked.input().image;
        assert_eq!((image.length, image.overhead, checked.input().consistent), (2, bytes, true));
        assert_eq!(checked.fields(), [("Speed", 0, 16)]);
        let output = checked.submodule("SUB").output.as_ref().expect("outputs");
        assert_eq!((output.image.length, output.image.overhead), (0, bytes));
        let [item] = &checked.input().items[..] else { panic!("not one item") };
        assert_eq!((item.name.as_str(), item.data_type.as_str(), item.fields), ("Mode", name, 0));
        let attributes = &checked.submodule("SUB").attributes;
        assert_eq!(value_of(attributes, "IOData@F_IO_StructureDescCRC"), Some("4047501373"));
        checked.assert_clean();
    }
}

#[test]
fn data_behind_a_trailer() {
    let trailer = "<DataItem DataType=\"F_MessageTrailer4Byte\" TextId=\"T_Mode\"/>\n";
    let speed = "<DataItem DataType=\"Unsigned16\" TextId=\"T_Speed\"/>\n";
    let checked = inputs(&format!("{trailer}{speed}{trailer}"));
    assert_eq!(checked.fields(), [("Mode", 0, 32), ("Speed", 32, 16)]);
    let input = checked.input();
    assert_eq!((input.image.length, input.image.overhead), (6, 4));
    let items: Vec<_> = input.items.iter().map(|item| (item.bit_offset, item.first_field, item.fields)).collect();
    assert_eq!(items, [(0, 0, 1), (48, 2, 0)]);
    assert_eq!(checked.codes(), ["GSD005"]);
}

#[test]
fn data_items_whose_length_is_wrong_or_missing() {
    let checked = inputs("<DataItem DataType=\"Unsigned16\" Length=\"4\" TextId=\"T_Speed\"/>");
    assert_eq!(checked.fields(), [("Speed", 0, 16)]);
    checked.assert_only("GSD005", "Length=\"|4\"");
    let checked = inputs("<DataItem DataType=\"OctetString\" TextId=\"T_Speed\"/>");
    checked.assert_only("GSD006", "<|DataItem DataType");
    // The greatest lengths that fit nowhere are no reason to panic.
    let items = "<DataItem DataType=\"OctetString\" Length=\"65535\" TextId=\"T_Speed\"/>\n".repeat(9_000);
    assert!(inputs(&items).input().image.length > 0);
}

#[test]
fn a_module_has_more_data_than_its_device_exchanges() {
    let modules = "<ModuleItem ID=\"MOD\" ModuleIdentNumber=\"0x2\">\n<ModuleInfo><Name TextId=\"T_Speed\"/></ModuleInfo>\n\
                   <VirtualSubmoduleList>\n<VirtualSubmoduleItem ID=\"V\" SubmoduleIdentNumber=\"0x1\">\n<IOData><Input>\n\
                   <DataItem DataType=\"OctetString\" Length=\"9\" TextId=\"T_Mode\"/>\n</Input></IOData>\n\
                   </VirtualSubmoduleItem>\n</VirtualSubmoduleList>\n</ModuleItem>\n";
    let device = |input: u32| {
        format!(
            "<IOConfigData MaxInputLength=\"{input}\" MaxOutputLength=\"8\"/>\n<UseableModules>\n\
             <ModuleItemRef ModuleItemTarget=\"MOD\"/>\n</UseableModules>\n"
        )
    };
    let checked = read(&Parts { device: &device(9), modules, ..Parts::default() });
    assert_eq!((checked.settings().max_lengths.input, checked.settings().max_lengths.output), (Some(9), Some(8)));
    checked.assert_clean();
    let checked = read(&Parts { device: &device(8), modules, ..Parts::default() });
    checked.assert_only("GSD018", "|<ModuleItem ID=\"MOD\"");
}
