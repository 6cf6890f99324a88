//! Tests the recorded origins of facts that do not come from the description itself.

use lexibus_codegen::compile::{check, Options};
use lexibus_codegen::ir::{Device, Fact, FactOrigin, IdentityNumber, Item, Rule};
use lexibus_codegen::source::Source;

const EDS: &str = "[DeviceInfo]\nProductName=Drive\nVendorNumber=5\nCompactPDO=0x3\nNrOfRXPDO=1\n\
    [1000]\nParameterName=Device type\nDataType=7\nAccessType=ro\nDefaultValue=0x00020192\n\
    [2000]\nParameterName=Silent\nDataType=6\n\
    [2001]\nParameterName=Untyped\nAccessType=rw\n\
    [2002]\nParameterName=Block\nObjectType=2\n\
    [2003]\nParameterName=List\nObjectType=8\nDataType=6\nAccessType=rw\nCompactSubObj=2\n\
    [1018]\nParameterName=Identity\nObjectType=7\n\
    [1018sub0]\nParameterName=Count\nDataType=5\nAccessType=ro\nDefaultValue=2\n\
    [1018sub1]\nParameterName=Vendor\nDataType=7\nAccessType=ro\nDefaultValue=5\n\
    [1018sub2]\nParameterName=Product\nDataType=7\nAccessType=ro\nDefaultValue=9\n\
    [2004]\nParameterName=Complete\nDataType=6\nAccessType=rw\n\
    [6040]\nParameterName=Control\nDataType=6\nAccessType=rww\n\
    [6041]\nParameterName=Status\nDataType=6\nAccessType=ro\n";

fn device() -> Device {
    let compilation = check(Source::new("drive.eds", EDS.into()), &Options::default());
    compilation.catalog.expect("a catalog").devices.remove(0)
}

fn item(device: &Device, index: u16, sub: u8) -> &Item {
    device.entry(index, sub).unwrap_or_else(|| panic!("0x{index:04X}:{sub} exists"))
}

/// Returns the facts of an item that come from a rule.
fn facts(item: &Item, rule: Rule) -> Vec<Fact> {
    Fact::ALL.into_iter().filter(|fact| item.origins.get(*fact) == Some(&FactOrigin::Rule(rule))).collect()
}

#[test]
fn rules_are_the_origins_of_facts_that_the_file_lacks() {
    let device = device();
    let missing = |index, sub| facts(item(&device, index, sub), Rule::MissingKey);
    assert_eq!(missing(0x2000, 0), [Fact::Access]);
    assert_eq!(missing(0x2001, 0), [Fact::Type, Fact::Access]);
    assert_eq!(missing(0x2002, 0), [Fact::Access]);
    assert_eq!(missing(0x2003, 1), []);
    assert_eq!(
        facts(item(&device, 0x2003, 0), Rule::CompactObject),
        [Fact::Name, Fact::Type, Fact::Access, Fact::Default]
    );
    assert!(item(&device, 0x2004, 0).origins.is_empty());
    let implicit = device.object(0x1400).expect("the implicit PDO");
    assert_eq!(implicit.origins.get(Fact::Name), Some(&FactOrigin::Rule(Rule::AnnouncedPdo)));
    assert_eq!(facts(&implicit.items[0], Rule::AnnouncedPdo)[..2], [Fact::Name, Fact::Type]);
    let rust = check(Source::new("drive.eds", EDS.into()), &Options::default()).rust(&Options::default().rust);
    assert!(rust.expect("bindings").contains("Access rights from the rule for missing or unknown attributes."));
}

#[test]
fn a_profile_is_the_origin_of_its_definitions() {
    let device = device();
    let is_standard = |origin: Option<&FactOrigin>| matches!(origin, Some(FactOrigin::Standard(clause)) if clause.starts_with("CiA "));
    assert!(!device.types.is_empty() && device.types.iter().all(|added| is_standard(added.stated_by.as_deref())));
    assert!(!device.code_tables.is_empty());
    assert!(device.code_tables.iter().all(|table| is_standard(table.stated_by.as_deref())));
    assert_eq!(device.machines.len(), 1);
    assert!(is_standard(device.machines[0].stated_by.as_deref()));
    assert!(is_standard(item(&device, 0x6041, 0).origins.get(Fact::Description)));
}

#[test]
fn object_0x1018_is_the_origin_of_numbers_that_the_header_lacks() {
    let device = device();
    let expected = (IdentityNumber::ProductCode, FactOrigin::Rule(Rule::IdentityObject));
    assert_eq!((device.identity.product_code, &device.identity.origins[..]), (Some(9), &[expected][..]));
    let rust = check(Source::new("drive.eds", EDS.into()), &Options::default()).rust(&Options::default().rust);
    assert!(rust.expect("bindings").contains("vendor, product and revision. Product code from object 0x1018."));
}

#[test]
fn sub_indices_are_the_origin_of_a_wrong_object_type() {
    let device = device();
    let origin = |index| device.object(index).expect("an object").origins.get(Fact::ObjectType);
    assert_eq!(origin(0x1018), Some(&FactOrigin::Rule(Rule::ObjectContents)), "a VAR with sub-indices");
    assert_eq!([0x2000, 0x2002, 0x2003].map(origin), [None; 3], "no object type, DOMAIN, and ARRAY");
    let rust = check(Source::new("drive.eds", EDS.into()), &Options::default()).rust(&Options::default().rust);
    assert!(rust
        .expect("bindings")
        .contains("RECORD 0x1018. Object type from the rule for missing or wrong object types."));
}

#[test]
fn pdo_entries_are_the_origin_of_the_pdo_mapping_of_objects_that_only_they_describe() {
    let esi = "<EtherCATInfo><Vendor><Id>1</Id></Vendor><Descriptions><Devices><Device><Type ProductCode=\"1\">D</Type>\
        <RxPdo Sm=\"2\"><Index>#x1600</Index><Name>Out</Name><Entry><Index>#x7000</Index><SubIndex>1</SubIndex>\
        <BitLen>16</BitLen><Name>Speed</Name><DataType>UINT</DataType></Entry></RxPdo></Device></Devices></Descriptions>\
        </EtherCATInfo>";
    let compilation = check(Source::new("drive.xml", esi.into()), &Options::default());
    let device = compilation.catalog.expect("a catalog").devices.remove(0);
    let item = item(&device, 0x7000, 1);
    assert_eq!((facts(item, Rule::MappedObject), item.mappable.rpdo), (vec![Fact::Access, Fact::Mappable], true));
}
