//! Tests exported EDS and DCF files, and the notes that an export returns.

use lexibus_codegen::compile::{check, read, Options};
use lexibus_codegen::ir::{Catalog, Device};
use lexibus_codegen::source::Source;
use lexibus_export::eds::{export, Export, Flavor, NoteKind};

/// An EDS with most features and many typical mistakes of real files.
const QUIRKY: &str = "\
; made by hand
[DeviceInfo]
VendorName=\"Example\"
VendorNumber=001
ProductName=Pump
NG_Slave=1
[FileInfo]
FileName=pump.dcf
Author=me
[Comments]
Lines=1
Line1=A pump
[2000]
ParameterName=Speed
DataType=0x0003 ; signed
AccessType=rww
PDOMapping=1
DefaultValue=0xFFFF
HighLimit=3000
ParameterValue=12
Unit=rpm
[2001]
ParameterName=Gain
ObjectType=8
DataType=0x0008
AccessType=rw
CompactSubObj=3
DefaultValue=1,5
[2001Name]
NrOfEntries=2
2=Second
7=Seventh
[2002]
ParameterName= \" Text; with # marks\"
ObjectType=9
SubNumber=2
[2002sub0]
ParameterName=Highest sub-index
DataType=5
AccessType=const
DefaultValue=1
[2002sub1]
ParameterName=Größe
DataType=9
AccessType=rw
DefaultValue=\"\"
[1400]
ParameterName=RPDO 1
ObjectType=9
SubNumber=1
[1400sub1]
ParameterName=COB-ID
DataType=7
AccessType=rw
DefaultValue=0x200+$NODEID
[2002ObjectLinks]
ObjectLinks=1
1=0x2000
[Vendor stuff]
Color=red
; painted
[2004Name]
NrOfEntries=1
1=Orphan
[DeviceComissioning]
NodeID=5
Baudrate=250
";

/// Returns options for reading a file without completing it from profiles.
fn options() -> Options {
    Options { no_profiles: true, ..Options::default() }
}

fn catalog(name: &str, text: &str) -> Catalog {
    check(Source::new(name, text.into()), &options()).catalog.expect("a catalog")
}

fn of(catalog: &Catalog, flavor: Flavor) -> Export {
    export(catalog, &catalog.devices[0], flavor).expect("objects")
}

fn notes(export: &Export) -> Vec<(NoteKind, usize, &str)> {
    export.notes.iter().map(|note| (note.kind, note.count, note.first.as_str())).collect()
}

#[test]
fn dcf_of_a_quirky_file() {
    let exported = of(&catalog("pump.dcf", QUIRKY), Flavor::Dcf);
    assert_eq!(notes(&exported), [(NoteKind::NotAscii, 1, "[2002sub1]")]);
    assert_eq!(exported.text.matches('\n').count(), exported.text.matches("\r\n").count());
    insta::assert_snapshot!(exported.text.replace('\r', ""));
}

#[test]
fn an_eds_has_no_configuration() {
    let exported = of(&catalog("pump.dcf", QUIRKY), Flavor::Eds);
    for absent in ["[DeviceComissioning]", "ParameterValue", "NodeID="] {
        assert!(!exported.text.contains(absent), "{absent}");
    }
    // The two facts are the commissioning of the node and the configured value of object 0x2000.
    assert_eq!(notes(&exported)[0], (NoteKind::Configuration, 2, "the device"));
}

#[test]
fn a_correct_file_stays_correct() {
    const DEMO: &str = include_str!("../../../../dictionaries/demo-drive.eds");
    let exported = of(&catalog("demo-drive.eds", DEMO), Flavor::Eds);
    assert_eq!(notes(&exported), []);
    let options = options();
    let [before, after] =
        [DEMO.to_owned(), exported.text].map(|text| check(Source::new("x.eds", text.into()), &options));
    let codes = |compilation: &lexibus_codegen::compile::Compilation| -> Vec<&str> {
        compilation.diagnostics.list().iter().map(|found| found.code.id).collect()
    };
    assert_eq!(codes(&before), codes(&after));
    let body = |text: String| text.split_once("\n\n").map(|(_, body)| body.to_owned());
    assert_eq!(
        after.rust(&options.rust).and_then(body),
        before.rust(&options.rust).and_then(body),
        "the same bindings, except for the digest of the file"
    );
}

const SLAVE: &str = "\
<EtherCATInfo><Vendor><Id>#x1234</Id><Name>Example</Name></Vendor><Descriptions><Devices>
<Device Physics=\"YY\"><Type ProductCode=\"#x10\" RevisionNo=\"#x1\">DIO-2</Type>
<Name LcId=\"1033\">Two inputs</Name><Name LcId=\"1031\">Zwei Eingaenge</Name>
<Profile><Dictionary><DataTypes>
<DataType><Name>BIT2</Name><BitSize>2</BitSize></DataType>
<DataType><Name>Mode</Name><BaseType>USINT</BaseType><BitSize>8</BitSize>
<EnumInfo><Text>Off</Text><Enum>0</Enum></EnumInfo><EnumInfo><Text>On</Text><Enum>1</Enum></EnumInfo></DataType>
</DataTypes><Objects>
<Object><Index>#x2000</Index><Name>Filter</Name><Type>BIT2</Type><BitSize>2</BitSize>
<Flags><Access>rw</Access><PdoMapping>T</PdoMapping></Flags></Object>
<Object><Index>#x2001</Index><Name>Mode
of operation</Name><Type>Mode</Type><BitSize>8</BitSize><Info><DefaultValue>1</DefaultValue></Info>
<Flags><Access>rw</Access></Flags></Object>
</Objects></Dictionary></Profile>
<Sm StartAddress=\"#x1100\" ControlByte=\"#x20\" Enable=\"1\">Inputs</Sm>
<TxPdo Fixed=\"1\" Sm=\"0\"><Index>#x1A00</Index><Name>Inputs</Name>
<Entry><Index>#x6000</Index><SubIndex>1</SubIndex><BitLen>16</BitLen><Name>Level</Name><DataType>UINT</DataType></Entry>
<Entry><Index>0</Index><BitLen>7</BitLen></Entry>
</TxPdo>
</Device></Devices></Descriptions></EtherCATInfo>
";

#[test]
fn eds_of_an_ethercat_slave() {
    let exported = of(&catalog("dio.xml", SLAVE), Flavor::Eds);
    let lines: Vec<String> = exported.notes.iter().map(ToString::to_string).collect();
    insta::assert_snapshot!(lines.join("\n") + "\n\n" + &exported.text.replace('\r', ""));
}

#[test]
fn compact_pdos_stay_compact() {
    let eds =
        "[DeviceInfo]\nNrOfRXPDO=4\nCompactPDO=0x17\n[1000]\nParameterName=Device type\nDataType=7\nAccessType=ro\n";
    let catalog = catalog("compact.eds", eds);
    assert!(catalog.devices[0].object(0x1403).is_some());
    let text = of(&catalog, Flavor::Eds).text;
    assert!(text.contains("NrOfRXPDO=4\r\n") && text.contains("CompactPDO=0x17\r\n") && !text.contains("[1403]"));
}

#[test]
fn modules_keep_their_sections() {
    let eds = "[DeviceInfo]\nProductName=Head\n[SupportedModules]\nNrOfEntries=1\n\
               [M1ModuleInfo]\nProductName=Four inputs\nProductVersion=1\nColor=gray\n\
               [M1Comments]\nLines=1\nLine1=fast\n\
               [M1FixedObjects]\nNrOfEntries=1\n1=0x2100\n\
               [M1Fixed2100]\nParameterName=Filter\nDataType=5\nAccessType=rw\n\
               [M1SubExtends]\nNrOfEntries=1\n1=0x6000\n\
               [M1SubExt6000]\nParameterName=Inputs\nDataType=5\nAccessType=ro\nPDOMapping=1\nCount=0;2\nObjExtend=1\nWire=4\n";
    let compilation = read(Source::new("head.eds", eds.into()), &Options::default());
    let text = of(compilation.catalog.as_ref().expect("a catalog"), Flavor::Eds).text.replace('\r', "");
    let sections = &text[text.find("[M1ModuleInfo]").expect("the module")..];
    assert_eq!(
        sections,
        "[M1ModuleInfo]\nProductName=Four inputs\nProductVersion=1\nColor=gray\n\n\
         [M1Comments]\nLines=1\nLine1=fast\n\n\
         [M1FixedObjects]\nNrOfEntries=1\n1=0x2100\n\n\
         [M1Fixed2100]\nParameterName=Filter\nObjectType=0x7\nDataType=0x0005\nAccessType=rw\nPDOMapping=0\n\n\
         [M1SubExtends]\nNrOfEntries=1\n1=0x6000\n\n\
         [M1SubExt6000]\nParameterName=Inputs\nDataType=0x0005\nAccessType=ro\nPDOMapping=1\nCount=0;2\nObjExtend=1\nWire=4\n"
    );
}

#[test]
fn a_device_without_objects_has_no_eds() {
    let catalog = Catalog { devices: vec![Device::default()], ..Catalog::default() };
    assert_eq!(export(&catalog, &catalog.devices[0], Flavor::Eds), None);
}
