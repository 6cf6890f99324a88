//! Tests XDD and XDC files. The files must give the same IR as an EDS of the same device. Real files must be read
//! completely, and no file may cause a panic.

use crate::corpus_support;

use corpus_support::File;
use lexibus_codegen::diagnostics::{Diagnostics, Severity};
use lexibus_codegen::frontend::{eds, xdd};
use lexibus_codegen::ir::{
    Access, Catalog, Category, Device, Fit, GroupKind, Item, Mappable, ObjectCode, Scale, Shape, Storage, Type, TypeId,
    Value,
};
use lexibus_codegen::source::{FileId, Source};

fn read(text: &str) -> (Option<Device>, Diagnostics) {
    let mut diagnostics = Diagnostics::default();
    let source = Source::new("test.xdd", text.as_bytes().to_vec());
    let device = only(xdd::read(&source, FileId(0), &[], &mut diagnostics));
    (device, diagnostics)
}

/// Returns the device of a catalog that has only one device.
fn only(catalog: Option<Catalog>) -> Option<Device> {
    let mut devices = catalog?.devices;
    assert_eq!(devices.len(), 1);
    devices.pop()
}

fn codes(diagnostics: &Diagnostics) -> Vec<&'static str> {
    diagnostics.list().iter().map(|diagnostic| diagnostic.code.id).collect()
}

/// Returns the device of a text. The text must cause no diagnostics.
fn clean(text: &str) -> Device {
    let (device, diagnostics) = read(text);
    assert!(diagnostics.list().is_empty(), "{:#?}", diagnostics.list());
    device.expect("a device")
}

/// Returns an XDD with one device profile and one communication profile.
fn container(device: &str, network: &str) -> String {
    format!(
        r#"<?xml version="1.0" encoding="utf-8"?>
<ISO15745ProfileContainer xmlns="http://www.canopen.org/xml/1.1" xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance">
<ISO15745Profile><ProfileBody xsi:type="ProfileBody_Device_CANopen" fileName="x.xdd">{device}</ProfileBody></ISO15745Profile>
<ISO15745Profile><ProfileBody xsi:type="ProfileBody_CommunicationNetwork_CANopen">{network}</ProfileBody></ISO15745Profile>
</ISO15745ProfileContainer>
"#
    )
}

fn objects(application: &str, objects: &str) -> String {
    container(
        &format!("<ApplicationProcess>{application}</ApplicationProcess>"),
        &format!("<ApplicationLayers><CANopenObjectList>{objects}</CANopenObjectList></ApplicationLayers>"),
    )
}

fn item(device: &Device, index: u16, sub: u8) -> &Item {
    device.entry(index, sub).unwrap_or_else(|| panic!("{index:04X}:{sub}"))
}

const EDS: &str = r"[FileInfo]
FileName=same.dcf
FileVersion=1
EDSVersion=4.0
Description=A thing
CreationTime=09:30AM
CreationDate=12-31-2020
CreatedBy=A. Author
ModificationTime=10:30AM
ModificationDate=01-31-2021
ModifiedBy=B. Author
[DeviceInfo]
VendorName=Example Automation
VendorNumber=0x00000100
ProductName=Thing
ProductNumber=0x00001001
OrderCode=T-1
BaudRate_10=0
BaudRate_125=1
BaudRate_250=1
BaudRate_1000=1
SimpleBootUpMaster=0
SimpleBootUpSlave=1
Granularity=8
DynamicChannelsSupported=0
GroupMessaging=0
NrOfRXPDO=1
NrOfTXPDO=1
LSS_Supported=1
[DummyUsage]
Dummy0001=0
Dummy0005=1
Dummy0006=1
[DeviceComissioning]
NodeID=5
NodeName=left
Baudrate=250
NetNumber=1
NetworkName=line
CANopenManager=0
[MandatoryObjects]
SupportedObjects=3
1=0x1000
2=0x1001
3=0x1018
[OptionalObjects]
SupportedObjects=9
1=0x1003
2=0x1008
3=0x1017
4=0x1400
5=0x1600
6=0x1800
7=0x1A00
8=0x6040
9=0x6041
[ManufacturerObjects]
SupportedObjects=2
1=0x2000
2=0x2001
[1000]
ParameterName=Device type
ObjectType=0x7
DataType=0x0007
AccessType=const
DefaultValue=0x00020192
PDOMapping=0
[1001]
ParameterName=Error register
ObjectType=0x7
DataType=0x0005
AccessType=ro
PDOMapping=1
[1003]
ParameterName=Pre-defined error field
ObjectType=0x8
SubNumber=3
[1003sub0]
ParameterName=Number of errors
DataType=0x0005
AccessType=rw
DefaultValue=0
[1003sub1]
ParameterName=Standard error field 1
DataType=0x0007
AccessType=ro
[1003sub2]
ParameterName=Standard error field 2
DataType=0x0007
AccessType=ro
[1008]
ParameterName=Manufacturer device name
DataType=0x0009
AccessType=const
DefaultValue=Thing & <Co>
[1017]
ParameterName=Producer heartbeat time
DataType=0x0006
AccessType=rw
DefaultValue=0
ParameterValue=100
Denotation=Heartbeat
[1018]
ParameterName=Identity object
ObjectType=0x9
SubNumber=2
[1018sub0]
ParameterName=Highest sub-index supported
DataType=0x0005
AccessType=const
DefaultValue=1
[1018sub1]
ParameterName=Vendor-ID
DataType=0x0007
AccessType=ro
DefaultValue=0x00000100
[1400]
ParameterName=RPDO 1 communication
ObjectType=0x9
SubNumber=3
[1400sub0]
ParameterName=Highest sub-index supported
DataType=0x0005
AccessType=const
DefaultValue=2
[1400sub1]
ParameterName=COB-ID
DataType=0x0007
AccessType=rw
DefaultValue=$NODEID+0x200
[1400sub2]
ParameterName=Transmission type
DataType=0x0005
AccessType=rw
DefaultValue=255
LowLimit=0
HighLimit=0xFF
[1600]
ParameterName=RPDO 1 mapping
ObjectType=0x9
SubNumber=2
[1600sub0]
ParameterName=Number of entries
DataType=0x0005
AccessType=rw
DefaultValue=1
[1600sub1]
ParameterName=Entry 1
DataType=0x0007
AccessType=rw
DefaultValue=0x60400010
[1800]
ParameterName=TPDO 1 communication
ObjectType=0x9
SubNumber=2
[1800sub0]
ParameterName=Highest sub-index supported
DataType=0x0005
AccessType=const
DefaultValue=1
[1800sub1]
ParameterName=COB-ID
DataType=0x0007
AccessType=rw
DefaultValue=$NODEID+0x180
ParameterValue=0x185
[1A00]
ParameterName=TPDO 1 mapping
ObjectType=0x9
SubNumber=2
[1A00sub0]
ParameterName=Number of entries
DataType=0x0005
AccessType=rw
DefaultValue=1
[1A00sub1]
ParameterName=Entry 1
DataType=0x0007
AccessType=rw
DefaultValue=0x60410010
[2000]
ParameterName=Gain
DataType=0x0008
AccessType=rw
DefaultValue=1.5
LowLimit=-2.5
HighLimit=2.5
ObjFlags=0x3
[2001]
ParameterName=Program
ObjectType=0x2
DataType=0x000F
AccessType=wo
[6040]
ParameterName=Controlword
DataType=0x0006
AccessType=rww
PDOMapping=1
[6041]
ParameterName=Statusword
DataType=0x0006
AccessType=ro
PDOMapping=1
";
const XDD_1_0: &str = r#"<?xml version="1.0" encoding="utf-8"?>
<ISO15745ProfileContainer xmlns="http://www.canopen.org/xml/1.0" xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance">
<ISO15745Profile>
<ProfileHeader><ProfileIdentification>CAN Device</ProfileIdentification><ProfileRevision>1</ProfileRevision><ProfileName/>
<ProfileSource/><ProfileClassID>Device</ProfileClassID><ISO15745Reference><ISO15745Part>1</ISO15745Part>
<ISO15745Edition>1</ISO15745Edition><ProfileTechnology>CANopen</ProfileTechnology></ISO15745Reference></ProfileHeader>
<ProfileBody xsi:type="ProfileBody_Device_CANopen" formatName="CANopen" formatVersion="1.0" fileName="same.xdc" fileVersion="1" fileCreator="A. Author"
 fileCreationDate="2020-12-31" fileCreationTime="09:30:00" fileModifiedBy="B. Author" fileModificationDate="2021-01-31"
 fileModificationTime="10:30:00+01:00" supportedLanguages="en">
<DeviceIdentity>
 <vendorName>Example Automation</vendorName><vendorID>0x00000100</vendorID>
 <productName>Thing</productName><productID>0x00001001</productID>
 <productText><description lang="en">A thing</description></productText><orderNumber>T-1</orderNumber>
</DeviceIdentity>
</ProfileBody></ISO15745Profile>
<ISO15745Profile>
<ProfileHeader><ProfileIdentification>CAN CommunicationNetwork</ProfileIdentification><ProfileRevision>1</ProfileRevision><ProfileName/>
<ProfileSource/><ProfileClassID>CommunicationNetwork</ProfileClassID><ISO15745Reference><ISO15745Part>1</ISO15745Part>
<ISO15745Edition>1</ISO15745Edition><ProfileTechnology>CANopen</ProfileTechnology></ISO15745Reference></ProfileHeader>
<ProfileBody xsi:type="ProfileBody_CommunicationNetwork_CANopen" formatName="CANopen" formatVersion="1.0" fileName="same.xdc" fileVersion="1" fileCreator="A. Author"
 fileCreationDate="2020-12-31" fileCreationTime="09:30:00" fileModifiedBy="B. Author" fileModificationDate="2021-01-31"
 fileModificationTime="10:30:00+01:00" supportedLanguages="en">
<ApplicationLayers>
<CANopenObjectList mandatoryObjects="3" optionalObjects="9" manufacturerObjects="2">
<CANopenObject index="1000" name="Device type" objectType="7" dataType="0007" accessType="const" defaultValue="0x00020192" PDOmapping="no"/>
<CANopenObject index="1001" name="Error register" objectType="7" dataType="0005" accessType="ro" PDOmapping="optional"/>
<CANopenObject index="1003" name="Pre-defined error field" objectType="8" subNumber="3">
 <CANopenSubObject subIndex="00" name="Number of errors" objectType="7" dataType="0005" accessType="rw" defaultValue="0"/>
 <CANopenSubObject subIndex="01" name="Standard error field 1" objectType="7" dataType="0007" accessType="ro"/>
 <CANopenSubObject subIndex="02" name="Standard error field 2" objectType="7" dataType="0007" accessType="ro"/>
</CANopenObject>
<CANopenObject index="1008" name="Manufacturer device name" objectType="7" dataType="0009" accessType="const" defaultValue="Thing &amp; &lt;Co>"/>
<CANopenObject index="1017" name="Producer heartbeat time" objectType="7" dataType="0006" accessType="rw" defaultValue="0"
 actualValue="100" denotation="Heartbeat"/>
<CANopenObject index="1018" name="Identity object" objectType="9" subNumber="2">
 <CANopenSubObject subIndex="00" name="Highest sub-index supported" objectType="7" dataType="0005" accessType="const" defaultValue="1"/>
 <CANopenSubObject subIndex="01" name="Vendor-ID" objectType="7" dataType="0007" accessType="ro" defaultValue="0x00000100"/>
</CANopenObject>
<CANopenObject index="1400" name="RPDO 1 communication" objectType="9" subNumber="3">
 <CANopenSubObject subIndex="00" name="Highest sub-index supported" objectType="7" dataType="0005" accessType="const" defaultValue="2"/>
 <CANopenSubObject subIndex="01" name="COB-ID" objectType="7" dataType="0007" accessType="rw" defaultValue="$NODEID+0x200"/>
 <CANopenSubObject subIndex="02" name="Transmission type" objectType="7" dataType="0005" accessType="rw" defaultValue="255"
  lowLimit="0" highLimit="0xFF"/>
</CANopenObject>
<CANopenObject index="1600" name="RPDO 1 mapping" objectType="9" subNumber="2">
 <CANopenSubObject subIndex="00" name="Number of entries" objectType="7" dataType="0005" accessType="rw" defaultValue="1"/>
 <CANopenSubObject subIndex="01" name="Entry 1" objectType="7" dataType="0007" accessType="rw" defaultValue="0x60400010"/>
</CANopenObject>
<CANopenObject index="1800" name="TPDO 1 communication" objectType="9" subNumber="2">
 <CANopenSubObject subIndex="00" name="Highest sub-index supported" objectType="7" dataType="0005" accessType="const" defaultValue="1"/>
 <CANopenSubObject subIndex="01" name="COB-ID" objectType="7" dataType="0007" accessType="rw" defaultValue="$NODEID+0x180"
  actualValue="0x185"/>
</CANopenObject>
<CANopenObject index="1A00" name="TPDO 1 mapping" objectType="9" subNumber="2">
 <CANopenSubObject subIndex="00" name="Number of entries" objectType="7" dataType="0005" accessType="rw" defaultValue="1"/>
 <CANopenSubObject subIndex="01" name="Entry 1" objectType="7" dataType="0007" accessType="rw" defaultValue="0x60410010"/>
</CANopenObject>
<CANopenObject index="6040" name="Controlword" objectType="7" dataType="0006" accessType="rww" PDOmapping="optional"/>
<CANopenObject index="6041" name="Statusword" objectType="7" dataType="0006" accessType="ro" PDOmapping="TPDO"/>
<CANopenObject index="2000" name="Gain" objectType="7" dataType="0008" accessType="rw" defaultValue="1.5" lowLimit="-2.5"
 highLimit="2.5" objFlags="0003"/>
<CANopenObject index="2001" name="Program" objectType="2" dataType="000F" accessType="wo"/>
</CANopenObjectList>
<dummyUsage><dummy entry="Dummy0001=0"/><dummy entry="Dummy0005=1"/><dummy entry="Dummy0006=1"/></dummyUsage>
</ApplicationLayers>
<TransportLayers><PhysicalLayer><baudRate>
 <supportedBaudRate value="125 Kbps"/><supportedBaudRate value="250 Kbps"/><supportedBaudRate value="1000 Kbps"/>
</baudRate></PhysicalLayer></TransportLayers>
<NetworkManagement>
 <CANopenGeneralFeatures groupMessaging="false" dynamicChannels="0" granularity="8" nrOfRxPDO="1" nrOfTxPDO="1"
  bootUpSlave="true" layerSettingServiceSlave="true"/>
 <CANopenMasterFeatures bootUpMaster="false"/>
 <deviceCommissioning nodeID="5" nodeName="left" actualBaudRate="250 Kbps" networkNumber="1" networkName="line"
  CANopenManager="false"/>
</NetworkManagement>
</ProfileBody></ISO15745Profile>
</ISO15745ProfileContainer>
"#;
const XDD_1_1: &str = r#"<?xml version="1.0" encoding="utf-8"?>
<ISO15745ProfileContainer xmlns="http://www.canopen.org/xml/1.1" xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance">
<ISO15745Profile>
<ProfileHeader><ProfileIdentification>CAN Device</ProfileIdentification><ProfileRevision>1</ProfileRevision><ProfileName/>
<ProfileSource/><ProfileClassID>Device</ProfileClassID><ISO15745Reference><ISO15745Part>1</ISO15745Part>
<ISO15745Edition>1</ISO15745Edition><ProfileTechnology>CANopen</ProfileTechnology></ISO15745Reference></ProfileHeader>
<ProfileBody xmlns="" xmlns:q1="http://www.canopen.org/xml/1.1" xsi:type="q1:ProfileBody_Device_CANopen" formatName="CANopen" formatVersion="1.0" fileName="same.xdc" fileVersion="1" fileCreator="A. Author"
 fileCreationDate="2020-12-31" fileCreationTime="09:30:00" fileModifiedBy="B. Author" fileModificationDate="2021-01-31"
 fileModificationTime="10:30:00+01:00" supportedLanguages="en">
<q1:DeviceIdentity>
 <q1:vendorName>Example Automation</q1:vendorName><q1:vendorID>0x00000100</q1:vendorID>
 <q1:productName>Thing</q1:productName><q1:productID>0x00001001</q1:productID>
 <q1:productText><description lang="en">A thing</description></q1:productText><q1:orderNumber>T-1</q1:orderNumber>
</q1:DeviceIdentity>
<q1:ApplicationProcess>
<q1:templateList>
 <q1:parameterTemplate uniqueID="entry" access="readWrite"><label lang="en">Entry 1</label><UDINT/></q1:parameterTemplate>
</q1:templateList>
<q1:parameterList>
 <q1:parameter uniqueID="O1000" access="const"><label lang="en">Device type</label><UDINT/><q1:defaultValue value="0x00020192"/></q1:parameter>
 <q1:parameter uniqueID="O1001"><USINT/></q1:parameter>
 <q1:parameter uniqueID="O1003_0" access="readWrite"><USINT/><q1:defaultValue value="0"/></q1:parameter>
 <q1:parameter uniqueID="O1003_1" access="read"><label lang="en">Standard error field 1</label><UDINT/></q1:parameter>
 <q1:parameter uniqueID="O1003_2" access="read"><label lang="en">Standard error field 2</label><UDINT/></q1:parameter>
 <q1:parameter uniqueID="O1008" access="const"><STRING/><q1:defaultValue value="Thing &#38; &#x3C;Co&gt;"/></q1:parameter>
 <q1:parameter uniqueID="O1017" access="readWrite"><denotation><label lang="en">Heartbeat</label></denotation><UINT/>
  <q1:actualValue value="100"/><q1:defaultValue value="0"/></q1:parameter>
 <q1:parameter uniqueID="one" access="const"><USINT/><q1:defaultValue value="1"/></q1:parameter>
 <q1:parameter uniqueID="O1018_1" access="read"><UDINT/><q1:defaultValue value="0x00000100"/></q1:parameter>
 <q1:parameter uniqueID="O1400_0" access="const"><USINT/><q1:defaultValue value="2"/></q1:parameter>
 <q1:parameter uniqueID="O1400_1" access="readWrite"><UDINT/><q1:defaultValue value="$NODEID+0x200"/></q1:parameter>
 <q1:parameter uniqueID="O1400_2" access="readWrite"><USINT/><q1:defaultValue value="255"/>
  <q1:allowedValues><q1:range><minValue value="0"/><maxValue value="0xFF"/></q1:range></q1:allowedValues></q1:parameter>
 <q1:parameter uniqueID="count" access="readWrite"><USINT/><q1:defaultValue value="1"/></q1:parameter>
 <q1:parameter uniqueID="O1600_1" templateIDRef="entry"><q1:defaultValue value="0x60400010"/></q1:parameter>
 <q1:parameter uniqueID="O1800_1" access="readWrite"><UDINT/><q1:defaultValue value="$NODEID+0x180"/>
  <q1:actualValue value="0x185"/></q1:parameter>
 <q1:parameter uniqueID="O1A00_1" templateIDRef="entry"><q1:defaultValue value="0x60410010"/></q1:parameter>
 <q1:parameter uniqueID="O2000" access="readWrite"><REAL/><q1:defaultValue value="1.5"/>
  <q1:allowedValues><q1:range><minValue value="-2.5"/><maxValue value="2.5"/></q1:range></q1:allowedValues></q1:parameter>
 <q1:parameter uniqueID="O2001" access="write"><BITSTRING/></q1:parameter>
 <q1:parameter uniqueID="O6040" access="readWriteOutput"><UINT/></q1:parameter>
 <q1:parameter uniqueID="O6041" access="read"><UINT/></q1:parameter>
</q1:parameterList>
</q1:ApplicationProcess>
</ProfileBody></ISO15745Profile>
<ISO15745Profile>
<ProfileHeader><ProfileIdentification>CAN CommunicationNetwork</ProfileIdentification><ProfileRevision>1</ProfileRevision><ProfileName/>
<ProfileSource/><ProfileClassID>CommunicationNetwork</ProfileClassID><ISO15745Reference><ISO15745Part>1</ISO15745Part>
<ISO15745Edition>1</ISO15745Edition><ProfileTechnology>CANopen</ProfileTechnology></ISO15745Reference></ProfileHeader>
<ProfileBody xmlns="" xmlns:q2="http://www.canopen.org/xml/1.1" xsi:type="q2:ProfileBody_CommunicationNetwork_CANopen" formatName="CANopen" formatVersion="1.0" fileName="same.xdc" fileVersion="1" fileCreator="A. Author"
 fileCreationDate="2020-12-31" fileCreationTime="09:30:00" fileModifiedBy="B. Author" fileModificationDate="2021-01-31"
 fileModificationTime="10:30:00+01:00" supportedLanguages="en">
<ApplicationLayers>
<q2:CANopenObjectList>
<CANopenObject index="1000" objectType="7" PDOmapping="no" uniqueIDRef="O1000"/>
<CANopenObject index="1001" name="Error register" objectType="7" PDOmapping="optional" uniqueIDRef="O1001"/>
<CANopenObject index="1003" name="Pre-defined error field" objectType="8" subNumber="3">
 <CANopenSubObject subIndex="00" name="Number of errors" objectType="7" uniqueIDRef="O1003_0"/>
 <CANopenSubObject subIndex="01" objectType="7" uniqueIDRef="O1003_1"/>
 <CANopenSubObject subIndex="02" name="" objectType="7" uniqueIDRef="O1003_2"/>
</CANopenObject>
<CANopenObject index="1008" name="Manufacturer device name" objectType="7" uniqueIDRef="O1008"/>
<CANopenObject index="1017" name="Producer heartbeat time" objectType="7" uniqueIDRef="O1017"/>
<CANopenObject index="1018" name="Identity object" objectType="9" subNumber="2">
 <CANopenSubObject subIndex="00" name="Highest sub-index supported" objectType="7" uniqueIDRef="one"/>
 <CANopenSubObject subIndex="01" name="Vendor-ID" objectType="7" uniqueIDRef="O1018_1"/>
</CANopenObject>
<CANopenObject index="1400" name="RPDO 1 communication" objectType="9" subNumber="3">
 <CANopenSubObject subIndex="00" name="Highest sub-index supported" objectType="7" uniqueIDRef="O1400_0"/>
 <CANopenSubObject subIndex="01" name="COB-ID" objectType="7" uniqueIDRef="O1400_1"/>
 <CANopenSubObject subIndex="02" name="Transmission type" objectType="7" uniqueIDRef="O1400_2"/>
</CANopenObject>
<CANopenObject index="1600" name="RPDO 1 mapping" objectType="9" subNumber="2">
 <CANopenSubObject subIndex="00" name="Number of entries" objectType="7" uniqueIDRef="count"/>
 <CANopenSubObject subIndex="01" objectType="7" uniqueIDRef="O1600_1"/>
</CANopenObject>
<CANopenObject index="1800" name="TPDO 1 communication" objectType="9" subNumber="2">
 <CANopenSubObject subIndex="00" name="Highest sub-index supported" objectType="7" uniqueIDRef="one"/>
 <CANopenSubObject subIndex="01" name="COB-ID" objectType="7" uniqueIDRef="O1800_1"/>
</CANopenObject>
<CANopenObject index="1A00" name="TPDO 1 mapping" objectType="9" subNumber="2">
 <CANopenSubObject subIndex="00" name="Number of entries" objectType="7" uniqueIDRef="count"/>
 <CANopenSubObject subIndex="01" objectType="7" uniqueIDRef="O1A00_1"/>
</CANopenObject>
<CANopenObject index="2000" name="Gain" objectType="7" objFlags="0003" uniqueIDRef="O2000"/>
<CANopenObject index="2001" name="Program" objectType="2" uniqueIDRef="O2001"/>
<CANopenObject index="6040" name="Controlword" objectType="7" PDOmapping="RPDO" uniqueIDRef="O6040"/>
<CANopenObject index="6041" name="Statusword" objectType="7" PDOmapping="default" uniqueIDRef="O6041"/>
</q2:CANopenObjectList>
<dummyUsage><dummy entry="Dummy0001=0"/><dummy entry="Dummy0005=1"/><dummy entry="Dummy0006=1"/></dummyUsage>
</ApplicationLayers>
<TransportLayers><PhysicalLayer><baudRate>
 <supportedBaudRate value="125 Kbps"/><supportedBaudRate value="250 Kbps"/><supportedBaudRate value="1000 Kbps"/>
</baudRate></PhysicalLayer></TransportLayers>
<NetworkManagement>
 <CANopenGeneralFeatures groupMessaging="false" dynamicChannels="0" granularity="8" nrOfRxPDO="1" nrOfTxPDO="1"
  bootUpSlave="true" layerSettingServiceSlave="true"/>
 <CANopenMasterFeatures bootUpMaster="false"/>
 <deviceCommissioning nodeID="5" nodeName="left" actualBaudRate="250 Kbps" networkNumber="1" networkName="line"
  CANopenManager="false"/>
</NetworkManagement>
</ProfileBody></ISO15745Profile>
</ISO15745ProfileContainer>
"#;

/// Removes facts that can differ between files of the same device: positions, origins, extensions, and facts of the file itself.
fn comparable(device: &Device) -> serde_json::Value {
    fn clear(value: &mut serde_json::Value) {
        match value {
            serde_json::Value::Object(map) => {
                // Origins differ, because a rule completes the facts of sub-indices that an EDS describes in a compact form.
                for key in ["origin", "origins", "at", "name_at", "span", "extensions"] {
                    map.remove(key);
                }
                map.values_mut().for_each(clear);
            }
            serde_json::Value::Array(list) => list.iter_mut().for_each(clear),
            _ => {}
        }
    }
    let mut value = serde_json::to_value(device).unwrap();
    clear(&mut value);
    let header = value["header"].as_object_mut().unwrap();
    // The removed facts describe the file and not the device. The version of CiA 306, for example, does not apply to
    // CiA 311 files.
    for key in
        ["file_name", "format_version", "creation_date", "creation_time", "modification_date", "modification_time"]
    {
        header.remove(key);
    }
    value
}

#[test]
fn the_same_device_gives_the_same_ir() {
    let mut diagnostics = Diagnostics::default();
    let source = Source::new("same.eds", EDS.as_bytes().to_vec());
    let expected = only(eds::read(&source, FileId(0), &[], &mut diagnostics)).unwrap();
    assert!(diagnostics.list().is_empty(), "{:#?}", diagnostics.list());
    assert_eq!(expected.groups.len(), 14);
    let expected = comparable(&expected);
    for (name, text) in [("1.0", XDD_1_0), ("1.1", XDD_1_1)] {
        let actual = comparable(&clean(text));
        for (key, value) in expected.as_object().unwrap() {
            assert_eq!(
                serde_json::to_string_pretty(value).unwrap(),
                serde_json::to_string_pretty(&actual[key]).unwrap(),
                "{key} of {name}"
            );
        }
        assert_eq!(expected, actual, "{name}");
    }
}

#[test]
fn spans_point_at_attribute_values() {
    let device = clean(XDD_1_0);
    let item = item(&device, 0x6040, 0);
    let at = |span: lexibus_codegen::source::Span| &XDD_1_0[span.range()];
    assert_eq!(at(item.at.name), "Controlword");
    assert_eq!((at(item.at.ty), at(item.at.access), at(item.at.mappable)), ("0006", "rww", "optional"));
    assert!(at(item.origin.span).starts_with("<CANopenObject index=\"6040\""));
    let line = XDD_1_0[..item.origin.span.start as usize].matches('\n').count() + 1;
    assert_eq!(item.origin.line as usize, line);
}

#[test]
fn what_an_object_says_counts_before_its_parameter() {
    let text = objects(
        r#"<parameterList>
             <parameter uniqueID="p" access="read" templateIDRef="t" persistent="true" support="mandatory">
               <label lang="de">Drehzahl</label><label lang="en">Speed</label>
               <description lang="de">die Drehzahl</description><description lang="en">the speed</description>
               <INT/><defaultValue value="7"/>
               <property name="CO_storageGroup" value="RAM"/>
             </parameter>
           </parameterList>
           <templateList>
             <parameterTemplate uniqueID="t" access="readWrite" multiplier="0.5" offset="4">
               <UDINT/><defaultValue value="9"/><actualValue value="11"/>
               <allowedValues templateIDRef="a"/>
               <unit multiplier="0.1" unitURI="urn:rpm"><label lang="en">rpm</label><label lang="de">U/min</label></unit>
             </parameterTemplate>
             <allowedValuesTemplate uniqueID="a">
               <range><minValue value="-10"/><maxValue value="0x10"/><step value="2"/></range>
             </allowedValuesTemplate>
           </templateList>
           <parameterGroupList><parameterGroup uniqueID="g"><label lang="en">Motion</label>
             <parameterRef uniqueIDRef="p"/></parameterGroup></parameterGroupList>"#,
        r#"<CANopenObject index="2000" name="Velocity" objectType="7" accessType="rww" uniqueIDRef="p" rangeSelector="r"/>
           <CANopenObject index="2001" objectType="7" dataType="0007" uniqueIDRef="p" lowLimit="1" PDOmapping="TPDO"/>"#,
    );
    let device = clean(&text);
    let first = item(&device, 0x2000, 0);
    assert_eq!((first.name.as_str(), first.ty, first.access), ("Velocity", Type::Integer(16), Access::ReadWriteOutput));
    assert_eq!((first.default.clone(), first.initial().cloned()), (Some(Value::Int(7)), Some(Value::Int(11))));
    assert_eq!((first.limits.low.clone(), first.limits.high.clone()), (Some(Value::Int(-10)), Some(Value::Int(16))));
    assert_eq!(first.names.iter().map(|name| name.text.as_str()).collect::<Vec<_>>(), ["Drehzahl", "Speed"]);
    let documentation = first.documentation.as_ref().unwrap();
    assert_eq!((&*documentation.text, documentation.translations[0].language.as_str()), ("the speed", "de"));
    let quantity = first.quantity.as_ref().unwrap();
    assert_eq!((quantity.unit.as_str(), quantity.units[0].text.as_str()), ("rpm", "U/min"));
    assert_eq!(quantity.scale, Some(Scale::Linear { factor: 0.05, offset: 0.2 }));
    assert_eq!(quantity.step, Some(Value::Int(2)));
    assert_eq!(first.behavior.as_ref().unwrap().storage, Storage::Immediate);
    let group = device.object(0x2000).unwrap();
    assert!(matches!(group.kind, GroupKind::Object { category: Some(Category::Mandatory), .. }));
    let extensions: Vec<_> = group.extensions.iter().map(|e| (e.key.as_str(), e.value.as_str())).collect();
    assert_eq!(extensions, [("rangeSelector", "r"), ("CO_storageGroup", "RAM"), ("parameterGroup", "Motion")]);
    let second = item(&device, 0x2001, 0);
    assert_eq!((second.name.as_str(), second.ty, second.access), ("Speed", Type::Unsigned(32), Access::ReadOnly));
    assert_eq!((second.limits.low.clone(), second.limits.high.clone()), (Some(Value::Int(1)), None));
    assert_eq!(second.mappable, Mappable { tpdo: true, rpdo: false });
}

#[test]
fn data_types_of_the_application_process() {
    let text = objects(
        r#"<dataTypeList>
             <enum name="Mode" uniqueID="e"><USINT/>
               <enumValue value="1"><label lang="en">On</label></enumValue>
               <enumValue><label lang="en">Auto</label></enumValue></enum>
             <derived name="Name" uniqueID="d"><count uniqueID="c"><defaultValue value="20"/></count><STRING/></derived>
             <array name="List" uniqueID="a"><subrange lowerLimit="1" upperLimit="4"/><dataTypeIDRef uniqueIDRef="e"/></array>
             <struct name="Pair" uniqueID="s">
               <varDeclaration name="low" uniqueID="s1" initialValue="1"><BOOL/></varDeclaration>
               <varDeclaration name="high" uniqueID="s2"><dataTypeIDRef uniqueIDRef="a"/></varDeclaration></struct>
             <derived name="Endless" uniqueID="x"><dataTypeIDRef uniqueIDRef="x"/></derived>
           </dataTypeList>
           <parameterList>
             <parameter uniqueID="mode"><dataTypeIDRef uniqueIDRef="e"/><defaultValue value="2"/></parameter>
             <parameter uniqueID="list" access="readWrite"><dataTypeIDRef uniqueIDRef="a"/></parameter>
             <parameter uniqueID="pair"><dataTypeIDRef uniqueIDRef="s"/></parameter>
             <parameter uniqueID="labeled"><label lang="en">Switch</label><USINT/><allowedValues>
               <value value="0"><label lang="en">Off</label></value><value value="1"><label lang="en">On</label></value>
             </allowedValues></parameter>
             <parameter uniqueID="several"><USINT/><allowedValues><range><minValue value="4"/><maxValue value="6"/></range>
               <value value="1"/></allowedValues></parameter>
           </parameterList>"#,
        r#"<CANopenObject index="2000" name="Mode" objectType="7" dataType="0005" accessType="rw" uniqueIDRef="mode"/>
           <CANopenObject index="2001" name="List" objectType="8" uniqueIDRef="list" subNumber="2">
             <CANopenSubObject subIndex="00" name="n" objectType="7" dataType="0005" accessType="const"/>
             <CANopenSubObject subIndex="01" name="1" objectType="7" defaultValue="1"/></CANopenObject>
           <CANopenObject index="2002" name="Pair" objectType="9" uniqueIDRef="pair" subNumber="2">
             <CANopenSubObject subIndex="01" objectType="7" accessType="ro" uniqueIDRef="s1"/>
             <CANopenSubObject subIndex="02" objectType="7" accessType="ro" uniqueIDRef="s2"/></CANopenObject>
           <CANopenObject index="2003" name="Switch" objectType="7" uniqueIDRef="labeled"/>
           <CANopenObject index="2004" name="Several" objectType="7" uniqueIDRef="several"/>"#,
    );
    let (device, diagnostics) = read(&text);
    assert_eq!(codes(&diagnostics), ["XDD006"], "{:#?}", diagnostics.list());
    let device = device.unwrap();
    let names: Vec<_> = device.types.iter().map(|def| (def.name.as_str(), def.bits)).collect();
    let expected = [
        ("Mode", Some(8)),
        ("Name", None),
        ("List", Some(32)),
        ("Pair", Some(33)),
        ("Endless", None),
        ("Switch", Some(8)),
    ];
    assert_eq!(names, expected);
    let Shape::Enumeration { base, values, .. } = &device.types[0].shape else { panic!("{:?}", device.types[0]) };
    assert_eq!((*base, values[1].name.as_str(), values[1].value), (Type::Unsigned(8), "Auto", 2));
    assert_eq!(device.types[1].shape, Shape::Alias(Type::VisibleString(Some(20))));
    let Shape::Record(fields) = &device.types[3].shape else { panic!("{:?}", device.types[3]) };
    assert_eq!((fields[1].bit_offset, fields[1].sub_index, fields[1].bits), (1, Some(2), 32));
    let mode = Type::Named(TypeId(0));
    assert_eq!((item(&device, 0x2000, 0).ty, item(&device, 0x2000, 0).default.clone()), (mode, Some(Value::Int(2))));
    let element = item(&device, 0x2001, 1);
    assert_eq!((element.ty, element.access, element.default.clone()), (mode, Access::ReadWrite, Some(Value::Int(1))));
    let low = item(&device, 0x2002, 1);
    assert_eq!((low.name.as_str(), low.ty, low.default.clone()), ("low", Type::Boolean, Some(Value::Bool(true))));
    assert_eq!(item(&device, 0x2002, 2).ty, Type::Named(TypeId(2)));
    assert_eq!(item(&device, 0x2003, 0).ty, Type::Named(TypeId(5)));
    assert!(item(&device, 0x2003, 0).limits.is_empty());
    let several = item(&device, 0x2004, 0);
    assert_eq!((several.limits.low.clone(), several.limits.high.clone()), (Some(Value::Int(1)), Some(Value::Int(6))));
    assert_eq!(several.extensions[0].value, "4..6 1");
}

#[test]
fn the_network_profile() {
    let text = container(
        r#"<DeviceIdentity><vendorName>V</vendorName><vendorID>0x00000100</vendorID><productName>P</productName>
             <productID>00001234</productID><orderNumber>O-1</orderNumber><version versionType="HW">2</version>
             <productText><description lang="en">a thing</description></productText></DeviceIdentity>
           <DeviceManager><moduleManagement><moduleInterfaceList>
             <interface uniqueID="i" maxChilds="4" multipleChilds="true"><label lang="en">Bus</label>
               <moduleTypeList><moduleType type="IO"/></moduleTypeList></interface>
           </moduleInterfaceList></moduleManagement></DeviceManager>"#,
        r#"<ApplicationLayers conformanceClass="B"><CANopenObjectList mandatoryObjects="0"/>
             <dummyUsage><dummy entry="Dummy0007=1"/><dummy entry="Dummy0005=1"/><dummy entry="Dummy0001=0"/></dummyUsage>
             <dynamicChannels><dynamicChannel dataType="0005" accessType="readOnly" startIndex="A080" endIndex="A0BF"
               maxNumber="64" addressOffset="0010" bitAlignment="8"/></dynamicChannels></ApplicationLayers>
           <TransportLayers><PhysicalLayer><baudRate defaultValue="250 Kbps"><supportedBaudRate value="250 Kbps"/>
             <supportedBaudRate value="100 Kbps"/><supportedBaudRate value="auto-baudRate"/></baudRate></PhysicalLayer>
           </TransportLayers>
           <NetworkManagement>
             <CANopenGeneralFeatures groupMessaging="true" dynamicChannels="1" selfStartingDevice="false" granularity="8"
               nrOfRxPDO="4" nrOfTxPDO="5" bootUpSlave="1" layerSettingServiceSlave="true"/>
             <CANopenMasterFeatures bootUpMaster="true" flyingMaster="false"/>
             <deviceCommissioning NodeID="5" nodeName="n" actualBaudRate="500 Kbps" networkNumber="2" networkName="net"
               CANopenManager="false"/></NetworkManagement>"#,
    );
    let device = clean(&text);
    assert_eq!((device.name.as_str(), device.identity.order_code.as_str()), ("P", "O-1"));
    assert_eq!((device.identity.vendor_id, device.identity.product_code), (Some(0x100), Some(0x1234)));
    assert_eq!((device.header.file_name.as_str(), device.header.description.as_str()), ("x.xdd", "a thing"));
    let slot = &device.slots[0];
    assert_eq!((slot.number, slot.name.as_str(), slot.instances), (1, "Bus", (0, 4)));
    assert_eq!(slot.fits, [Fit::Name("IO".into())]);
    let canopen = device.canopen.as_deref().unwrap();
    assert_eq!((canopen.bit_rates.as_slice(), canopen.auto_bit_rate), (&[100, 250][..], true));
    assert_eq!((canopen.dummies.as_slice(), canopen.dummies_given), (&[5, 7][..], true));
    assert!(canopen.group_messaging && canopen.boot_up_slave && canopen.boot_up_master && canopen.lss);
    assert_eq!((canopen.granularity, canopen.rx_pdos, canopen.tx_pdos), (Some(8), Some(4), Some(5)));
    let channel = &canopen.dynamic_channels[0];
    assert_eq!((channel.data_type, channel.range.as_str(), channel.offset), (5, "0xA080-0xA0BF", 16));
    assert_eq!((channel.direction.as_str(), channel.max_number), ("readOnly", Some(64)));
    let commissioning = device.commissioning.as_deref().unwrap();
    assert_eq!(
        (commissioning.node_id, commissioning.bit_rate, commissioning.net_number),
        (Some(5), Some(500), Some(2))
    );
    assert_eq!(
        (commissioning.node_name.as_str(), commissioning.network_name.as_str(), commissioning.manager),
        ("n", "net", false)
    );
    for (key, value) in [("version/HW", "2"), ("conformanceClass", "B"), ("flyingMaster", "false")] {
        assert!(device.extensions.iter().any(|e| e.key == key && e.value == value), "{key}: {:#?}", device.extensions);
    }
}

#[test]
fn broken_objects_are_repaired_and_reported() {
    let text = objects(
        r#"<parameterList><parameter uniqueID="p" templateIDRef="none" access="noAccess"><USINT/></parameter>
             <parameter uniqueID="p"><UINT/></parameter></parameterList>"#,
        r#"<CANopenObject index="2001" name="b" objectType="7" dataType="0005" accessType="ro" objFlags="0003"/>
           <CANopenObject index="2000" name="first" objectType="7" dataType="0005" accessType="ro"/>
           <CANopenObject name="nowhere" objectType="7"/><CANopenSubObject subIndex="01"/>
           <CANopenObject index="2000" name="last" objectType="9" subNumber="5">
             <CANopenSubObject subIndex="01" name="x" objectType="7" dataType="0005" accessType="rw" PDOmapping="maybe"/>
             <CANopenSubObject subIndex="01" name="y" objectType="7" dataType="0x0006" accessType="w" defaultValue="65536"/>
             <CANopenSubObject subIndex="zz" name="z"/></CANopenObject>
           <CANopenObject index="2002" name="c" objectType="7" uniqueIDRef="gone"/>
           <CANopenObject index="2003" name="d" objectType="7" uniqueIDRef="p"/>
           <CANopenObject index="2004" name="e" objectType="77" dataType="0099" accessType="ro" lowLimit="x"/>"#,
    );
    let (device, diagnostics) = read(&text);
    let device = device.unwrap();
    let mut found = codes(&diagnostics);
    found.sort_unstable();
    let expected = [
        "EDS025", "EDS033", "EDS034", "EDS035", "EDS036", "EDS046", "EDS067", "XDD004", "XDD004", "XDD006", "XDD006",
        "XDD006", "XDD006", "XDD007", "XDD007", "XDD008", "XDD008", "XDD008",
    ];
    // A limit with an unknown type is kept as text and causes no diagnostic.
    assert_eq!(found, expected, "{:#?}", diagnostics.list());
    assert_eq!(
        device.groups.iter().filter_map(|g| g.index()).collect::<Vec<_>>(),
        [0x2000, 0x2001, 0x2002, 0x2003, 0x2004]
    );
    assert_eq!((device.groups[0].name.as_str(), device.groups[0].items.len()), ("last", 1));
    assert_eq!((item(&device, 0x2000, 1).name.as_str(), item(&device, 0x2000, 1).access), ("y", Access::WriteOnly));
    assert_eq!(item(&device, 0x2001, 0).flags, 3);
    assert_eq!(item(&device, 0x2003, 0).ty, Type::Unsigned(8));
    assert!(!diagnostics.has_errors());
}

#[test]
fn files_of_another_kind_are_told_apart() {
    let error = |text: &str| {
        let (device, diagnostics) = read(text);
        assert!(device.is_none(), "{text}");
        codes(&diagnostics)
    };
    assert_eq!(error("<html/>"), ["XDD003"]);
    assert_eq!(error("<ISO15745ProfileContainer/>"), ["XDD003"]);
    assert_eq!(error(&container("", "").replace("_CANopen", "_EtherCAT")), ["XDD003"]);
    assert_eq!(error(&container("", "").replace("_CANopen", "_Powerlink")), ["XDD002"]);
    assert_eq!(error(&container("", "").replace("_CANopen", "_Powerlink_Modular_Head")), ["XDD002"]);
    assert_eq!(error(""), ["XML001"]);
    assert_eq!(error(&container("<DeviceIdentity>", "")), ["XML001"]);
    assert_eq!(error(&container("", "<ApplicationLayers a=1/>")), ["XML001"]);
    assert_eq!(error(&container("", "").replace("</ISO15745ProfileContainer>", "")), ["XML001"]);
    assert_eq!(error(&format!("{}<x/>", container("", ""))), ["XML001"]);
    assert_eq!(error(&container(&"<x>".repeat(100_000), "")), ["IO003"]);
}

#[test]
fn modular_bodies_and_prefixes_and_a_single_profile() {
    let text = container("", "").replace("_CANopen", "_CANopen_Modular_Head");
    assert!(clean(&text).extensions.iter().any(|e| e.value.ends_with("modular_head")));
    let text = r#"<c:ISO15745Profile xmlns:c="u" xmlns:xsi="v"><c:ProfileBody xsi:type="c:ProfileBody_Device_CANopen">
        <c:DeviceIdentity><c:productName>X</c:productName></c:DeviceIdentity></c:ProfileBody></c:ISO15745Profile>"#;
    assert_eq!(clean(text).name, "X");
    assert_eq!(clean(&text.replace("xsi", "i")).name, "X");
}

#[test]
fn an_unknown_entity_is_kept_as_text() {
    let text = container("<DeviceIdentity><productName>A&nbsp;&amp;&bomb;</productName></DeviceIdentity>", "")
        .replace("<ISO15745ProfileContainer", "<!DOCTYPE x [<!ENTITY bomb 'xxxxxxxxxx'>]>\n<ISO15745ProfileContainer");
    let (device, diagnostics) = read(&text);
    assert_eq!((device.unwrap().name.as_str(), codes(&diagnostics)), ("A&nbsp;&&bomb;", vec!["XML002", "XML002"]));
}

#[test]
fn a_parameter_can_not_be_multiplied_without_end() {
    let long = "x".repeat(20_000);
    let parameter = format!(
        r#"<parameterList><parameter uniqueID="p"><description lang="en">{long}</description><USINT/></parameter></parameterList>"#
    );
    let list: String =
        (0x2000..0x5000).map(|index| format!(r#"<CANopenObject index="{index:04X}" uniqueIDRef="p"/>"#)).collect();
    let (device, diagnostics) = read(&objects(&parameter, &list));
    assert_eq!(device.unwrap().groups.len(), 0x3000);
    assert_eq!(codes(&diagnostics).iter().filter(|&&code| code == "IO003").count(), 1);
}

#[test]
fn what_cia_311_does_not_have_is_kept() {
    let text = objects(
        "",
        r#"<CANopenObject index="2000" name="a" dataType="0005" accessType="ro" tool="x"><note>n</note></CANopenObject>"#,
    );
    let device = clean(&text);
    let extensions: Vec<_> = device.groups[0].extensions.iter().map(|e| (e.key.as_str(), e.value.as_str())).collect();
    assert_eq!(extensions, [("tool", "x"), ("CANopenObject/note", "n")]);
}

/// Returns the XDD, XDC and XPD files of the corpus.
fn corpus_files() -> Vec<(String, Vec<u8>)> {
    let files = corpus_support::files().into_iter().flatten();
    files.filter(File::is_xml).map(|file| (file.name, file.bytes)).collect()
}

#[test]
fn real_files_have_as_many_objects_as_counted() {
    let files = corpus_files();
    let Some(folder) = corpus_support::folder() else { return };
    let oracle: serde_json::Value =
        serde_json::from_slice(&std::fs::read(folder.join("oracle.json")).unwrap()).unwrap();
    for (name, bytes) in files {
        let mut diagnostics = Diagnostics::default();
        let source = Source::new(name.clone(), bytes);
        let device = xdd::read(&source, FileId(0), &[], &mut diagnostics);
        let errors: Vec<_> =
            diagnostics.list().iter().filter(|d| d.severity == Severity::Error).map(|d| d.code.id).collect();
        if oracle[&name]["format"].as_str().unwrap().contains("POWERLINK") {
            assert_eq!((device.is_none(), errors), (true, vec!["XDD002"]), "{name}");
            continue;
        }
        assert!(errors.is_empty(), "{name}: {errors:?}");
        let device = device.unwrap();
        let number = |key: &str| oracle[&name][key].as_str().unwrap().parse::<usize>().unwrap();
        let mut seen = std::collections::BTreeMap::new();
        for diagnostic in diagnostics.list() {
            *seen.entry(diagnostic.code.id).or_insert(0) += 1;
        }
        eprintln!("{name}: {seen:?}");
        let subs: usize = device.devices[0]
            .groups
            .iter()
            .filter(|g| g.object_code().unwrap().has_subs())
            .map(|g| g.items.len())
            .sum();
        assert_eq!((device.devices[0].groups.len(), subs), (number("objects"), number("subobjects")), "{name}");
    }
}

#[test]
fn no_cut_and_no_damage_panics() {
    let mut files = corpus_files();
    files.retain(|(_, bytes)| bytes.len() < 200_000);
    files.push(("1.0".into(), XDD_1_0.as_bytes().to_vec()));
    files.push(("1.1".into(), XDD_1_1.as_bytes().to_vec()));
    let read = |bytes: Vec<u8>| {
        let mut diagnostics = Diagnostics::default();
        let device = xdd::read(&Source::new("x", bytes), FileId(0), &[], &mut diagnostics);
        (device, diagnostics)
    };
    for (name, bytes) in files {
        let is_small = name.starts_with("1.");
        // The time to read a prefix is proportional to its length, so long files are tested with fewer prefixes.
        let step = if is_small { 97 } else { 997 * (1 + bytes.len() / 40_000) };
        let end = bytes.iter().rposition(|byte| !byte.is_ascii_whitespace()).unwrap_or(0);
        for cut in (0..end).step_by(step) {
            let (device, diagnostics) = read(bytes[..cut].to_vec());
            assert!(device.is_none() && diagnostics.has_errors(), "{name} cut at {cut}");
            let errors = codes(&diagnostics);
            let fatal = errors.iter().filter(|&&code| code == "XML001" || code == "XDD002").count();
            assert_eq!(fatal, 1, "{name} cut at {cut}: {errors:?}");
        }
        if !is_small {
            continue;
        }
        for (round, at) in (0..bytes.len()).step_by(7).enumerate() {
            let mut damaged = bytes.clone();
            damaged[at] = *b"<>\"'&/= 9z\xff\0".iter().cycle().nth(round).unwrap();
            read(damaged);
        }
    }
}

/// Compares an XPD and an EDS of a real device. The same tool exported both files.
#[test]
fn a_real_device_gives_the_same_ir() {
    let Some(folder) = corpus_support::folder() else { return };
    let source = |name: &str| Source::new(name, std::fs::read(folder.join(name)).unwrap());
    let mut diagnostics = Diagnostics::default();
    let eds = source("CANopenNode__CANopenNode__DS301_profile.eds");
    let xdd = source("CANopenNode__CANopenNode__DS301_profile.xpd");
    let mut expected = only(eds::read(&eds, FileId(0), &[], &mut diagnostics)).unwrap();
    let mut actual = only(xdd::read(&xdd, FileId(0), &[], &mut diagnostics)).unwrap();
    // The XPD also contains disabled objects.
    let enabled: Vec<_> = expected.groups.iter().map(|group| group.index()).collect();
    actual.groups.retain(|group| enabled.contains(&group.index()));
    assert_eq!((expected.groups.len(), actual.groups.len()), (enabled.len(), enabled.len()));
    for device in [&mut expected, &mut actual] {
        // Only the XPD contains descriptions, and only the EDS contains defaults for the entries of 0x1003.
        for group in &mut device.groups {
            group.documentation = None;
            for item in &mut group.items {
                item.documentation = None;
                if group.kind == device_kind(0x1003) {
                    item.default = None;
                }
            }
        }
    }
    let (expected, actual) = (comparable(&expected), comparable(&actual));
    assert_eq!(expected["canopen"], actual["canopen"]);
    for (expected, actual) in expected["groups"].as_array().unwrap().iter().zip(actual["groups"].as_array().unwrap()) {
        assert_eq!(expected, actual);
    }
    assert_eq!(expected["groups"], actual["groups"]);
}

fn device_kind(index: u16) -> GroupKind {
    GroupKind::Object { index, code: ObjectCode::Array, category: None }
}

#[test]
fn leading_zeros_are_not_octal() {
    let subs: String = (0..10)
        .map(|sub| {
            let access = if sub == 0 { "const" } else { "rw" };
            let default = if sub == 0 { "9" } else { "1" };
            format!(
                "<CANopenSubObject subIndex=\"{sub:02X}\" name=\"s{sub}\" objectType=\"7\" dataType=\"0005\" accessType=\"{access}\" \
                 defaultValue=\"{default}\"/>"
            )
        })
        .collect();
    let object =
        format!("<CANopenObject index=\"2000\" name=\"o\" objectType=\"9\" subNumber=\"010\">{subs}</CANopenObject>");
    let device = clean(&objects("", &object));
    assert_eq!(device.object(0x2000).expect("an object").items.len(), 10);
}
