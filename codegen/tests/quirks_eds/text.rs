//! E22 to E37: texts, sections, encodings and lists.

use lexibus_codegen::compile::{check, Options};
use lexibus_codegen::ir::{Access, ObjectCode, Value};
use lexibus_codegen::source::{Encoding, Source};

use crate::support::*;

/// A VAR of this name, which stands at line 2, column 15.
fn named(name: &str) -> Checked {
    read(&format!("[2000]\nParameterName={name}\nDataType=0x0005\nAccessType=rw\n"))
}

#[test]
fn e22_comment_marks_in_a_name() {
    for name in ["a;b ; c", "Input #1 # x", "µ ; Größe # 1"] {
        let checked = named(name);
        assert_eq!(checked.group(0x2000).name, name);
        assert_eq!(checked.item(0x2000, 0).name, name);
        assert_eq!(checked.codes(), [""; 0], "{name}");
    }
}

#[test]
fn e23_signs_and_quotation_marks_in_a_name() {
    for name in ["100% duty", "x=y", "say \"hello\"", "\""] {
        let checked = named(name);
        assert_eq!(checked.group(0x2000).name, name);
        assert_eq!(checked.codes(), [""; 0], "{name}");
    }
    let checked = named("\"Quoted\"");
    assert_eq!(checked.group(0x2000).name, "Quoted");
    assert_eq!(checked.codes(), ["EDS016"]);
    assert_eq!(checked.places("EDS016"), [(2, 15)]);
    let checked = named("\"\"Twice\"\"");
    assert_eq!(checked.group(0x2000).name, "\"Twice\"", "one pair only");
}

#[test]
fn e24_sub_in_any_case() {
    for spelling in ["1A00sub0", "1A00Sub0", "1A00SUB0"] {
        let name = spelling.replace("1A00", "2000");
        let checked = read(&format!(
            "[2000]\nParameterName=Speeds\nObjectType=8\nSubNumber=1\n\
             [{name}]\nParameterName=Count\nDataType=0x0005\nAccessType=ro\nDefaultValue=0\n"
        ));
        assert_eq!(checked.subs(0x2000), [0], "{name}");
        assert_eq!(checked.codes(), [""; 0], "{name}");
    }
}

#[test]
fn e25_sections_and_keys_in_any_case() {
    let checked = read(
        "[deviceinfo]\nvendorname=Maker\nVENDORNUMBER=1\nproductname=Valve\nproductnumber=2\nrevisionnumber=3\n\
         [2000]\nparametername=Speed\nOBJECTTYPE=7\ndatatype=0x0005\naccesstype=rw\ndefaultvalue=4\npdomapping=1\n\
         lowlimit=1\nhighlimit=9\nobjflags=1\n",
    );
    assert_eq!(checked.device().name, "Valve");
    let item = checked.item(0x2000, 0);
    assert_eq!((item.name.as_str(), item.access, item.flags), ("Speed", Access::ReadWrite, 1));
    assert_eq!(item.default, Some(Value::Int(4)));
    assert!(item.mappable.rpdo && item.mappable.tpdo && item.limits.low.is_some() && item.limits.high.is_some());
    assert_eq!(checked.codes(), [""; 0]);
}

#[test]
fn e26_lower_case_index() {
    let checked = read("[200a]\nParameterName=Speed\nDataType=0x0005\nAccessType=rw\n");
    assert_eq!(checked.item(0x200A, 0).name, "Speed");
    assert_eq!(checked.codes(), [""; 0]);
}

#[test]
fn e27_repeated_section() {
    let checked = read(
        "[2000]\nParameterName=First\nDataType=0x0005\nAccessType=rw\n\
         [2001]\nParameterName=Between\nDataType=0x0005\nAccessType=rw\n\
         [2000]\nParameterName=Second\nDefaultValue=7\n",
    );
    let item = checked.item(0x2000, 0);
    assert_eq!((item.name.as_str(), item.access), ("Second", Access::ReadWrite));
    assert_eq!(item.default, Some(Value::Int(7)), "an entry of the second section alone");
    assert_eq!(checked.device().groups.iter().filter(|group| group.index() == Some(0x2000)).count(), 1);
    assert_eq!(checked.codes(), ["EDS007", "EDS008"]);
    assert_eq!((checked.places("EDS007"), checked.places("EDS008")), (vec![(9, 2)], vec![(10, 1)]));
}

#[test]
fn e27_repeated_sub_section_and_header_section() {
    let checked = read(
        "[2000]\nParameterName=Speeds\nObjectType=9\nSubNumber=1\n\
         [2000sub0]\nParameterName=Count\nDataType=0x0005\nAccessType=ro\n\
         [2000SUB0]\nDefaultValue=0\n\
         [Comments]\nLines=1\nLine1=a\n[comments]\nLine2=b\n",
    );
    assert_eq!(checked.default(0x2000, 0), Some(Value::Int(0)));
    assert_eq!(checked.device().header.comments, ["a", "b"]);
    assert_eq!(checked.places("EDS007"), [(9, 2), (14, 2)]);
    assert_eq!(checked.codes().len(), 2);
}

#[test]
fn e27_repeated_sections_of_the_header_are_one() {
    let checked = read_dcf(
        "[FileInfo]\nFileName=a\nAuthor=me\n[DeviceInfo]\nVendorName=Maker\nVendorNumber=1\n\
         [FileInfo]\nFileVersion=1\nFileRevision=1\nEDSVersion=4.0\nReviewer=you\n\
         [DeviceInfo]\nProductName=Pump\nProductNumber=2\nRevisionNumber=3\n\
         [DummyUsage]\nDummy0007=1\nDummy0005=1\n[DummyUsage]\nDummy0007=0\n\
         [Comments]\nLines=1\nLine1=first\n[Comments]\nLines=1\nLine1=last\n\
         [ConnectedModules]\nNrOfEntries=1\n1=4\n[ConnectedModules]\n1=7\n\
         [DynamicChannels]\nNrOfSeg=1\nType1=5\nDir1=rww\n[DynamicChannels]\nType1=7\n\
         [2000]\nParameterName=Speed\nDataType=0x0005\nAccessType=rw\n\
         [2000ObjectLinks]\nObjectLinks=1\n1=0x1000\n[2000ObjectLinks]\n1=0x1001\n",
    );
    let device = checked.device();
    let canopen = device.canopen.as_ref().unwrap();
    assert_eq!((device.header.file_version.as_str(), device.name.as_str()), ("1", "Pump"));
    assert_eq!(canopen.dummies, [5]);
    assert_eq!(device.header.comments, ["last"]);
    assert_eq!(device.commissioning.as_ref().unwrap().connected_modules, [7]);
    let channels: Vec<_> = canopen.dynamic_channels.iter().map(|own| (own.data_type, own.direction.as_str())).collect();
    assert_eq!(channels, [(7, "rww")]);
    assert_eq!(checked.group(0x2000).links, [0x1001]);
    let lines = |code| checked.places(code).iter().map(|place| place.0).collect::<Vec<_>>();
    assert_eq!(lines("EDS007"), [7, 12, 19, 24, 30, 36, 45]);
    assert_eq!(lines("EDS008"), [20, 25, 26, 31, 37, 46]);
    assert_eq!(checked.codes().len(), 13, "{:?}", checked.codes());
    let kept: Vec<_> = device.extensions.iter().map(|own| own.key.as_str()).collect();
    assert_eq!(kept, ["FileInfo/Author", "FileInfo/Reviewer"]);
}

#[test]
fn e27_every_repetition_is_told_however_many_sections_there_are() {
    let repeated = "[DummyUsage]\n".repeat(20) + "[Comments]\nLines=0\n[Comments]\n";
    let checked = read(&repeated);
    assert_eq!(checked.places("EDS007").last(), Some(&(23, 2)));
    assert_eq!(checked.codes(), ["EDS007"; 20]);
}

#[test]
fn e28_repeated_key() {
    let checked = read(&var(U8, "DefaultValue=1\ndefaultvalue=2"));
    assert_eq!(checked.default(0x2000, 0), Some(Value::Int(2)));
    assert_eq!(checked.codes(), ["EDS008"]);
    assert_eq!(checked.places("EDS008"), [(7, 1)]);
    assert_eq!(checked.only("EDS008").notes.len(), 1, "the first is shown, too");
}

#[test]
fn e28_repeated_key_in_every_kind_of_section() {
    let checked = read(
        "[FileInfo]\nFileName=a\nFileName=b\nFileVersion=1\nFileRevision=1\nEDSVersion=4.0\n\
         [DeviceInfo]\nVendorName=Maker\nVendorNumber=1\nProductName=Pump\nProductNumber=2\n\
         BaudRate_250=1\nBaudRate_250=0\n\
         [DummyUsage]\nDummy0005=1\nDummy0005=0\n\
         [Comments]\nLines=1\nLine1=a\nLine1=b\n\
         [DynamicChannels]\nNrOfSeg=1\nType1=5\nType1=6\n\
         [ManufacturerObjects]\nSupportedObjects=1\n1=0x2001\n1=0x2000\n\
         [2000]\nParameterName=Speed\nDataType=0x0005\nAccessType=rw\nUnit=V\nUnit=A\n",
    );
    let canopen = checked.device().canopen.as_ref().unwrap();
    assert_eq!(checked.device().header.file_name, "b");
    assert_eq!(checked.device().header.comments, ["b"]);
    assert_eq!((&canopen.bit_rates[..], &canopen.dummies[..]), (&[][..], &[][..]));
    assert_eq!(canopen.dynamic_channels[0].data_type, 6);
    let lines: Vec<u32> = checked.places("EDS008").iter().map(|place| place.0).collect();
    assert_eq!(lines, [3, 13, 16, 20, 24, 28, 34]);
    assert_eq!(checked.codes(), ["EDS008"; 7]);
}

#[test]
fn e29_utf8_byte_order_mark() {
    let text = file("[2000]\nParameterName=Gerät\nDataType=0x0005\nAccessType=rw\n");
    let bytes = [b"\xef\xbb\xbf", text.as_bytes()].concat();
    let checked = Checked(check(Source::new("pump.eds", bytes), &Options::default()));
    assert_eq!(checked.0.sources[0].encoding(), Encoding::Utf8Bom);
    assert_eq!(checked.info()["encoding"], "utf-8-bom");
    assert_eq!(checked.group(0x2000).name, "Gerät");
    assert_eq!(checked.group(0x2000).origin.line, 1, "the mark is no text before the first section");
    assert_eq!(checked.codes(), [""; 0]);
}

#[test]
fn e30_windows_1252() {
    let text = file("[2000]\nParameterName=Gerät\nDataType=0x0009\nAccessType=rw\nDefaultValue=5 \u{20ac}\n");
    let bytes = encoding_rs::WINDOWS_1252.encode(&text).0.into_owned();
    assert!(bytes.contains(&0xE4) && bytes.contains(&0x80));
    for (bytes, encoding) in
        [(bytes.clone(), Encoding::Windows1252), ([b"\xef\xbb\xbf", &bytes[..]].concat(), Encoding::Utf8Bom)]
    {
        let checked = Checked(check(Source::new("pump.eds", bytes), &Options::default()));
        assert_eq!(checked.0.sources[0].encoding(), encoding);
        assert_eq!(checked.group(0x2000).name, "Gerät");
        assert_eq!(checked.default(0x2000, 0), Some(Value::Text("5 €".into())));
        assert_eq!(checked.codes(), ["EDS013"]);
        assert_eq!(checked.places("EDS013"), [(2, 18)]);
        assert!(checked.rust().contains("Gerät"));
    }
}

#[test]
fn e30_utf16() {
    let text = file("[2000]\nParameterName=Gerät\nDataType=0x0005\nAccessType=rw\n");
    let bytes = text.encode_utf16().flat_map(u16::to_le_bytes);
    let bytes: Vec<u8> = [0xFF, 0xFE].into_iter().chain(bytes).collect();
    let checked = Checked(check(Source::new("pump.eds", bytes), &Options::default()));
    assert_eq!(checked.group(0x2000).name, "Gerät");
    assert_eq!(checked.codes(), ["EDS013"]);
}

#[test]
fn e31_line_ends() {
    let text = file("[2000]\nParameterName=Speed\nDataType=0x0005\nAccessType=rw\nDefaultValue=012\n");
    let mut ends = ["\r\n", "\n", "\r", "\n\r"].iter().cycle();
    let mixed: String = text.lines().map(|line| format!("{line}{}", ends.next().unwrap())).collect();
    let read = |text: &str| Checked(check(Source::new("pump.eds", text.as_bytes().to_vec()), &Options::default()));
    for text in [text.as_str(), text.trim_end(), mixed.as_str(), mixed.trim_end()] {
        let checked = read(text);
        assert_eq!(checked.device().groups.len(), 4);
        assert_eq!(checked.default(0x2000, 0), Some(Value::Int(10)));
        assert_eq!(checked.codes(), ["EDS020"]);
    }
    // LF CR is the end of a line and an empty line.
    assert_eq!(read(&mixed).places("EDS020"), [(6, 14)]);
}

#[test]
fn e32_control_z_at_the_end() {
    let text = file("[2000]\nParameterName=Speed\nDataType=0x0005\nAccessType=rw\n");
    for end in ["\u{1a}", "\u{1a}\u{1a}", "\n\u{1a}\n", "\u{1a}\n\0\0\0"] {
        let checked = read_as(&(text.clone() + end), "pump.eds", &Options::default());
        assert_eq!(checked.device().groups.len(), 4);
        assert_eq!(checked.codes(), [""; 0], "{end:?}");
    }
}

const SUB0: &str = "ParameterName=Count\nObjectType=7\nDataType=0x0005\nAccessType=ro\nDefaultValue=1\n";
const SUB1: &str = "ParameterName=Speed\nObjectType=7\nDataType=0x0006\nAccessType=rw\n";

#[test]
fn e33_sub_before_its_object() {
    let checked =
        read(&format!("[2022sub1]\n{SUB1}[2022sub0]\n{SUB0}[2022]\nParameterName=Speeds\nObjectType=9\nSubNumber=2\n"));
    assert_eq!(checked.subs(0x2022), [0, 1]);
    assert_eq!(checked.group(0x2022).origin.line, 12);
    assert_eq!(checked.codes(), [""; 0]);
}

#[test]
fn e33_sub_without_its_object() {
    let checked = read(&format!("[2022sub0]\n{SUB0}[2022sub1]\n{SUB1}"));
    assert_eq!(checked.group(0x2022).object_code(), Some(ObjectCode::Record));
    assert_eq!(checked.names(0x2022), ["Count", "Speed"]);
    assert_eq!(checked.places("EDS040"), [(1, 2)]);
    // The object has no name either.
    assert_eq!(checked.codes(), ["EDS040", "EDS038"]);
}

#[test]
fn e34_listed_object_without_section() {
    let checked = read("[OptionalObjects]\nSupportedObjects=1\n1=0x6505\n");
    assert!(checked.device().object(0x6505).is_none());
    assert_eq!(checked.codes(), ["EDS041"]);
    assert_eq!(checked.places("EDS041"), [(3, 3)]);
}

#[test]
fn e35_section_that_is_not_listed() {
    let object = "[2000]\nParameterName=Speed\nDataType=0x0005\nAccessType=rw\n";
    let checked = read(&format!("{object}[ManufacturerObjects]\nSupportedObjects=0\n"));
    assert_eq!(checked.item(0x2000, 0).name, "Speed");
    assert_eq!(checked.codes(), ["EDS042"]);
    assert_eq!(checked.places("EDS042"), [(1, 2)]);
    // A file without any list is one finding.
    let lists = "[MandatoryObjects]\nSupportedObjects=0\n[OptionalObjects]\nSupportedObjects=0\n\
                 [ManufacturerObjects]\nSupportedObjects=0\n";
    let checked = read(&format!("{object}{lists}"));
    assert_eq!(checked.device().groups.len(), 4);
    assert_eq!(checked.codes(), ["EDS042"]);
}

#[test]
fn e36_list_with_another_count() {
    let object = "[2000]\nParameterName=Speed\nDataType=0x0005\nAccessType=rw\n";
    let list = |entries: &str| read(&format!("[ManufacturerObjects]\n{entries}\n{object}"));
    let too_few = list("SupportedObjects=5\n1=0x2000");
    assert_eq!(too_few.codes(), ["EDS043"]);
    assert_eq!(too_few.places("EDS043"), [(2, 18)]);
    assert_eq!(too_few.only("EDS043").fix.as_deref(), Some("1"));
    let too_many = list("SupportedObjects=0\n1=0x2000");
    assert_eq!(too_many.codes(), ["EDS043"]);
    let gap = list("SupportedObjects=1\n3=0x2000");
    assert_eq!(gap.codes(), ["EDS043"]);
    assert_eq!(gap.places("EDS043"), [(3, 1)]);
    let gap_and_count = list("SupportedObjects=3\n3=0x2000");
    assert_eq!(gap_and_count.codes(), ["EDS043"], "one finding is enough");
    let hexadecimal = list("SupportedObjects=0x1\n1=0x2000");
    assert_eq!(hexadecimal.codes(), ["EDS071"]);
    assert_eq!(hexadecimal.places("EDS071"), [(2, 18)]);
    let no_count = list("1=0x2000");
    assert_eq!(no_count.codes(), [""; 0]);
    // An entry is used wherever its number stands, so that the object counts as listed.
    for checked in [too_few, too_many, gap, gap_and_count, hexadecimal, no_count] {
        assert!(!checked.codes().contains(&"EDS042"));
    }
}

#[test]
fn e37_spellings_of_listed_indices() {
    let objects = "[2000]\nParameterName=A\nDataType=0x0005\nAccessType=rw\n\
                   [2001]\nParameterName=B\nDataType=0x0005\nAccessType=rw\n";
    let checked = read(&format!("[ManufacturerObjects]\nSupportedObjects=2\n1= 0x2000\n2=8193\n{objects}"));
    assert_eq!(checked.codes(), [""; 0]);
    let twice = read(&format!("[ManufacturerObjects]\nSupportedObjects=3\n1=0x2000\n2=0x2001\n3=8192\n{objects}"));
    assert_eq!(twice.codes(), ["EDS044"]);
    assert_eq!(twice.places("EDS044"), [(5, 3)]);
    assert_eq!(twice.device().groups.len(), 5);
    let none = read(&format!("[ManufacturerObjects]\nSupportedObjects=3\n1=0x2000\n2=0x2001\n3=speed\n{objects}"));
    assert_eq!(none.codes(), ["EDS022"]);
    assert_eq!(none.places("EDS022"), [(5, 3)]);
}
