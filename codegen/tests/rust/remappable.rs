//! Tests which PDOs of a CANopen device can be remapped, and the generated input of `lexibus::pdo!`.

use crate::compile_support;

use lexibus_codegen::compile::{check, Options};
use lexibus_codegen::source::Source;

/// Returns an EDS of a device with one RPDO and some objects. `count` contains the access rights of the number of
/// mapped entries, and `entry` those of the third entry. `cob_id` contains the access rights and the default value of
/// the COB-ID.
fn device(granularity: &str, count: &str, entry: &str, cob_id: &str) -> String {
    format!(
        "[DeviceInfo]\nProductName=Device\nGranularity={granularity}\nNrOfRXPDO=1\n\
         [DummyUsage]\nDummy0001=0\nDummy0005=1\nDummy0006=1\n\
         [1400]\nParameterName=Communication\nObjectType=9\nSubNumber=3\n\
         [1400sub0]\nParameterName=Highest\nDataType=5\nAccessType=ro\nDefaultValue=2\n\
         [1400sub1]\nParameterName=COB-ID\nDataType=7\n{cob_id}\n\
         [1400sub2]\nParameterName=Type\nDataType=5\nAccessType=rw\nDefaultValue=255\n\
         [1600]\nParameterName=Mapping\nObjectType=9\nSubNumber=4\n\
         [1600sub0]\nParameterName=Number\nDataType=5\nAccessType={count}\nDefaultValue=0\n\
         [1600sub1]\nParameterName=First\nDataType=7\nAccessType=rw\n\
         [1600sub2]\nParameterName=Second\nDataType=7\nAccessType=rw\n\
         [1600sub3]\nParameterName=Third\nDataType=7\nAccessType={entry}\n\
         [2000]\nParameterName=u16\nObjectType=9\nSubNumber=3\n\
         [2000sub0]\nParameterName=Highest\nDataType=5\nAccessType=ro\nDefaultValue=2\n\
         [2000sub1]\nParameterName=u16\nDataType=6\nAccessType=rw\nPDOMapping=1\n\
         [2000sub2]\nParameterName=type\nDataType=0x10\nAccessType=ro\nPDOMapping=1\n\
         [2001]\nParameterName=Internal\nDataType=6\nAccessType=rw\nPDOMapping=0\n\
         [2002]\nParameterName=Name\nDataType=9\nAccessType=rw\nPDOMapping=1\n"
    )
}

const COB_ID: &str = "AccessType=rw\nDefaultValue=$NODEID+0x200";

/// Returns the part of the generated code that `lexibus::pdo!` reads, or `None` if there is none. The code must compile.
fn modules(eds: String) -> Option<String> {
    let options = Options::default();
    let text = check(Source::new("device.eds", eds.into()), &options).rust(&options.rust).expect("bindings");
    compile_support::compile("device.eds", &text).unwrap_or_else(|message| panic!("{message}\n{text}"));
    let start = text.find("/// PDOs with a writable mapping")?;
    let end = text[start..].find("\n/// PDOs with their default mapping").map_or(text.len(), |end| start + end);
    Some(text[start..end].to_owned())
}

#[test]
fn limits_are_those_of_the_description() {
    let text = modules(device("8", "rw", "rw", COB_ID)).expect("a PDO that can be mapped");
    for line in [
        "pub enum RxPdo1 {}",
        "type Direction = rt::Rpdo;",
        "type CobId = rt::CobId;",
        "const INDEX: u16 = 0x1600;",
        "const ENTRIES: usize = 3;",
        "const GRANULARITY: u32 = 8;",
        "const DUMMIES: u32 = 0x60;",
        "const COMMUNICATION: Option<u16> = Some(0x1400);",
        "rt::SdoWrite::new_u8(0x1400, 0x02, 255),",
        "const COB_ID: rt::CobId = rt::CobId::from_node(0x200);",
        // A name that would hide a Rust type gets an underscore.
        "pub type u16_ = rt::Mappable<u16, rt::AnyPdo, 0x2000_0110>;",
        "pub type r#type = rt::Mappable<rt::Int<24>, rt::Tpdo, 0x2000_0218>;",
    ] {
        assert!(text.contains(line), "{line}\n{text}");
    }
    // `pdo!` refuses values that cannot be mapped or have no fixed size.
    for name in ["internal", "name"] {
        assert!(text.contains(&format!("pub type {name} = rt::pdo::NotMappable;")), "{text}");
    }
}

#[test]
fn an_entry_that_nobody_may_write_ends_the_mapping() {
    let text = modules(device("1", "rw", "ro", COB_ID)).expect("a PDO that can be mapped");
    assert!(text.contains("const ENTRIES: usize = 2;") && !text.contains("GRANULARITY"), "{text}");
}

#[test]
fn an_identifier_may_be_missing_or_fixed() {
    let text = modules(device("8", "rw", "rw", "AccessType=rw\nDefaultValue=0x80000000")).expect("mappable");
    assert!(text.contains("type CobId = rt::pdo::NoCobId;") && !text.contains("COB_ID"), "{text}");
    assert!(text.contains("COMMUNICATION"), "{text}");
    let text = modules(device("8", "rw", "rw", "AccessType=ro\nDefaultValue=$NODEID+0x200")).expect("mappable");
    assert!(text.contains("const COB_ID") && !text.contains("COMMUNICATION"), "{text}");
}

#[test]
fn a_fixed_mapping_costs_nothing() {
    assert_eq!(modules(device("8", "ro", "rw", COB_ID)), None);
    assert_eq!(modules(device("0", "rw", "rw", COB_ID)), None);
}
