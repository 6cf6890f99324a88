//! Creates GSDML files of any size.

use std::fmt::Write;

/// Number of parameters per record.
const OF_A_RECORD: usize = 20;

/// Number of records per submodule of a drive.
pub const DRIVE: usize = 25;

const LANGUAGES: [&str; 5] = ["de", "fr", "it", "es", "zh"];

/// The size of a device description.
#[derive(Clone, Copy)]
struct Size {
    submodules: usize,
    /// Number of records per submodule.
    records: usize,
}

impl Size {
    /// Returns the number of parameter texts. In large files, there are fewer texts than parameters, because parameters
    /// share texts.
    fn texts(self) -> usize {
        (self.submodules * self.records * 24 / 5).max(64)
    }

    fn value_items(self) -> usize {
        (self.submodules * self.records * 4 / 25).max(1)
    }
}

/// Returns the description of a drive with `submodules` submodules and `records` records in each of them, in the style
/// and proportions of real files.
pub fn gsdml(submodules: usize, records: usize) -> Vec<u8> {
    let size = Size { submodules, records };
    let mut text = String::from("<?xml version=\"1.0\" encoding=\"utf-8\"?>\n");
    text += "<ISO15745Profile xmlns=\"http://www.profibus.com/GSDML/2003/11/DeviceProfile\">\n  <ProfileBody>\n";
    text += "    <DeviceIdentity VendorID=\"0x0FFF\" DeviceID=\"0x0001\">\n      <InfoText TextId=\"TXT_0\"/>\n";
    text += "      <VendorName Value=\"Bench\"/>\n    </DeviceIdentity>\n    <ApplicationProcess>\n";
    device(&mut text, submodules);
    text += "      <ModuleList>\n";
    for number in 0..submodules {
        module(&mut text, number, size);
    }
    text += "      </ModuleList>\n      <ValueList>\n";
    for number in 0..size.value_items() {
        value_item(&mut text, number);
    }
    text += "      </ValueList>\n      <ExternalTextList>\n";
    texts(&mut text, "PrimaryLanguage", "", size);
    for language in LANGUAGES {
        texts(&mut text, "Language", language, size);
    }
    text += "      </ExternalTextList>\n    </ApplicationProcess>\n  </ProfileBody>\n</ISO15745Profile>\n";
    text.into_bytes()
}

/// Returns a description with `100 * size` parameters.
pub fn growing(size: usize) -> Vec<u8> {
    match size {
        1 => gsdml(1, 5),
        _ => gsdml(size / 5, DRIVE),
    }
}

fn device(text: &mut String, submodules: usize) {
    text.push_str("      <DeviceAccessPointList>\n        <DeviceAccessPointItem ID=\"DAP_1\" ");
    text.push_str(
        "ModuleIdentNumber=\"0x00000001\" PNIO_Version=\"V2.35\" PhysicalSlots=\"0..200\" FixedInSlots=\"0\" ",
    );
    text.push_str("MinDeviceInterval=\"32\" DNS_CompatibleName=\"bench\" ObjectUUID_LocalIndex=\"1\">\n");
    text.push_str(
        "          <ModuleInfo>\n            <Name TextId=\"TXT_1\"/>\n            <InfoText TextId=\"TXT_2\"/>\n",
    );
    text.push_str("          </ModuleInfo>\n          <UseableModules>\n");
    for number in 0..submodules {
        let _ =
            writeln!(text, "            <ModuleItemRef ModuleItemTarget=\"MOD_{number}\" AllowedInSlots=\"1..200\"/>");
    }
    text.push_str("          </UseableModules>\n        </DeviceAccessPointItem>\n      </DeviceAccessPointList>\n");
}

fn module(text: &mut String, number: usize, size: Size) {
    let _ = writeln!(text, "        <ModuleItem ID=\"MOD_{number}\" ModuleIdentNumber=\"0x{:08X}\">", 0x100 + number);
    let _ = writeln!(text, "          <ModuleInfo>\n            <Name TextId=\"TXT_{number}\"/>");
    text.push_str(
        "            <InfoText TextId=\"TXT_2\"/>\n          </ModuleInfo>\n          <VirtualSubmoduleList>\n",
    );
    let _ = write!(text, "            <VirtualSubmoduleItem ID=\"SUB_{number}\" SubmoduleIdentNumber=\"0x00000001\" ");
    text.push_str("API=\"14848\" MayIssueProcessAlarm=\"false\">\n              <IOData>\n");
    for (direction, words) in [("Input", 12), ("Output", 10)] {
        let _ = writeln!(text, "                <{direction} Consistency=\"All items consistency\">");
        for word in 0..words {
            let _ =
                write!(text, "                  <DataItem DataType=\"Unsigned16\" TextId=\"TXT_{}\"", word + number);
            text.push_str(if word == 0 { " UseAsBits=\"true\">\n" } else { "/>\n" });
            if word == 0 {
                for bit in 0..16 {
                    let _ =
                        writeln!(text, "                    <BitDataItem BitOffset=\"{bit}\" TextId=\"TXT_{bit}\"/>");
                }
                text.push_str("                  </DataItem>\n");
            }
        }
        let _ = writeln!(text, "                </{direction}>");
    }
    text.push_str("              </IOData>\n              <RecordDataList>\n");
    for record in 0..size.records {
        parameters(text, number * size.records + record, record, size);
    }
    text.push_str("              </RecordDataList>\n            </VirtualSubmoduleItem>\n");
    text.push_str("          </VirtualSubmoduleList>\n        </ModuleItem>\n");
}

fn parameters(text: &mut String, record: usize, index: usize, size: Size) {
    let length = OF_A_RECORD * 4;
    let _ = writeln!(text, "                <ParameterRecordDataItem Index=\"{index}\" Length=\"{length}\">");
    let _ = writeln!(text, "                  <Name TextId=\"TXT_{}\"/>", record % size.texts());
    for position in 0..OF_A_RECORD {
        let number = record * OF_A_RECORD + position;
        let (name, offset, value) = (number % size.texts(), position * 4, number % size.value_items());
        let _ = write!(text, "                  <Ref ID=\"P{number}\" ByteOffset=\"{offset}\" TextId=\"TXT_{name}\" ");
        let rest = match position % 5 {
            0 => format!(
                "DataType=\"Unsigned8\" DefaultValue=\"1\" AllowedValues=\"0..7\" ValueItemTarget=\"VAL_{value}\""
            ),
            1 => "DataType=\"Integer16\" DefaultValue=\"-100\" AllowedValues=\"-32768..32767\"".to_owned(),
            2 => "DataType=\"Float32\" DefaultValue=\"1.5\" AllowedValues=\"-1000.0..1000.0\"".to_owned(),
            3 => "DataType=\"Bit\" BitOffset=\"3\" DefaultValue=\"0\" AllowedValues=\"0..1\"".to_owned(),
            _ => "DataType=\"Unsigned32\" DefaultValue=\"4000\" AllowedValues=\"0..4000000000\"".to_owned(),
        };
        let _ = writeln!(text, "{rest} Changeable=\"true\" Visible=\"true\"/>");
    }
    text.push_str("                </ParameterRecordDataItem>\n");
}

fn value_item(text: &mut String, number: usize) {
    let _ = writeln!(text, "        <ValueItem ID=\"VAL_{number}\">\n          <Assignments>");
    for value in 0..8 {
        let _ = writeln!(text, "            <Assign TextId=\"TXT_{}\" Content=\"{value}\"/>", number * 8 + value);
    }
    text.push_str("          </Assignments>\n        </ValueItem>\n");
}

fn texts(text: &mut String, element: &str, language: &str, size: Size) {
    let attribute = if language.is_empty() { String::new() } else { format!(" xml:lang=\"{language}\"") };
    let _ = writeln!(text, "        <{element}{attribute}>");
    for number in 0..size.texts() {
        let name = format!("Speed controller: limit {number} of the set-point {language}");
        let _ = writeln!(text, "          <Text TextId=\"TXT_{number}\" Value=\"{name}\"/>");
    }
    let _ = writeln!(text, "        </{element}>");
}
