//! What a small description becomes, and how findings look: to be read in review.

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
    let options = Options::default();
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
