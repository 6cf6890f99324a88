//! Creates ESI files of any size.

use std::fmt::Write;

/// The size of a device: the number of records with nine entries each, and the number of single values.
#[derive(Clone, Copy)]
pub struct Shape {
    pub records: usize,
    pub single: usize,
}

/// Shape of a drive. The drive's dictionary has 256 entries.
pub const DRIVE: Shape = Shape { records: 24, single: 40 };

/// Shape of a small device. The device's dictionary has 37 entries.
pub const SMALL: Shape = Shape { records: 3, single: 10 };

/// Returns an ESI with `devices` devices, in the style and proportions of real files.
pub fn esi(devices: usize, shape: Shape) -> String {
    let mut text = String::from(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<EtherCATInfo xmlns:xsi=\"http://www.w3.org/2001/XMLSchema-instance\" \
         Version=\"1.6\">\n  <Vendor>\n    <Id>#x00000001</Id>\n    <Name>Bench</Name>\n  </Vendor>\n  <Descriptions>\n    \
         <Groups>\n      <Group>\n        <Type>Drives</Type>\n        <Name LcId=\"1033\">Drives</Name>\n      </Group>\n    \
         </Groups>\n    <Devices>\n",
    );
    for number in 0..devices {
        device(&mut text, number, shape);
    }
    text += "    </Devices>\n  </Descriptions>\n</EtherCATInfo>\n";
    text
}

/// Returns an ESI with `size` small devices.
pub fn growing(size: usize) -> Vec<u8> {
    esi(size, SMALL).into_bytes()
}

fn device(text: &mut String, number: usize, shape: Shape) {
    let _ = writeln!(
        text,
        "      <Device Physics=\"YY\">\n        <Type ProductCode=\"#x{number:08x}\" RevisionNo=\"#x00010000\">D{number}</Type>\n        \
         <Name LcId=\"1033\">Drive {number} with two encoders</Name>\n        <Name LcId=\"1031\">Antrieb {number}</Name>\n        \
         <GroupType>Drives</GroupType>\n        <Profile>\n          <ProfileNo>402</ProfileNo>\n          <Dictionary>\n            \
         <DataTypes>"
    );
    for (name, bits) in [("BOOL", 1), ("USINT", 8), ("UINT", 16), ("UDINT", 32), ("DINT", 32), ("STRING(16)", 128)] {
        let _ = writeln!(
            text,
            "              <DataType>\n                <Name>{name}</Name>\n                <BitSize>{bits}</BitSize>\n              \
             </DataType>"
        );
    }
    for record in 0..shape.records {
        data_type(text, 0x2000 + record);
    }
    *text += "            </DataTypes>\n            <Objects>\n";
    for single in 0..shape.single {
        object(text, 0x6000 + single);
    }
    for record in 0..shape.records {
        record_object(text, 0x2000 + record);
    }
    *text += "            </Objects>\n          </Dictionary>\n        </Profile>\n";
    process_data(text, shape);
    *text += "      </Device>\n";
}

fn data_type(text: &mut String, index: usize) {
    let _ = writeln!(
        text,
        "              <DataType>\n                <Name>DT{index:04X}</Name>\n                <BitSize>272</BitSize>"
    );
    for sub in 0..=8 {
        let (name, ty, bits) = if sub == 0 { ("SubIndex 000", "USINT", 8) } else { ("Limit of axis", "UDINT", 32) };
        let offset = if sub == 0 { 0 } else { 16 + 32 * (sub - 1) };
        let number = if sub == 0 { String::new() } else { format!(" {sub}") };
        let _ = writeln!(
            text,
            "                <SubItem>\n                  <SubIdx>{sub}</SubIdx>\n                  <Name>{name}{number}</Name>\n                  \
             <Type>{ty}</Type>\n                  <BitSize>{bits}</BitSize>\n                  <BitOffs>{offset}</BitOffs>\n                  \
             <Flags>\n                    <Access>rw</Access>\n                    <Category>o</Category>\n                  \
             </Flags>\n                </SubItem>"
        );
    }
    *text += "              </DataType>\n";
}

fn record_object(text: &mut String, index: usize) {
    let _ = writeln!(
        text,
        "              <Object>\n                <Index>#x{index:04x}</Index>\n                <Name>Parameters of axis {index}</Name>\n                \
         <Type>DT{index:04X}</Type>\n                <BitSize>272</BitSize>\n                <Info>"
    );
    for sub in 0..=8 {
        let (name, data) =
            if sub == 0 { ("SubIndex 000".to_owned(), "08") } else { (format!("Limit of axis {sub}"), "E8030000") };
        let _ = writeln!(
            text,
            "                  <SubItem>\n                    <Name>{name}</Name>\n                    <Info>\n                      \
             <DefaultData>{data}</DefaultData>\n                    </Info>\n                  </SubItem>"
        );
    }
    *text += "                </Info>\n                <Flags>\n                  <Access>rw</Access>\n                </Flags>\n              \
              </Object>\n";
}

fn object(text: &mut String, index: usize) {
    let _ = writeln!(
        text,
        "              <Object>\n                <Index>#x{index:04x}</Index>\n                <Name>Actual value {index}</Name>\n                \
         <Type>UINT</Type>\n                <BitSize>16</BitSize>\n                <Info>\n                  \
         <DefaultValue>{index}</DefaultValue>\n                </Info>\n                <Flags>\n                  \
         <Access>ro</Access>\n                  <Category>m</Category>\n                  <PdoMapping>T</PdoMapping>\n                \
         </Flags>\n              </Object>"
    );
}

/// Writes sync managers and PDOs. Each PDO maps ten single values.
fn process_data(text: &mut String, shape: Shape) {
    for (name, address, control) in
        [("MBoxOut", 0x1000, 0x26), ("MBoxIn", 0x1080, 0x22), ("Outputs", 0x1100, 0x64), ("Inputs", 0x1400, 0x20)]
    {
        let _ = writeln!(
            text,
            "        <Sm DefaultSize=\"128\" StartAddress=\"#x{address:x}\" ControlByte=\"#x{control:x}\" Enable=\"1\">{name}</Sm>"
        );
    }
    for pdo in 0..(shape.single / 10).min(4) {
        let _ = writeln!(
            text,
            "        <TxPdo Fixed=\"1\" Sm=\"3\">\n          <Index>#x1a{pdo:02x}</Index>\n          <Name>Inputs {pdo}</Name>"
        );
        for entry in 0..10 {
            let _ = writeln!(
                text,
                "          <Entry>\n            <Index>#x{:04x}</Index>\n            <SubIndex>0</SubIndex>\n            \
                 <BitLen>16</BitLen>\n            <Name>Actual value {entry}</Name>\n            <DataType>UINT</DataType>\n          \
                 </Entry>",
                0x6000 + pdo * 10 + entry
            );
        }
        *text += "        </TxPdo>\n";
    }
}
