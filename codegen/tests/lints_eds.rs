//! The lints that a checker of EDS files is expected to have: each is triggered by a small vector, says where, and is
//! silent on a file without the fault.

mod compile_support;
#[path = "quirks_eds/support.rs"]
mod support;

use std::collections::BTreeSet;

use lexibus_codegen::compile::{check, Options};
use lexibus_codegen::diagnostics::codes::CODES;
use lexibus_codegen::diagnostics::Level;
use lexibus_codegen::ir::Value;
use lexibus_codegen::source::Source;
use support::*;

/// A file with one of everything, and nothing wrong.
const CLEAN: &str = "[FileInfo]
FileName=pump.dcf
FileVersion=1
FileRevision=1
EDSVersion=4.0
CreationTime=09:30AM
CreationDate=12-31-2020
LastEDS=pump.eds
[DeviceInfo]
VendorName=Maker
VendorNumber=1
ProductName=Pump
ProductNumber=2
RevisionNumber=3
BaudRate_125=1
Granularity=8
GroupMessaging=1
NrOfRXPDO=2
NrOfTXPDO=2
LSS_Supported=0
[DummyUsage]
Dummy0005=1
[Comments]
Lines=1
Line1=clean
[DeviceComissioning]
NodeID=5
Baudrate=125
[SupportedModules]
NrOfEntries=1
[M1ModuleInfo]
ProductName=Inputs
ProductVersion=1
ProductRevision=1
OrderCode=I
[M1FixedObjects]
NrOfEntries=1
1=0x2100
[M1Fixed2100]
ParameterName=Filter
ObjectType=0x7
DataType=0x0005
AccessType=rwr
PDOMapping=1
[M1SubExtends]
NrOfEntries=1
1=0x2003
[M1SubExt2003]
ParameterName=Input
DataType=0x0005
AccessType=ro
Count=1
ObjExtend=0
[OptionalObjects]
SupportedObjects=8
1=0x1400
2=0x1401
3=0x1600
4=0x1601
5=0x1800
6=0x1801
7=0x1A00
8=0x1A01
[ManufacturerObjects]
SupportedObjects=4
1=0x2000
2=0x2001
3=0x2002
4=0x2003
[1400]
ParameterName=RPDO 1
ObjectType=0x9
SubNumber=2
[1400sub0]
ParameterName=Highest sub-index
DataType=0x0005
AccessType=const
DefaultValue=1
[1400sub1]
ParameterName=COB-ID
DataType=0x0007
AccessType=rw
DefaultValue=$NODEID+0x200
[1600]
ParameterName=Mapping of RPDO 1
ObjectType=0x9
SubNumber=3
[1600sub0]
ParameterName=Mapped objects
DataType=0x0005
AccessType=rw
DefaultValue=2
[1600sub1]
ParameterName=First
DataType=0x0007
AccessType=rw
DefaultValue=0x20000010
[1600sub2]
ParameterName=Second
DataType=0x0007
AccessType=rw
DefaultValue=0x00050008
[1401]
ParameterName=RPDO 2
ObjectType=0x9
CompactSubObj=1
DataType=0x0007
AccessType=rw
DefaultValue=0x80000000
[1601]
ParameterName=Multiplexed
ObjectType=0x9
SubNumber=1
[1601sub0]
ParameterName=Destination addressing
DataType=0x0005
AccessType=ro
DefaultValue=255
[1800]
ParameterName=TPDO 1
ObjectType=0x9
CompactSubObj=1
DataType=0x0007
AccessType=rw
DefaultValue=$NODEID+0x180
[1A00]
ParameterName=Mapping of TPDO 1
ObjectType=0x9
SubNumber=3
[1A00sub0]
ParameterName=Mapped objects
DataType=0x0005
AccessType=rw
DefaultValue=2
[1A00sub1]
ParameterName=First
DataType=0x0007
AccessType=rw
DefaultValue=0x20010010
[1A00sub2]
ParameterName=Second
DataType=0x0007
AccessType=rw
DefaultValue=0x21000008
[1801]
ParameterName=TPDO 2
ObjectType=0x9
CompactSubObj=1
DataType=0x0007
AccessType=rw
DefaultValue=0x80000000
[1A01]
ParameterName=Extended by modules
ObjectType=0x9
SubNumber=2
[1A01sub0]
ParameterName=Mapped objects
DataType=0x0005
AccessType=rw
DefaultValue=1
[1A01sub1]
ParameterName=First
DataType=0x0007
AccessType=rw
DefaultValue=0x20030208
[2000]
ParameterName=Output
ObjectType=0x7
DataType=0x0006
AccessType=rww
PDOMapping=1
LowLimit=0
HighLimit=100
DefaultValue=50
[2001]
ParameterName=Input
ObjectType=0x7
DataType=0x0003
AccessType=ro
PDOMapping=1
[2001ObjectLinks]
ObjectLinks=1
1=0x2000
[2002]
ParameterName=Array
ObjectType=0x8
CompactSubObj=2
DataType=0x0006
AccessType=rw
[2002Name]
NrOfEntries=1
2=Second
[2003]
ParameterName=Extended
ObjectType=0x8
SubNumber=2
[2003sub0]
ParameterName=Highest sub-index
DataType=0x0005
AccessType=ro
DefaultValue=1
[2003sub1]
ParameterName=Input
DataType=0x0005
AccessType=ro
PDOMapping=1
";

/// The whole clean file, with `from` replaced by `to`; all lints are on.
fn with(from: &str, to: &str) -> Checked {
    assert_eq!(CLEAN.matches(from).count(), 1, "{from:?} has to be in the clean file once");
    lints(&CLEAN.replace(from, to))
}

fn lints(vector: &str) -> Checked {
    let mut options = Options::default();
    for code in CODES {
        options.levels.set(code.id, Level::Warn).unwrap();
    }
    read_as(&file(vector), "pump.dcf", &options)
}

/// Asserts that the change gives rise to `codes` and nothing else.
#[track_caller]
fn assert_lint(from: &str, to: &str, codes: &[&str]) {
    assert_eq!(with(from, to).codes(), codes, "{from:?} -> {to:?}");
}

/// The line of the clean file that `text` stands in.
fn line_of(text: &str) -> u32 {
    let at = CLEAN.find(text).unwrap();
    CLEAN[..at].lines().count() as u32 + u32::from(CLEAN[..at].ends_with('\n') || at == 0)
}

#[test]
fn a_clean_file_is_clean() {
    let checked = lints(CLEAN);
    assert_eq!(checked.codes(), [""; 0]);
    assert_eq!(checked.device().process_data.pdos.len(), 4);
    assert_eq!(lints("").codes(), [""; 0]);
}

// Structure.

#[test]
fn missing_section() {
    for section in ["FileInfo", "DeviceInfo", "MandatoryObjects"] {
        let text = file("");
        let options = Options::default();
        let checked = read_as(&text.replace(&format!("[{section}]"), "[Tools]"), "pump.eds", &options);
        assert!(checked.codes().contains(&"EDS069"), "{section}");
        assert!(checked.only("EDS069").message.contains(section));
    }
    assert_lint("[SupportedModules]\nNrOfEntries=1\n", "", &["EDS069"]);
}

#[test]
fn wrong_brackets() {
    let object = "ParameterName=Speed\nDataType=0x0005\nAccessType=rw\n";
    for (header, code) in [("[2004", "EDS005"), ("[2004] x", "EDS005")] {
        let checked = lints(&format!("{header}\n{object}"));
        assert!(checked.device().object(0x2004).is_some(), "{header}");
        assert!(checked.codes().contains(&code), "{header}");
        let column = if header.ends_with('x') { 8 } else { 1 };
        assert_eq!(checked.places(code), [(1, column)], "{header}");
    }
    for header in ["(2004)", "{2004}", "2004]"] {
        let checked = lints(&format!("[2000]\n{object}{header}\n"));
        assert_eq!(checked.places("EDS003"), [(5, 1)], "{header}");
    }
}

#[test]
fn bracket_not_in_the_first_column() {
    assert_lint("[2000]", " [2000]", &["EDS006"]);
    assert_eq!(with("[2000]", "\t[2000]").places("EDS006"), [(line_of("[2000]"), 2)]);
}

#[test]
fn duplicate_section() {
    for section in ["[2003sub1]", "[2001ObjectLinks]", "[2002Name]", "[M1SubExt2003]", "[M1ModuleInfo]", "[DummyUsage]"]
    {
        let twice = format!("{section}\n{section}");
        let checked = with(&format!("{section}\n"), &(twice + "\n"));
        assert_eq!(checked.places("EDS007"), [(line_of(section) + 1, 2)], "{section}");
    }
    let links = lints("[2000]\nParameterName=A\nDataType=5\nAccessType=ro\n[x]\na=1\n[X]\na=1\n");
    assert_eq!(links.codes(), ["EDS011", "EDS011", "EDS007"]);
}

#[test]
fn illegal_section_character() {
    for (name, fix) in [
        ("02000", "2000"),
        ("0x2000", "2000"),
        ("200", "0200"),
        ("2003 sub1", "2003sub1"),
        ("2003sub 1", "2003sub1"),
        ("2003sub01", "2003sub1"),
        ("2002 Name", "2002Name"),
        ("M01Comments", ""),
    ] {
        let checked = lints(&format!("[{name}]\nParameterName=A\nDataType=0x0005\nAccessType=rw\n"));
        assert_eq!(checked.places("EDS010"), [(1, 2)], "{name}");
        assert_eq!(checked.only("EDS010").fix.as_deref().unwrap_or(""), fix, "{name}");
    }
}

#[test]
fn duplicate_unknown_missing_and_not_allowed_entries() {
    assert_lint("HighLimit=100", "HighLimit=100\nHighLimit=101", &["EDS008"]);
    assert_lint("HighLimit=100", "HighLimit=100\nUpperLimit=101", &["EDS012"]);
    for (missing, section) in [
        ("FileName=pump.dcf\n", "[FileInfo]"),
        ("FileRevision=1\n", "[FileInfo]"),
        ("VendorName=Maker\n", "[DeviceInfo]"),
        ("VendorNumber=1\n", "[DeviceInfo]"),
        ("NodeID=5\n", "[DeviceComissioning]"),
        ("SupportedObjects=8\n", "[OptionalObjects]"),
        ("ObjectLinks=1\n", "[2001ObjectLinks]"),
    ] {
        let checked = with(missing, "");
        assert_eq!(checked.codes(), ["EDS062"], "{missing}");
        assert_eq!(checked.places("EDS062"), [(line_of(section), 2)], "{missing}");
    }
    assert_lint("ParameterName=Filter\n", "", &["EDS038"]);
    for (from, to) in [
        ("LowLimit=0\n", "LowLimit=0\nSubNumber=2\n"),
        ("ParameterName=Extended\n", "ParameterName=Extended\nDataType=0x0005\n"),
        ("ParameterName=Extended\n", "ParameterName=Extended\nDefaultValue=3\n"),
        ("ParameterName=Extended\n", "ParameterName=Extended\nHighLimit=3\n"),
    ] {
        assert_lint(from, to, &["EDS070"]);
    }
    let checked = with("ParameterName=Extended\n", "ParameterName=Extended\nDefaultValue=3\n");
    assert_eq!(checked.places("EDS070"), [(line_of("ParameterName=Extended\n") + 1, 1)]);
    assert_eq!(value_of(&checked.group(0x2003).extensions, "DefaultValue"), Some("3"), "it is kept");
    // What says nothing does no harm.
    assert_lint("ParameterName=Extended\n", "ParameterName=Extended\nDataType=\nPDOMapping=0\n", &[]);
    assert_lint("LowLimit=0\n", "LowLimit=0\nSubNumber=0\nCompactSubObj=0\n", &[]);
}

#[test]
fn value_longer_than_255() {
    let checked = with("ParameterName=Output", &format!("ParameterName={}", "x".repeat(260)));
    assert_eq!(checked.codes(), ["EDS009"]);
    assert_eq!(checked.places("EDS009"), [(line_of("ParameterName=Output"), 1)]);
}

#[test]
fn illegal_number() {
    assert_lint("DefaultValue=50", "DefaultValue=018", &["EDS021"]);
    assert_lint("DefaultValue=50", "DefaultValue=012", &["EDS020"]);
    assert_lint("DefaultValue=50", "DefaultValue=fifty", &["EDS022"]);
    assert_lint("DefaultValue=50", "DefaultValue=32h", &["EDS023"]);
    assert_lint("DefaultValue=50", "DefaultValue=50u", &["EDS015"]);
    assert_lint("NrOfRXPDO=2", "NrOfRXPDO=two", &["EDS022"]);
    assert_lint("1=0x2100", "1=2100h", &["EDS023"]);
}

#[test]
fn value_out_of_range() {
    assert_lint("HighLimit=100", "HighLimit=0x10000", &["EDS025"]);
    assert_lint("Granularity=8", "Granularity=200", &["EDS064", "PDO011", "PDO011", "PDO011", "PDO011", "PDO011"]);
    assert_lint("NodeID=5", "NodeID=128", &["EDS064"]);
    assert_lint("NodeID=5", "NodeID=0", &["EDS064"]);
    assert_lint("VendorNumber=1", "VendorNumber=0x100000000", &["EDS022"]);
    assert_lint("ParameterName=Input\nObjectType=0x7", "ParameterName=Input\nObjectType=0x1", &["EDS067"]);
    // Only a VAR or a DOMAIN can be a sub-index.
    assert_lint("ParameterName=COB-ID\n", "ParameterName=COB-ID\nObjectType=0x8\n", &["EDS067"]);
}

// Lists.

#[test]
fn digits_beyond_the_type() {
    assert_lint("HighLimit=100", "HighLimit=0x000064", &["TAB012"]);
    assert_lint("HighLimit=100", "HighLimit=0x0000000064", &["TAB012"]);
    assert_lint("HighLimit=100", "HighLimit=0x0064", &[]);
    // As tools write it.
    let text = CLEAN.replace("HighLimit=100", "HighLimit=0x00000064");
    let found = |options: &Options| {
        let found = check(Source::new("clean.dcf", text.clone().into_bytes()), options);
        found.diagnostics.list().iter().filter(|own| own.code.id == "TAB012").count()
    };
    let mut options = Options::default();
    assert_eq!(found(&options), 0);
    options.levels.set("hex-digits", Level::Warn).unwrap();
    assert_eq!(found(&options), 1);
}

#[test]
fn a_reading_that_is_never_zero() {
    let input = "DataType=0x0003\nAccessType=ro\nPDOMapping=1\n";
    let limits = |low: i32| format!("{input}LowLimit={low}\nHighLimit=9\n");
    assert_lint(input, &limits(5), &["TAB023"]);
    assert_lint(input, &limits(-9), &[]);
}

#[test]
fn fewer_entries_than_announced() {
    for (from, to) in [
        ("SupportedObjects=4", "SupportedObjects=5"),
        ("SupportedObjects=8", "SupportedObjects=7"),
        ("ObjectLinks=1", "ObjectLinks=2"),
        ("NrOfEntries=1\n2=Second", "NrOfEntries=2\n2=Second"),
        ("[M1FixedObjects]\nNrOfEntries=1", "[M1FixedObjects]\nNrOfEntries=2"),
    ] {
        assert_lint(from, to, &["EDS043"]);
    }
}

#[test]
fn object_in_the_wrong_list() {
    let checked = with("1=0x2000\n2=0x2001", "1=0x1400\n2=0x2001");
    assert!(checked.codes().contains(&"EDS045"));
    let vector = "[MandatoryObjects]\nSupportedObjects=4\n1=0x1000\n2=0x1001\n3=0x1018\n4=0x1008\n\
                  [1008]\nParameterName=Name\nDataType=0x0009\nAccessType=const\n\
                  [OptionalObjects]\nSupportedObjects=0\n";
    let checked = lints(vector);
    assert_eq!(checked.codes(), ["EDS045"]);
    assert_eq!(checked.places("EDS045"), [(6, 3)]);
    assert_eq!(checked.only("EDS045").label, "it belongs into [OptionalObjects]");
}

#[test]
fn listed_object_missing() {
    let checked = with("4=0x2003\n", "4=0x2003\n5=0x2004\n");
    assert!(checked.codes().contains(&"EDS041"));
    assert_eq!(checked.places("EDS041"), [(line_of("4=0x2003") + 1, 3)]);
}

#[test]
fn object_that_is_not_listed() {
    let checked = lints(&CLEAN.replace("SupportedObjects=4", "SupportedObjects=3").replace("4=0x2003\n", ""));
    assert_eq!(checked.codes(), ["EDS042"]);
    // The objects of a module, too.
    assert_lint("[M1FixedObjects]\nNrOfEntries=1\n1=0x2100", "[M1FixedObjects]\nNrOfEntries=0", &["EDS042"]);
}

#[test]
fn duplicate_index() {
    let checked =
        lints(&CLEAN.replace("SupportedObjects=4", "SupportedObjects=5").replace("4=0x2003\n", "4=0x2003\n5=0x2003\n"));
    assert_eq!(checked.codes(), ["EDS044"]);
    assert_lint("[M1FixedObjects]\nNrOfEntries=1\n", "[M1FixedObjects]\nNrOfEntries=2\n2=0x2100\n", &["EDS044"]);
}

#[test]
fn object_link_to_a_missing_object() {
    let checked = with("ObjectLinks=1\n1=0x2000", "ObjectLinks=1\n1=0x2999");
    assert_eq!(checked.codes(), ["EDS055"]);
    assert_eq!(checked.places("EDS055"), [(line_of("ObjectLinks=1") + 1, 3)]);
}

// Objects.

#[test]
fn neither_sub_number_nor_compact_sub_obj() {
    // With sub-indices, SubNumber is only an entry that is missing; without, nobody knows what the object is.
    assert_lint(
        "ParameterName=Extended\nObjectType=0x8\nSubNumber=2",
        "ParameterName=Extended\nObjectType=0x8",
        &["EDS062"],
    );
    let checked = read("[2000]\nParameterName=Speeds\nObjectType=0x8\n");
    assert_eq!(checked.codes(), ["EDS057"]);
    assert_eq!(checked.places("EDS057"), [(1, 2)]);
}

#[test]
fn missing_mandatory_object() {
    for index in ["1000", "1001", "1018"] {
        let renamed = |line: &str| match line.strip_prefix(&format!("[{index}")) {
            Some(rest) => format!("[2222{rest}\n"),
            None => format!("{line}\n"),
        };
        let text: String = file("").lines().map(renamed).collect();
        let checked = read_as(&text, "pump.eds", &Options::default());
        assert!(checked.only("EDS063").message.contains(&format!("0x{index}")));
    }
}

#[test]
fn sub_missing() {
    assert_lint(
        "ParameterName=Extended\nObjectType=0x8\nSubNumber=2",
        "ParameterName=Extended\nObjectType=0x8\nSubNumber=3",
        &["EDS046"],
    );
}

#[test]
fn sub_0_missing() {
    let from =
        "SubNumber=2\n[2003sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=1\n";
    assert_lint(from, "SubNumber=1\n", &["EDS058"]);
}

#[test]
fn sub_0_is_not_the_highest_sub_index() {
    assert_lint("AccessType=const\nDefaultValue=1", "AccessType=const\nDefaultValue=5", &["EDS049"]);
}

#[test]
fn elements_of_an_array_differ() {
    let from = "DefaultValue=1\n[2003sub1]";
    let to = "DefaultValue=3\n[2003sub3]\nParameterName=Odd\nDataType=0x0006\nAccessType=ro\n[2003sub1]";
    let checked = lints(
        &CLEAN
            .replace(from, to)
            .replace("Extended\nObjectType=0x8\nSubNumber=2", "Extended\nObjectType=0x8\nSubNumber=3"),
    );
    assert_eq!(checked.codes(), ["EDS059"]);
    assert_eq!(checked.only("EDS059").notes.len(), 1);
}

#[test]
fn reserved_and_complex_data_types() {
    for code in ["0x20", "0x21", "0x22", "0x23", "0x0E", "0x17", "0x1C", "0x1F"] {
        let checked = read(&format!("[2000]\nParameterName=A\nDataType={code}\nAccessType=ro\n"));
        assert_eq!(checked.codes(), ["EDS039"], "{code}");
        assert_eq!(checked.places("EDS039"), [(3, 10)]);
    }
    assert_eq!(read("[2000]\nParameterName=A\nDataType=0x24\nAccessType=ro\n").codes(), ["EDS036"]);
}

#[test]
fn compact_object_without_a_type() {
    let checked = with("CompactSubObj=2\nDataType=0x0006\n", "CompactSubObj=2\n");
    assert_eq!(checked.codes(), ["EDS065"]);
    assert_eq!(checked.places("EDS065"), [(line_of("[2002]"), 2)]);
}

#[test]
fn name_without_a_sub() {
    let checked = with("NrOfEntries=1\n2=Second", "NrOfEntries=1\n3=Third");
    assert_eq!(checked.codes(), ["EDS056"]);
    assert_eq!(checked.places("EDS056"), [(line_of("2=Second"), 1)]);
    assert_eq!(value_of(&checked.group(0x2002).extensions, "2002Name/3"), Some("Third"), "it is kept");
    assert_lint("NrOfEntries=1\n2=Second", "NrOfEntries=0\n0x2=Second", &["EDS056"]);
    let orphan = with("[2002Name]", "[2004Name]");
    assert_eq!(orphan.codes(), ["EDS056"]);
    assert_eq!(orphan.extension("2004Name/2"), Some("Second"));
}

#[test]
fn access_of_sub_0() {
    // Entries that can be written only once sub-index 0 is 0, and a sub-index 0 that can't be written.
    let mapped = "ParameterName=Mapped objects\nDataType=0x0005\nAccessType=rw\nDefaultValue=1\n";
    assert_lint(mapped, &mapped.replace("rw", "ro"), &["EDS060"]);
    // The other way round.
    let count = "[2003sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro";
    let checked = with(count, &count.replace("=ro", "=rw"));
    assert_eq!(checked.codes(), ["EDS060"]);
    assert_eq!(checked.places("EDS060"), [(line_of("[2003sub0]") + 3, 12)]);
}

// PDOs.

#[test]
fn mapped_against_its_access() {
    for (access, codes) in
        [("ro", &["PDO003"][..]), ("rwr", &["PDO003"]), ("const", &["PDO003"]), ("wo", &[]), ("rw", &["PDO017"])]
    {
        assert_lint("AccessType=rww", &format!("AccessType={access}"), codes);
    }
    let input = "DataType=0x0003\nAccessType=ro";
    for (access, codes) in
        [("wo", &["PDO003"][..]), ("rww", &["PDO003"]), ("const", &[]), ("rwr", &[]), ("rw", &["PDO017"])]
    {
        assert_lint(input, &input.replace("=ro", &format!("={access}")), codes);
    }
    let checked = with("AccessType=rww", "AccessType=rwr");
    assert_eq!(checked.places("PDO003"), [(line_of("DefaultValue=0x20000010"), 14)]);
    assert_eq!(checked.only("PDO003").notes.len(), 1, "the mapped object is shown");
}

#[test]
fn mapped_object_missing() {
    for word in ["0x29990010", "0x20000110"] {
        let checked = with("0x20000010", word);
        assert_eq!(checked.codes(), ["PDO001"], "{word}");
        assert_eq!(checked.places("PDO001"), [(line_of("DefaultValue=0x20000010"), 14)]);
    }
}

#[test]
fn mapped_object_not_mappable() {
    assert_lint("AccessType=rww\nPDOMapping=1", "AccessType=rww\nPDOMapping=0", &["PDO002"]);
}

#[test]
fn mapping_gap() {
    assert_lint("DefaultValue=0x20010010", "DefaultValue=0", &["PDO016", "PDO006"]);
    let checked = with("DefaultValue=0x20010010", "DefaultValue=");
    assert_eq!(checked.places("PDO006"), [(line_of("DefaultValue=0x20010010"), 1)]);
}

#[test]
fn pdo_of_more_than_64_bits() {
    let mut vector = CLEAN.replace("DefaultValue=2\n[1A00sub1]", "DefaultValue=5\n[1A00sub1]");
    vector = vector.replace(
        "[1A00]\nParameterName=Mapping of TPDO 1\nObjectType=0x9\nSubNumber=3",
        "[1A00]\nParameterName=Mapping of TPDO 1\nObjectType=0x9\nSubNumber=6",
    );
    for sub in 3..=5 {
        vector +=
            &format!("[1A00sub{sub}]\nParameterName=S{sub}\nDataType=0x0007\nAccessType=rw\nDefaultValue=0x20010010\n");
    }
    let checked = lints(&vector);
    assert_eq!(checked.codes(), ["PDO004"]);
    assert_eq!(checked.places("PDO004"), [(line_of("[1A00]"), 2)]);
    assert_eq!(checked.pdo(0x1A00).bits(), 72);
}

#[test]
fn mapped_with_another_length() {
    assert_lint("0x20000010", "0x20000008", &["PDO005"]);
    assert_lint("0x20000010", "0x20000020", &["PDO005"]);
}

#[test]
fn unmappable_type() {
    assert_lint("DataType=0x0003\nAccessType=ro", "DataType=0x0009\nAccessType=ro", &["PDO007"]);
}

#[test]
fn dummies_in_mappings() {
    let checked = with("DefaultValue=0x20010010", "DefaultValue=0x00050010");
    assert_eq!(checked.codes(), ["PDO008"]);
    assert_eq!(checked.places("PDO008"), [(line_of("DefaultValue=0x20010010"), 14)]);
    assert_lint("DefaultValue=0x00050008", "DefaultValue=0x00060010", &["PDO009"]);
    assert_lint("Dummy0005=1", "Dummy0005=0", &["PDO009"]);
    // Without [DummyUsage] nobody knows.
    assert_lint("[DummyUsage]\nDummy0005=1\n", "", &[]);
}

#[test]
fn another_number_of_pdos() {
    for (from, to) in [("NrOfRXPDO=2", "NrOfRXPDO=3"), ("NrOfTXPDO=2", "NrOfTXPDO=1")] {
        let checked = with(from, to);
        assert_eq!(checked.codes(), ["PDO010"], "{to}");
        assert_eq!(checked.places("PDO010"), [(line_of(from), 11)], "{to}");
    }
}

#[test]
fn number_of_pdos_in_0x1004() {
    let object = |value: &str| {
        let own =
            format!("[1004]\nParameterName=Number of PDOs\nDataType=0x0007\nAccessType=ro\nDefaultValue={value}\n");
        let listed = CLEAN.replace("SupportedObjects=8\n", "SupportedObjects=9\n9=0x1004\n");
        lints(&(own + &listed))
    };
    assert_eq!(object("0x00020002").codes(), [""; 0]);
    for value in ["0x00030002", "0x00020001"] {
        let checked = object(value);
        assert_eq!(checked.codes(), ["PDO013"], "{value}");
        assert_eq!(checked.places("PDO013"), [(5, 14)]);
    }
}

#[test]
fn granularity_and_mapping() {
    assert_lint("Granularity=8", "Granularity=16", &["PDO011"; 3]);
    let checked = with("DefaultValue=0x20010010", "DefaultValue=0x2001000C");
    assert_eq!(checked.codes(), ["PDO011", "PDO005"]);
    for fine in ["0", "1"] {
        assert_lint("Granularity=8", &format!("Granularity={fine}"), &[]);
    }
}

#[test]
fn multiplexed_pdo() {
    let checked = with("GroupMessaging=1", "GroupMessaging=0");
    assert_eq!(checked.codes(), ["PDO012"]);
    assert_eq!(checked.places("PDO012"), [(line_of("DefaultValue=255"), 14)]);
}

#[test]
fn half_a_pdo() {
    for (index, other) in [("1401", "1601"), ("1A01", "1801")] {
        let start = CLEAN.find(&format!("[{index}]")).unwrap();
        let rest = &CLEAN[start..];
        let end = rest
            .lines()
            .scan(0, |at, line| {
                let own = *at;
                *at += line.len() + 1;
                Some((own, line))
            })
            .find(|(_, line)| line.starts_with('[') && !line.starts_with(&format!("[{index}")))
            .unwrap()
            .0;
        let checked = lints(&CLEAN.replace(&rest[..end], ""));
        assert!(checked.codes().contains(&"PDO014"), "{index}");
        let line = CLEAN[..start].lines().count() as u32;
        let other = line_of(&format!("[{other}]"));
        let expected = if other > line { other - rest[..end].lines().count() as u32 } else { other };
        assert_eq!(checked.places("PDO014"), [(expected, 2)], "{index}");
    }
}

#[test]
fn mapping_that_cannot_be_read() {
    assert_lint("0x20000010", "$NODEID+0x20000010", &["PDO016", "PDO015"]);
}

#[test]
fn mapping_announces_more_than_it_has() {
    let count = "ParameterName=Mapped objects\nDataType=0x0005\nAccessType=rw\nDefaultValue=1\n";
    let checked = with(count, &count.replace("=1\n", "=4\n"));
    assert_eq!(checked.codes(), ["PDO016"]);
    assert_eq!(checked.places("PDO016"), [(line_of(count) + 3, 14)]);
}

// Modules.

#[test]
fn fixed_object_of_a_module_that_the_device_has() {
    let checked = lints(&CLEAN.replace("[M1Fixed2100]", "[M1Fixed2000]").replace("1=0x2100", "1=0x2000"));
    assert!(checked.codes().contains(&"MOD001"));
    assert_eq!(checked.places("MOD001"), [(line_of("[M1Fixed2100]"), 2)]);
    assert_eq!(checked.only("MOD001").notes.len(), 1, "the device's object is shown");
}

#[test]
fn rules_of_sub_extensions() {
    for (from, to, column) in [
        ("Count=1\n", "", 0),
        ("Count=1\n", "Count=\n", 0),
        ("Count=1\n", "Count=many\n", 7),
        ("Count=1\n", "Count=0\n", 7),
        ("Count=1\n", "Count=1;2\n", 7),
        ("Count=1\n", "Count=0;x\n", 7),
        ("ObjExtend=0", "ObjExtend=2", 11),
        ("ObjExtend=0", "ObjExtend=x", 11),
    ] {
        let checked = with(from, to);
        assert_eq!(checked.codes(), ["MOD002"], "{to}");
        let place = if column == 0 { (line_of("[M1SubExt2003]"), 2) } else { (line_of(from), column) };
        assert_eq!(checked.places("MOD002"), [place], "{to}");
    }
    assert_lint("Count=1\n", "Count=0;4\n", &[]);
    // Neither listed, nor of an object that has sub-indices.
    assert_lint("[M1SubExtends]\nNrOfEntries=1\n1=0x2003", "[M1SubExtends]\nNrOfEntries=0", &["MOD002"]);
    let var = lints(
        &CLEAN
            .replace("[M1SubExt2003]", "[M1SubExt2000]")
            .replace("[M1SubExtends]\nNrOfEntries=1\n1=0x2003", "[M1SubExtends]\nNrOfEntries=1\n1=0x2000"),
    );
    assert!(var.codes().contains(&"MOD002"));
    assert_eq!(var.places("MOD002"), [(line_of("[M1SubExt2003]"), 2)]);
    for (from, code) in [("DataType=0x0005\nAccessType=ro\nCount", "EDS035"), ("AccessType=ro\nCount", "EDS034")] {
        assert_lint(from, if code == "EDS035" { "AccessType=ro\nCount" } else { "Count" }, &[code]);
    }
}

#[test]
fn announced_module_that_is_not_described() {
    assert_lint("[SupportedModules]\nNrOfEntries=1", "[SupportedModules]\nNrOfEntries=2", &["EDS054"]);
    assert_lint("[M1SubExtends]\nNrOfEntries=1\n", "[M1SubExtends]\nNrOfEntries=2\n2=0x2002\n", &["EDS054"]);
}

// Header.

#[test]
fn old_eds_version() {
    let checked = with("EDSVersion=4.0", "EDSVersion=3.0");
    assert_eq!(checked.codes(), ["EDS053"]);
    assert_eq!(checked.places("EDS053"), [(line_of("EDSVersion"), 12)]);
    assert_lint("EDSVersion=4.0\n", "", &["EDS053"]);
}

#[test]
fn identity_differs_from_0x1018() {
    for (from, to) in [
        ("VendorNumber=1", "VendorNumber=5"),
        ("ProductNumber=2", "ProductNumber=5"),
        ("RevisionNumber=3", "RevisionNumber=5"),
    ] {
        let checked = with(from, to);
        assert_eq!(checked.codes(), ["EDS061"], "{to}");
        assert!(checked.places("EDS061")[0].0 > CLEAN.lines().count() as u32, "at the default of 0x1018");
    }
    let checked = lints(&CLEAN.replace("VendorNumber=1\n", "VendorNumber=\n"));
    assert_eq!(checked.device().identity.vendor_id, Some(1), "0x1018 says it, too");
}

/// Every code of the families that this file and its sibling are about is given out by at least one vector.
#[test]
fn every_code_is_given_out() {
    let mut seen = BTreeSet::new();
    let mut options = Options::default();
    for code in CODES {
        options.levels.set(code.id, Level::Warn).unwrap();
    }
    let mut try_out = |text: &str| {
        let bytes = encoding_rs::WINDOWS_1252.encode(text).0.into_owned();
        let compilation = check(Source::new("pump.dcf", bytes), &options);
        seen.extend(compilation.diagnostics.list().iter().map(|found| found.code.id));
    };
    try_out("[File]\nx=1;\n");
    try_out("[Tools]\n");
    try_out(include_str!("quirks_eds/everything.dcf"));
    let missing: Vec<&str> = CODES
        .iter()
        .map(|code| code.id)
        .filter(|id| ["EDS", "PDO", "MOD"].iter().any(|family| id.starts_with(family)) && !seen.contains(id))
        // Those of EtherCAT are in `lints_esi.rs`.
        .filter(|&id| !("PDO018"..="PDO024").contains(&id))
        .collect();
    assert_eq!(missing, [""; 0]);
}

#[test]
fn a_lint_does_not_change_what_is_read() {
    let lenient = read_dcf(CLEAN);
    let strict = lints(CLEAN);
    assert_eq!(lenient.device(), strict.device());
    assert_eq!(lenient.default(0x2000, 0), Some(Value::Int(50)));
}
