//! Creates XDD files of any size.

use std::fmt::Write;

/// Returns an XDD with `10 * size` records.
pub fn growing(size: usize) -> Vec<u8> {
    xdd(10 * size).into_bytes()
}

/// Returns an XDD with `records` records. Every second value is a parameter of the application process.
fn xdd(records: usize) -> String {
    let (mut parameters, mut objects) = (String::new(), String::new());
    for number in 0..records {
        record(&mut parameters, &mut objects, 0x2000 + number);
    }
    format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n\
         <ISO15745ProfileContainer xmlns=\"http://www.canopen.org/xml/1.0\">\n<ISO15745Profile>\n<ProfileBody fileName=\"bench.xdd\">\n\
         <DeviceIdentity><vendorName>Bench</vendorName><vendorID>0x1</vendorID><productName>Bench</productName></DeviceIdentity>\n\
         <ApplicationProcess>\n<parameterList>\n{parameters}</parameterList>\n</ApplicationProcess>\n</ProfileBody>\n\
         </ISO15745Profile>\n<ISO15745Profile>\n<ProfileBody>\n<ApplicationLayers>\n<CANopenObjectList>\n{objects}\
         </CANopenObjectList>\n</ApplicationLayers>\n</ProfileBody>\n</ISO15745Profile>\n</ISO15745ProfileContainer>\n"
    )
}

fn record(parameters: &mut String, objects: &mut String, index: usize) {
    let name = format!("Axis parameter set {index}");
    let _ = writeln!(objects, "<CANopenObject index=\"{index:04X}\" name=\"{name}\" objectType=\"9\" subNumber=\"9\">");
    let _ = writeln!(
        objects,
        "<CANopenSubObject subIndex=\"00\" name=\"Highest sub-index supported\" objectType=\"7\" dataType=\"0005\" \
         accessType=\"const\" defaultValue=\"0x08\" PDOmapping=\"no\"/>"
    );
    for sub in 1..=8 {
        let name = format!("Velocity limit {sub}");
        if sub % 2 == 0 {
            let _ = writeln!(
                parameters,
                "<parameter uniqueID=\"P{index:X}_{sub}\" access=\"readWrite\"><label lang=\"en\">{name}</label><DINT/>\
                 <defaultValue value=\"{sub}\"/><allowedValues><range><minValue value=\"-2147483648\"/>\
                 <maxValue value=\"2147483647\"/></range></allowedValues></parameter>"
            );
            let _ = writeln!(
                objects,
                "<CANopenSubObject subIndex=\"{sub:02X}\" name=\"{name}\" objectType=\"7\" \
                 uniqueIDRef=\"P{index:X}_{sub}\" PDOmapping=\"optional\"/>"
            );
        } else {
            let _ = writeln!(
                objects,
                "<CANopenSubObject subIndex=\"{sub:02X}\" name=\"{name}\" objectType=\"7\" dataType=\"0004\" \
                 accessType=\"rw\" lowLimit=\"-2147483648\" highLimit=\"2147483647\" defaultValue=\"{sub}\" \
                 PDOmapping=\"optional\"/>"
            );
        }
    }
    objects.push_str("</CANopenObject>\n");
}
