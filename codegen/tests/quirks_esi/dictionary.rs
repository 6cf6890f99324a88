//! X11 to X14, X17, X18, X21: data types, objects and their flags.

use lexibus_codegen::ir::{Access, Category, ObjectCode, Shape, Type, TypeId};

use crate::support::*;

/// The type of an object whose Type is this, without any data type.
fn by_name(name: &str) -> (Type, Vec<String>) {
    let checked = dictionary("", &var("#x2000", name, ""));
    (checked.item(0x2000, 0).ty, checked.found())
}

#[test]
fn x11_names_of_basic_types() {
    let (unsigned, integer) = (Type::Unsigned, Type::Integer);
    for (name, ty) in [
        ("BOOL", Type::Boolean),
        ("UINT16", unsigned(16)),
        ("UINT8", unsigned(8)),
        ("BOOLEAN", Type::Boolean),
        ("UINT24", unsigned(24)),
        ("INT24", integer(24)),
        ("BIT3", unsigned(3)),
        ("DWORD", unsigned(32)),
        ("LREAL", Type::Real64),
        ("STRING(16)", Type::VisibleString(Some(16))),
        ("ARRAY [0..29] OF BYTE", Type::OctetString(Some(30))),
        ("GUID", Type::OctetString(Some(16))),
    ] {
        assert_eq!(by_name(name), (ty, vec![]), "{name}");
    }
    assert_eq!(by_name("UIN"), (Type::Opaque(None), vec!["ESI010 5:54".to_owned()]));
    assert_eq!(by_name(""), (Type::Opaque(None), vec!["ESI010 5:1".to_owned()]));
    assert_eq!(by_name("UINT_hex"), (Type::Unsigned(16), vec!["ESI012 5:54".to_owned()]));
    let alias = read_with(&device_file(&profile("", &var("#x2000", "UINT16", ""))), &["type-alias"]);
    assert_eq!(alias.found(), ["ESI011 5:54"]);
}

#[test]
fn x11_bit_arrays_and_arrays_have_types_of_their_own() {
    let bits = dictionary("", &var("#x2000", "BITARR8", ""));
    assert_eq!(bits.item(0x2000, 0).ty, Type::Named(TypeId(0)));
    let Shape::BitField { base, fields } = &bits.device().types[0].shape else { panic!("single bits") };
    assert_eq!((*base, fields.len(), fields[7].offset), (Type::Unsigned(8), 8, 7));
    let array = dictionary("", &var("#x2000", "ARRAY [1..4] OF UINT", ""));
    let expected = Shape::Array { element: Type::Unsigned(16), dimensions: vec![(1, 4)] };
    assert_eq!(array.device().types[0].shape, expected);
    assert!(bits.found().is_empty() && array.found().is_empty());
}

const MODE: &str = "<DataType><Name>DT0800EN08</Name><BaseType>USINT</BaseType><BitSize>8</BitSize>\
                    <EnumInfo><Text LcId='1031'>Aus</Text><Text LcId='1033'>Off</Text><Enum>0</Enum></EnumInfo>\
                    <EnumInfo><Text>On</Text><Enum>#x10</Enum></EnumInfo></DataType>\n";

#[test]
fn x11_enumerations_are_types() {
    let checked = dictionary(MODE, &var("#x2000", "DT0800EN08", "<DefaultValue>16</DefaultValue>"));
    assert_eq!(checked.item(0x2000, 0).ty, Type::Named(TypeId(0)));
    let Shape::Enumeration { base, values, closed } = &checked.device().types[0].shape else { panic!("values") };
    assert_eq!((*base, *closed), (Type::Unsigned(8), false));
    let all: Vec<_> = values.iter().map(|value| (value.name.as_str(), value.value)).collect();
    assert_eq!(all, [("Off", 0), ("On", 16)]);
    assert_eq!(values[0].names[0].text, "Aus");
    assert_eq!((checked.default(0x2000, 0), checked.found()), (int(16), vec![]));
    let entry = device(&format!("{}{}", profile(MODE, ""), tx_pdo("#x1A00", &entry("#x2000", 0, 8, "DT0800EN08"))));
    assert_eq!(entry.pdo(0x1A00).entries[0].ty, Type::Named(TypeId(0)));
}

#[test]
fn numbers_of_types_are_those_of_ethercat() {
    let coded = |code: &str| {
        let ty = format!("<DataType><Index>{code}</Index><Name>OWN</Name></DataType>");
        dictionary(&ty, &var("#x2000", "OWN", "")).item(0x2000, 0).ty
    };
    assert_eq!(coded("#x001E"), Type::Unsigned(8));
    assert_eq!(coded("#x0020"), Type::Unsigned(32));
    assert_eq!(coded("#x0031"), Type::Unsigned(2));
}

/// A record with sub-index 0 and these sub-items.
fn record(name: &str, subs: &str) -> String {
    let count = sub_item(0, "SubIndex 000", "USINT", 8, 0);
    format!("<DataType><Name>{name}</Name><BitSize>80</BitSize>{count}\n{subs}</DataType>")
}

/// An object of that type with these sub-items.
fn object(ty: &str, subs: &[&str]) -> String {
    let sub = |name: &&str| format!("<SubItem><Name>{name}</Name><Info/></SubItem>\n");
    let subs: String = subs.iter().map(sub).collect();
    format!("<Object><Index>#x2000</Index><Name>Set</Name><Type>{ty}</Type><BitSize>80</BitSize><Info>\n{subs}</Info></Object>")
}

#[test]
fn x12_types_and_sub_items_of_the_same_name() {
    let sub = |sub: u8| sub_item(sub, "New array subitem", "UINT", 16, 16 * u32::from(sub));
    let types = record("DT2000", &format!("{}\n{}\n{}", sub(1), sub(2), sub(3).replace("New array subitem", "")));
    let again = "<DataType><Name>DT2000</Name><BaseType>UINT</BaseType><BitSize>16</BitSize></DataType>\n";
    let checked = dictionary(&format!("{types}\n{again}"), &object("DT2000", &[]));
    assert_eq!(
        checked.subs(0x2000),
        [(0, "SubIndex 000"), (1, "New array subitem"), (2, "New array subitem"), (3, "")]
    );
    assert_eq!(checked.device().types.len(), 2);
    assert_eq!(checked.found(), ["ESI014 6:34", "ESI014 7:1", "ESI013 8:17"]);
    assert_eq!(checked.only("ESI013").notes.len(), 1);
    // Each device has types of its own.
    let two = device_file(&profile(&types.replace("New array subitem", "A"), "")).replace(
        "</Devices>",
        &format!("<Device><Type ProductCode='1'>T</Type>{}</Device></Devices>", profile(again, "")),
    );
    let two = read_text(&two);
    assert!(!two.found().iter().any(|found| found.starts_with("ESI013")));
}

#[test]
fn x13_base_types_that_are_missing_or_lead_back() {
    let ty = |name: &str, more: &str| format!("<DataType><Name>{name}</Name>{more}<BitSize>8</BitSize></DataType>\n");
    let value = "<EnumInfo><Text>A</Text><Enum>1</Enum></EnumInfo>";
    let untyped = dictionary(&ty("MODE", value), &var("#x2000", "MODE", ""));
    let Shape::Enumeration { base, .. } = untyped.device().types[0].shape else { panic!("values") };
    assert_eq!((base, untyped.found()), (Type::Unsigned(8), vec!["ESI016 4:17".to_owned()]));
    let text = dictionary(&ty("MODE", &format!("<BaseType>REAL</BaseType>{value}")), &var("#x2000", "MODE", ""));
    assert_eq!(text.found(), ["ESI016 4:38"]);
    let undefined = dictionary(&ty("A", "<BaseType>NOWHERE</BaseType>"), &var("#x2000", "A", ""));
    assert_eq!((undefined.item(0x2000, 0).ty, undefined.found()), (Type::Opaque(None), vec!["ESI010 4:35".into()]));
    let circle = format!("{}{}", ty("A", "<BaseType>B</BaseType>"), ty("B", "<BaseType>A</BaseType>"));
    let circle = dictionary(&circle, &var("#x2000", "A", ""));
    assert_eq!(
        (circle.item(0x2000, 0).ty, circle.found()),
        (Type::Opaque(None), vec!["ESI015 4:35".into(), "ESI015 5:35".into()])
    );
    let own = dictionary(&ty("USINT", "<BaseType>USINT</BaseType>"), &var("#x2000", "USINT", ""));
    assert_eq!((own.item(0x2000, 0).ty, own.found()), (Type::Unsigned(8), vec![]));
    let inside = dictionary(&record("R", &sub_item(1, "again", "R", 80, 8)), &object("R", &[]));
    assert_eq!(inside.found().iter().filter(|found| found.starts_with("ESI015")).count(), 1);
    let array = ty("A", "<ArrayInfo><LBound>0</LBound><Elements>2</Elements></ArrayInfo>");
    assert_eq!(dictionary(&array, "").found(), ["ESI016 4:17"]);
    let nothing = dictionary(&ty("DT_OWN", ""), "");
    assert_eq!(nothing.found(), ["ESI010 4:17"]);
    let deep: String = (0..300).map(|n| ty(&format!("T{n}"), &format!("<BaseType>T{}</BaseType>", n + 1))).collect();
    let deep = dictionary(&format!("{deep}{}", ty("T300", "<BaseType>USINT</BaseType>")), &var("#x2000", "T0", ""));
    assert_eq!(deep.found().iter().filter(|found| !found.starts_with("ESI015")).count(), 0);
}

/// A data type of an array, and a record that has one.
fn array(info: &str, bits: u32) -> String {
    let ty = format!(
        "<DataType><Name>DT2000ARR</Name><BaseType>UINT</BaseType><BitSize>{bits}</BitSize>{info}</DataType>\n"
    );
    let elements =
        "<SubItem><Name>Elements</Name><Type>DT2000ARR</Type><BitSize>64</BitSize><BitOffs>16</BitOffs></SubItem>";
    ty + &record("DT2000", elements)
}

const FOUR: &str = "<ArrayInfo><LBound>1</LBound><Elements>4</Elements></ArrayInfo>";

#[test]
fn arrays_have_an_item_for_every_element() {
    let checked = dictionary(&array(FOUR, 64), &object("DT2000", &["SubIndex 000", "One", "Two", "Three", "Four"]));
    assert_eq!(checked.subs(0x2000), [(0, "SubIndex 000"), (1, "One"), (2, "Two"), (3, "Three"), (4, "Four")]);
    assert_eq!(checked.group(0x2000).object_code(), Some(ObjectCode::Array));
    assert_eq!(checked.group(0x2000).described, 5);
    assert_eq!(checked.item(0x2000, 4).ty, Type::Unsigned(16));
    let derived = dictionary(&array(FOUR, 64), &object("DT2000", &[]));
    assert_eq!(derived.subs(0x2000)[4], (4, "Elements 4"));
    assert_eq!(derived.group(0x2000).described, 0);
    // Which value is whose goes by the names.
    let some = dictionary(&array(FOUR, 64), &object("DT2000", &["SubIndex 000", "One"]));
    assert_eq!(some.subs(0x2000)[1..3], [(1, "One"), (2, "Elements 2")]);
}

#[test]
fn x15_the_default_of_a_whole_array() {
    let with = |data: &str| {
        let info = format!("<Info><DefaultData>{data}</DefaultData></Info></SubItem>");
        let object = object("DT2000", &["SubIndex 000", "Elements"]);
        let at = object.rfind("</SubItem>").unwrap();
        dictionary(&array(FOUR, 64), &(object[..at].to_owned() + &info + &object[at + "</SubItem>".len()..]))
    };
    let whole = with("0100020003000400");
    let defaults: Vec<_> = (1..=4).map(|sub| whole.item(0x2000, sub).default.clone()).collect();
    assert_eq!((defaults, whole.found()), ((1..=4).map(int).collect(), vec!["ESI030 7:1".to_owned()]));
    let third = whole.item(0x2000, 3);
    assert_eq!((third.name.as_str(), whole.0.sources[0].slice(third.at.default)), ("Elements 3", "0300"));
    let wrapped = with("01000200\n 03000400");
    let defaults: Vec<_> = (1..=4).map(|sub| wrapped.item(0x2000, sub).default.clone()).collect();
    assert_eq!((defaults, wrapped.found().len()), ((1..=4).map(int).collect(), 1), "as data may be, over lines");
    // Nothing else can be taken apart.
    let short = with("010002000300");
    assert_eq!((short.item(0x2000, 2).default.clone(), short.found().len()), (None, 2));
}

#[test]
fn x14_arrays_whose_size_is_wrong() {
    let names = ["SubIndex 000", "One", "Two", "Three", "Four"];
    let missing = dictionary(&array("", 64), &object("DT2000", &names));
    assert_eq!(missing.subs(0x2000).len(), 5);
    assert_eq!(missing.found()[0], "ESI017 4:17");
    let zero = dictionary(&array(&FOUR.replace('4', "0"), 64), &object("DT2000", &names));
    assert_eq!(zero.subs(0x2000).len(), 5, "as many as BitSize has room for");
    assert_eq!(zero.found()[0], "ESI017 4:79");
    let many = dictionary(&array(&FOUR.replace('4', "255"), 64), &object("DT2000", &names));
    assert_eq!(many.subs(0x2000).len(), 256);
    assert_eq!(many.found()[0], "ESI017 4:79");
    let huge = dictionary(&array(&FOUR.replace('4', "4000000000"), 64), &object("DT2000", &names[..1]));
    assert_eq!(huge.subs(0x2000).len(), 2);
    assert!(huge.found().iter().any(|found| found.starts_with("ESI034 7:1")), "{:?}", huge.found());
    // More values than the type has elements.
    let two = dictionary(&array(&FOUR.replace('4', "2"), 32), &object("DT2000", &names));
    assert_eq!(two.subs(0x2000)[3..], [(3, "Three"), (4, "Four")]);
    assert_eq!(two.item(0x2000, 4).ty, Type::Unsigned(16));
    assert_eq!(two.found()[1..], ["ESI018 11:16", "ESI018 12:16"]);
    let four = format!("{FOUR}{FOUR}{FOUR}\n{FOUR}");
    let four = dictionary(&array(&four, 1024), "");
    assert_eq!(four.found()[0], "ESI017 5:1");
    let Shape::Array { dimensions, .. } = &four.device().types[0].shape else { panic!("an array") };
    assert_eq!(dimensions[..], [(1, 4); 3]);
}

#[test]
fn x14_sub_items_that_the_type_does_not_have() {
    let untyped = dictionary(&basic("UINT", 16), &object("UINT", &["SubIndex 000", "One"]));
    assert_eq!(untyped.subs(0x2000), [(0, "SubIndex 000"), (1, "One")]);
    assert_eq!(untyped.item(0x2000, 1).ty, Type::Opaque(None));
    assert_eq!(untyped.found().iter().filter(|found| found.starts_with("ESI018")).count(), 1);
    let fields = sub_item(1, "A", "UINT", 16, 8) + &sub_item(2, "B", "UINT", 16, 24);
    let record = |subs: &[&str]| dictionary(&record("DT2000", &fields), &object("DT2000", subs));
    let swapped = record(&["SubIndex 000", "B", "A"]);
    assert_eq!(swapped.subs(0x2000), [(0, "SubIndex 000"), (1, "A"), (2, "B")]);
    let renamed = record(&["Count", "X", "Y"]);
    assert_eq!(renamed.subs(0x2000), [(0, "Count"), (1, "X"), (2, "Y")]);
    assert!(!renamed.found().iter().any(|found| found.starts_with("ESI018")));
    let other = record(&["SubIndex 000", "X"]);
    assert_eq!(other.subs(0x2000), [(0, "SubIndex 000"), (1, "X"), (2, "B")]);
    assert_eq!(other.found().iter().filter(|found| found.starts_with("ESI018 8:16")).count(), 1);
}

fn with_flags(flags: &str) -> Checked {
    let object = var("#x2000", "UINT", "").replace("<Access>ro</Access>", flags);
    dictionary(&basic("UINT", 16), &object)
}

#[test]
fn x17_pdo_mapping_in_any_case() {
    for (text, rpdo, tpdo) in [
        ("T", false, true),
        ("t", false, true),
        ("R", true, false),
        ("r", true, false),
        ("TR", true, true),
        ("RT", true, true),
        ("tr", true, true),
        ("rt", true, true),
        ("", false, false),
    ] {
        let checked = with_flags(&format!("<Access>rw</Access><PdoMapping>{text}</PdoMapping>"));
        let mappable = checked.item(0x2000, 0).mappable;
        assert_eq!((mappable.rpdo, mappable.tpdo), (rpdo, tpdo), "{text}");
        assert_eq!(checked.found(), NOTHING);
    }
    let other = with_flags("<Access>rw</Access><PdoMapping>yes</PdoMapping>");
    assert!(!other.item(0x2000, 0).mappable.any());
    assert_eq!(other.found(), ["ESI031 5:116"]);
}

#[test]
fn x18_access() {
    let access = |flags: &str| {
        let checked = with_flags(flags);
        (checked.item(0x2000, 0).access, checked.found())
    };
    assert_eq!(access("<Access>wo</Access>"), (Access::WriteOnly, vec![]));
    assert_eq!(access("<Access></Access>"), (Access::ReadOnly, vec!["ESI030 5:1".to_owned()]));
    assert_eq!(access("<Access>RW</Access>"), (Access::ReadWrite, vec!["ESI031 5:93".to_owned()]));
    assert_eq!(access("<Access>x</Access>"), (Access::ReadOnly, vec!["ESI031 5:93".to_owned()]));
    let object = var("#x2000", "UINT", "").replace("<Access>", "<Access ReadInPreOP='true'>");
    let unknown = read_with(&device_file(&profile("", &object)), &["esi-unknown-element"]);
    assert_eq!(unknown.found(), ["ESI002 5:93"]);
    assert_eq!(value_of(&unknown.group(0x2000).extensions, "Access@ReadInPreOP"), Some("true"));
}

#[test]
fn flags_of_objects_and_their_sub_items() {
    let checked = with_flags(
        "<Access ReadRestrictions='PreOP_SafeOP' WriteRestrictions='PreOP'>rw</Access><Category>m</Category>\
         <SafetyMapping>si</SafetyMapping><Backup>1</Backup><Setting>1</Setting><SdoAccess>CompleteAccess</SdoAccess>",
    );
    let behaviour = checked.item(0x2000, 0).behaviour.as_ref().unwrap();
    assert_eq!(
        (behaviour.read_states.as_slice(), behaviour.write_states.as_slice()),
        (&["PreOP".into(), "SafeOP".into()][..], &["PreOP".into()][..])
    );
    assert!(behaviour.backup && behaviour.setting);
    assert_eq!(behaviour.safety.as_deref(), Some("si"));
    let lexibus_codegen::ir::GroupKind::Object { category, .. } = checked.group(0x2000).kind else { panic!("object") };
    assert_eq!(category, Some(Category::Mandatory));
    assert_eq!(value_of(&checked.group(0x2000).extensions, "SdoAccess"), Some("CompleteAccess"));
    // What a sub-item doesn't say is what its object says.
    let safe = "<SafetyMapping>si</SafetyMapping></Flags>";
    let fields = sub_item(1, "A", "UINT", 16, 8).replace("</Flags>", safe)
        + &sub_item(2, "B", "UINT", 16, 24).replace("<Flags><Access>rw</Access></Flags>", "");
    let flags = "<Flags><Access WriteRestrictions='PreOP'>ro</Access><PdoMapping>T</PdoMapping></Flags></Object>";
    let object = object("DT2000", &[]).replace("</Object>", flags);
    let checked = dictionary(&record("DT2000", &fields), &object);
    let of = |sub| (checked.item(0x2000, sub).access, checked.item(0x2000, sub).mappable.tpdo);
    assert_eq!(
        [of(0), of(1), of(2)],
        [(Access::ReadWrite, false), (Access::ReadWrite, false), (Access::ReadOnly, true)]
    );
    let behaviour = checked.item(0x2000, 1).behaviour.as_ref().unwrap();
    assert_eq!((behaviour.safety.as_deref(), &behaviour.write_states[..]), (Some("si"), &["PreOP".into()][..]));
    assert_eq!(checked.found(), NOTHING);
    let odd = with_flags("<Access>ro</Access><Category>x</Category><SafetyMapping>q</SafetyMapping>");
    assert_eq!(odd.found(), ["ESI031 5:114", "ESI031 5:141"]);
}

#[test]
fn x21_no_objects_and_no_profile() {
    let empty = device("<Profile><ProfileNo>5001</ProfileNo><Dictionary><DataTypes/></Dictionary></Profile>");
    assert!(empty.device().groups.is_empty());
    assert_eq!((empty.device().profiles.as_slice(), empty.found()), (&[5001][..], vec![]));
    assert_eq!(device("").found(), NOTHING);
}

#[test]
fn objects_without_index_and_twice() {
    let none = dictionary("", &var("", "UINT", "").replace("<Index></Index>", ""));
    assert_eq!((none.device().groups.len(), none.found()), (0, vec!["ESI033 5:1".to_owned()]));
    let objects = format!("{}\n{}\n{}", var("#x2001", "UINT", ""), var("#x2000", "UINT", ""), var("8193", "USINT", ""));
    let twice = dictionary("", &objects);
    let indices: Vec<_> = twice.device().groups.iter().filter_map(|group| group.index()).collect();
    assert_eq!(indices, [0x2000, 0x2001]);
    assert_eq!((twice.item(0x2001, 0).ty, twice.found()), (Type::Unsigned(16), vec!["ESI032 7:1".to_owned()]));
    let fields = sub_item(1, "A", "UINT", 16, 8) + "\n" + &sub_item(1, "B", "UINT", 16, 24);
    let subs = dictionary(&record("DT2000", &fields), &object("DT2000", &[]));
    assert_eq!(subs.subs(0x2000), [(0, "SubIndex 000"), (1, "A")]);
    assert!(subs.found().contains(&"ESI032 6:1".to_owned()), "{:?}", subs.found());
}

#[test]
fn sizes_that_contradict_each_other() {
    let ty = "<DataType><Name>NARROW</Name><BaseType>UINT</BaseType><BitSize>12</BitSize></DataType>";
    let object = var("#x2000", "NARROW", "").replace("</Type>", "</Type><BitSize>8</BitSize>");
    let checked = dictionary(ty, &object);
    assert_eq!(checked.item(0x2000, 0).ty, Type::Unsigned(12));
    assert_eq!(checked.found(), ["ESI019 4:17", "ESI019 5:76"]);
}

#[test]
fn what_has_no_place_is_kept() {
    let ty = "<DataType><Name>UINT</Name><BitSize>16</BitSize><Properties><Property><Name>DisplayFormat</Name>\
              <Value>hex</Value><Desc>how</Desc></Property></Properties></DataType>";
    let object = var("#x2000", "UINT", "").replace(
        "</Object>",
        "<Properties><Property><Name>Own</Name><Desc>d</Desc></Property></Properties><Xml><a b='1'/></Xml></Object>",
    );
    let checked = dictionary(ty, &object);
    assert_eq!(value_of(&checked.device().extensions, "UINT/DisplayFormat"), Some("hex"));
    assert_eq!(value_of(&checked.device().extensions, "UINT/DisplayFormat/Desc"), Some("how"));
    let group = checked.group(0x2000);
    assert_eq!((value_of(&group.extensions, "Own"), value_of(&group.extensions, "Xml/a@b")), (Some("d"), Some("1")));
    assert_eq!(checked.found(), NOTHING);
}
