//! Compares the diagnostics and outputs for small descriptions with saved snapshots, so that a review shows all changes.

use lexibus_codegen::compile::{check, Options};
use lexibus_codegen::diagnostics::render;
use lexibus_codegen::source::Source;

const PUMP: &str = "\
[DeviceInfo]
VendorName=Example
VendorNumber=0x1234
ProductName=Pump
[2000]
ParameterName=Speed
DataType=0x0006
AccessType=rww
PDOMapping=1
HighLimit=3000
[2001]
ParameterName=Limits
ObjectType=0x9
SubNumber=2
[2001sub0]
ParameterName=Highest sub-index
DataType=0x0005
AccessType=ro
DefaultValue=1
[2001sub1]
ParameterName=Node
DataType=0x0007
AccessType=rw
DefaultValue=$NODEID+0x600
[1400]
ParameterName=RPDO 1
ObjectType=0x9
[1400sub1]
ParameterName=COB-ID
DataType=0x0007
AccessType=rw
DefaultValue=$NODEID+0x200
[1600]
ParameterName=Set-points
ObjectType=0x9
[1600sub0]
ParameterName=Number
DataType=0x0005
AccessType=const
DefaultValue=1
[1600sub1]
ParameterName=Entry 1
DataType=0x0007
AccessType=const
DefaultValue=0x20000010
";

#[test]
fn rust_of_a_small_device() {
    // Disable profiles, because other tests cover profiles.
    let options = Options { no_profiles: true, ..Options::default() };
    let text = check(Source::new("pump.eds", PUMP.into()), &options).rust(&options.rust).expect("bindings");
    insta::assert_snapshot!(text);
}

#[test]
fn findings_on_a_terminal() {
    let eds = "[DeviceInfo]\nProductName=\"Valve\"\nNrOfRXPDO=1\n[1600]\nParameterName=Mapping\nObjectType=0x9\nSubNumber=3\n\
               [1600sub0]\nParameterName=n\nDataType=5\nAccessType=rw\nDefaultValue=1\n\
               [1600sub1]\nParameterName=e\nDataType=7\nAccessType=rw\nDefaultValue=0x20000008\n\
               [2000]\nParameterName=Gain\nDataType=0x0003 # int\nAccessType=ro\nDefaultValue=0xFFFF\nPDOMapping=True\n";
    let compilation = check(Source::new("valve.eds", eds.into()), &Options::default());
    let list = compilation.diagnostics.list().iter();
    let rendered: Vec<String> =
        list.map(|finding| render::terminal::render(finding, &compilation.sources, false)).collect();
    insta::assert_snapshot!(rendered.join("\n\n"));
}

const STATION: &str = "\
<EtherCATInfo><Vendor><Id>#x1234</Id><Name>Example</Name></Vendor><Descriptions><Devices>
<Device Physics=\"YY\"><Type ProductCode=\"#x10\" RevisionNo=\"#x1\">DIO-2</Type><Name>Two inputs, two outputs</Name>
<Sm StartAddress=\"#x1000\" ControlByte=\"#x44\" Enable=\"1\">Outputs</Sm>
<Sm StartAddress=\"#x1100\" ControlByte=\"#x20\" Enable=\"1\">Inputs</Sm>
<RxPdo Fixed=\"1\" Sm=\"0\"><Index>#x1600</Index><Name>Outputs</Name>
<Entry><Index>#x7000</Index><SubIndex>1</SubIndex><BitLen>1</BitLen><Name>Output 1</Name><DataType>BOOL</DataType></Entry>
<Entry><Index>0</Index><BitLen>7</BitLen></Entry>
</RxPdo>
<TxPdo Fixed=\"1\" Sm=\"1\"><Index>#x1A00</Index><Name>Inputs</Name>
<Entry><Index>#x6000</Index><SubIndex>1</SubIndex><BitLen>12</BitLen><Name>Level</Name><DataType>UINT</DataType></Entry>
</TxPdo>
</Device></Devices></Descriptions></EtherCATInfo>
";

#[test]
fn rust_of_a_small_slave() {
    // Disable profiles, because other tests cover profiles.
    let options = Options { no_profiles: true, ..Options::default() };
    let text = check(Source::new("dio.xml", STATION.into()), &options).rust(&options.rust).expect("bindings");
    insta::assert_snapshot!(text);
}
