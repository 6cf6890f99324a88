//! Tests the structure of the Rust code for GSDML files, and that the code compiles for files with unusual contents.

use crate::compile_support;
use crate::form_support;

use compile_support::{compile, compile_in};
use form_support::canonical;
use lexibus_codegen::compile::{check, Options};
use lexibus_codegen::source::Source;
use lexibus_codegen::{Presence, RustOptions};

/// Builds a GSDML file with one device access point. The access point has `modules` in its slots 1 to 9. The file also
/// contains additional lists.
struct Gsdml {
    modules: Vec<String>,
    lists: String,
    texts: Vec<(String, String)>,
}

impl Gsdml {
    fn new() -> Self {
        Gsdml { modules: Vec::new(), lists: String::new(), texts: Vec::new() }
    }

    /// Adds a text and returns its identifier.
    fn text(&mut self, text: &str) -> String {
        let id = format!("T{}", self.texts.len());
        self.texts.push((id.clone(), text.to_owned()));
        id
    }

    /// Adds a module with one submodule. The module and the submodule have the given name, and the submodule has the
    /// given content.
    fn module(mut self, name: &str, content: &str) -> Self {
        let (text, number) = (self.text(name), self.modules.len() + 1);
        let info = format!("<ModuleInfo><Name TextId=\"{text}\"/><InfoText TextId=\"Info\"/></ModuleInfo>");
        self.modules.push(format!(
            "<ModuleItem ID=\"M{number}\" ModuleIdentNumber=\"0x{number:08X}\">{info}<VirtualSubmoduleList>\
             <VirtualSubmoduleItem ID=\"S{number}\" SubmoduleIdentNumber=\"0x{:08X}\">{content}{info}\
             </VirtualSubmoduleItem></VirtualSubmoduleList></ModuleItem>\n",
            0x100 + number
        ));
        self
    }

    fn lists(mut self, lists: &str) -> Self {
        self.lists.push_str(lists);
        self
    }

    fn named(mut self, id: &str, text: &str) -> Self {
        self.texts.push((id.to_owned(), text.to_owned()));
        self
    }

    fn xml(mut self, head: &str) -> String {
        let head = self.text(head);
        let info = format!("<ModuleInfo><Name TextId=\"{head}\"/><InfoText TextId=\"{head}\"/></ModuleInfo>");
        let uses: String = (1..=self.modules.len())
            .map(|number| format!("<ModuleItemRef ModuleItemTarget=\"M{number}\" AllowedInSlots=\"1..9\"/>"))
            .collect();
        let escape = |text: &str| text.replace('&', "&amp;").replace('<', "&lt;").replace('"', "&quot;");
        let texts: String = self
            .texts
            .iter()
            .map(|(id, text)| format!("<Text TextId=\"{id}\" Value=\"{}\"/>\n", escape(text)))
            .collect();
        format!(
            "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n\
             <ISO15745Profile xmlns=\"http://www.profibus.com/GSDML/2003/11/DeviceProfile\"><ProfileBody>\n\
             <DeviceIdentity VendorID=\"0x1234\" DeviceID=\"0x5678\"><InfoText TextId=\"{head}\"/>\
             <VendorName Value=\"Example\"/></DeviceIdentity>\n\
             <DeviceFunction><Family MainFamily=\"I/O\" ProductFamily=\"Example\"/></DeviceFunction>\n\
             <ApplicationProcess><DeviceAccessPointList>\n\
             <DeviceAccessPointItem ID=\"DAP\" PNIO_Version=\"V2.35\" PhysicalSlots=\"0..9\" FixedInSlots=\"0\" \
             ModuleIdentNumber=\"0x0000ABCD\" MinDeviceInterval=\"32\" DNS_CompatibleName=\"example\">{info}\
             <IOConfigData MaxInputLength=\"1000\" MaxOutputLength=\"1000\"/><UseableModules>{uses}</UseableModules>\
             </DeviceAccessPointItem></DeviceAccessPointList>\n<ModuleList>{}</ModuleList>\n{}\
             <ExternalTextList><PrimaryLanguage>\n{texts}</PrimaryLanguage></ExternalTextList>\n\
             </ApplicationProcess></ProfileBody></ISO15745Profile>\n",
            self.modules.concat(),
            self.lists
        )
    }
}

fn rust(xml: String, options: &RustOptions) -> String {
    let compilation = check(Source::new("example.gsdml.xml", xml.into()), &Options::default());
    let errors: Vec<String> = compilation.diagnostics.list().iter().map(|found| compilation.one_line(found)).collect();
    compilation.rust(options).unwrap_or_else(|| panic!("no bindings: {errors:#?}"))
}

fn accept(name: &str, text: &str) {
    assert_eq!(canonical(name, text), Ok(()));
    compile(name, text).unwrap_or_else(|message| panic!("{message}\n{text}"));
}

fn valve() -> Gsdml {
    Gsdml::new()
        .module(
            "Valve",
            "<IOData><Input><DataItem DataType=\"Unsigned8\" UseAsBits=\"true\" TextId=\"State\">\
             <BitDataItem BitOffset=\"1\" TextId=\"Open\"/></DataItem></Input>\
             <Output Consistency=\"All items consistency\"><DataItem DataType=\"N2\" TextId=\"Set\"/></Output></IOData>\
             <RecordDataList><ParameterRecordDataItem Index=\"5\" Length=\"3\"><Name TextId=\"Setup\"/>\
             <Const Data=\"0xA5,0x00,0x00\"/>\
             <Ref ID=\"R\" ValueItemTarget=\"Speed\" DataType=\"BitArea\" ByteOffset=\"1\" BitOffset=\"4\" BitLength=\"2\" \
             DefaultValue=\"1\" AllowedValues=\"0..1\" TextId=\"SpeedName\"/>\
             <Ref ID=\"Q\" DataType=\"Unsigned8\" ByteOffset=\"2\" DefaultValue=\"9\" Changeable=\"false\" TextId=\"Kind\"/>\
             </ParameterRecordDataItem></RecordDataList>",
        )
        .lists(
            "<ValueList><ValueItem ID=\"Speed\"><Assignments><Assign TextId=\"Slow\" Content=\"0\"/>\
             <Assign TextId=\"Fast\" Content=\"1\"/></Assignments></ValueItem></ValueList>\
             <ChannelDiagList><ChannelDiagItem ErrorType=\"300\"><Name TextId=\"Stuck\"/><Help TextId=\"Clean\"/>\
             </ChannelDiagItem></ChannelDiagList>",
        )
        .named("Info", "Opens and closes.")
        .named("State", "State")
        .named("Open", "Open")
        .named("Set", "Set-point")
        .named("Setup", "Setup")
        .named("SpeedName", "Speed")
        .named("Kind", "Kind")
        .named("Slow", "Slow")
        .named("Fast", "Fast")
        .named("Stuck", "Stuck")
        .named("Clean", "Clean the valve.")
}

#[test]
fn rust_of_a_small_device() {
    let text = rust(valve().xml("Valve head"), &RustOptions::default());
    insta::assert_snapshot!(text);
    accept("valve", &text);
}

/// Problematic names: keywords, types, names that generated code also uses, repeated names, and empty names.
const NASTY: [&str; 25] = [
    "type",
    "self",
    "Self",
    "crate",
    "rt",
    "values",
    "new",
    "view",
    "clone",
    "u32",
    "Option",
    "Unknown",
    "",
    "\u{65e5}",
    "\"*/ } // {{ \u{202e}x",
    "a\nb",
    "<b>[link](http://x) `code` #h",
    "2nd",
    "set speed",
    "speed",
    "is ready",
    "from here to there",
    "Inputs",
    "a very long name that goes on and on and says nothing, nothing at all, for ever",
    "\u{ab}\u{a6}\u{bb}\u{ac}",
];

fn nasty() -> Gsdml {
    let mut gsdml = Gsdml::new();
    let mut items = String::new();
    let mut refs = String::new();
    let mut assigns = String::new();
    for (number, name) in NASTY.iter().chain(&NASTY[..3]).enumerate() {
        let id = gsdml.text(name);
        items += &format!("<DataItem DataType=\"Unsigned16\" TextId=\"{id}\"/>");
        refs += &format!(
            "<Ref ID=\"R{number}\" ValueItemTarget=\"V\" DataType=\"Unsigned8\" ByteOffset=\"{number}\" DefaultValue=\"3\" \
             AllowedValues=\"1..9\" TextId=\"{id}\" Changeable=\"{}\"/>",
            number % 3 != 0
        );
        assigns += &format!("<Assign TextId=\"{id}\" Content=\"{number}\"/>");
    }
    let names = gsdml.texts.clone();
    for (id, name) in &names {
        let content = format!(
            "<IOData><Input>{items}</Input><Output>{items}</Output></IOData><RecordDataList>\
             <ParameterRecordDataItem Index=\"1\" Length=\"40\"><Name TextId=\"{id}\"/>{refs}</ParameterRecordDataItem>\
             <ParameterRecordDataItem Index=\"2\" Length=\"40\"><Name TextId=\"{id}\"/></ParameterRecordDataItem>\
             </RecordDataList>"
        );
        gsdml = gsdml.module(name, &content);
    }
    let (first, last) = (&names[14].0, &names[16].0);
    gsdml = gsdml.named("Info", "\u{ab}\n\u{a6}\nsecond \u{bb} */ line");
    gsdml.lists(&format!(
        "<ValueList><ValueItem ID=\"V\"><Help TextId=\"{first}\"/><Assignments>{assigns}</Assignments></ValueItem></ValueList>\
         <ChannelDiagList><ChannelDiagItem ErrorType=\"9\"><Name TextId=\"{first}\"/><Help TextId=\"{last}\"/>\
         </ChannelDiagItem></ChannelDiagList>"
    ))
}

#[test]
fn no_name_or_text_breaks_out_of_the_code() {
    let text = rust(nasty().xml("\"; } /* \u{202e} */"), &RustOptions::default());
    accept("nasty names", &text);
    for edition in ["2018", "2024"] {
        compile_in(edition, edition, &text).unwrap_or_else(|message| panic!("{message}"));
    }
}

/// All fixed-length data types of data items.
const TYPES: [&str; 36] = [
    "Integer8",
    "Integer16",
    "Integer32",
    "Integer64",
    "Unsigned8",
    "Unsigned16",
    "Unsigned32",
    "Unsigned64",
    "Float32",
    "Float64",
    "Boolean",
    "Date",
    "TimeOfDay with date indication",
    "TimeOfDay without date indication",
    "TimeDifference with date indication",
    "TimeDifference without date indication",
    "NetworkTime",
    "NetworkTimeDifference",
    "TimeStamp",
    "TimeStampDifference",
    "TimeStampDifferenceShort",
    "Float32+Status8",
    "Unsigned8+Unsigned8",
    "Float32+Unsigned8",
    "Unsigned16_S",
    "Integer16_S",
    "Unsigned8_S",
    "N2",
    "N4",
    "V2",
    "L2",
    "R2",
    "T2",
    "E2",
    "C4",
    "X4",
];

#[test]
fn every_data_type_compiles_in_every_place() {
    let items: String = TYPES.iter().map(|ty| format!("<DataItem DataType=\"{ty}\" TextId=\"X\"/>")).collect();
    let strings = "<DataItem DataType=\"VisibleString\" Length=\"7\" TextId=\"X\"/>\
                   <DataItem DataType=\"OctetString\" Length=\"950\" TextId=\"X\"/>\
                   <DataItem DataType=\"Nonsense\" Length=\"3\" TextId=\"X\"/>";
    let bits =
        "<DataItem DataType=\"Unsigned32\" UseAsBits=\"true\" TextId=\"X\"><BitDataItem BitOffset=\"0\" TextId=\"X\"/>\
                <BitDataItem BitOffset=\"31\" TextId=\"X\"/></DataItem>";
    let mut refs = String::new();
    for (number, ty) in TYPES.iter().enumerate() {
        let offset = number * 16;
        refs += &format!(
            "<Ref ID=\"A{number}\" DataType=\"{ty}\" ByteOffset=\"{offset}\" DefaultValue=\"1\" AllowedValues=\"0..100 120\" \
             TextId=\"X\"/><Ref ID=\"B{number}\" DataType=\"{ty}\" ByteOffset=\"{offset}\" DefaultValue=\"0\" \
             Changeable=\"false\" TextId=\"X\"/>"
        );
    }
    for bits in 1..=15 {
        refs += &format!(
            "<Ref ID=\"C{bits}\" DataType=\"BitArea\" ByteOffset=\"{}\" BitOffset=\"{}\" BitLength=\"{bits}\" \
             DefaultValue=\"1\" TextId=\"X\"/>",
            600 + 4 * bits,
            bits % 8
        );
    }
    refs += "<Ref ID=\"D\" DataType=\"Bit\" ByteOffset=\"590\" BitOffset=\"7\" DefaultValue=\"1\" AllowedValues=\"1\" TextId=\"X\"/>\
             <Ref ID=\"E\" DataType=\"VisibleString\" Length=\"9\" ByteOffset=\"700\" DefaultValue=\"far too long\" TextId=\"X\"/>\
             <Ref ID=\"F\" DataType=\"Float64\" ByteOffset=\"720\" DefaultValue=\"3.14159\" AllowedValues=\"2.718281828..1e300\" \
             TextId=\"X\"/><Ref ID=\"G\" DataType=\"Unsigned32\" ByteOffset=\"799\" DefaultValue=\"0\" TextId=\"X\"/>";
    let content = format!(
        "<IOData IOPS_Length=\"2\"><Input>{items}{strings}{bits}</Input><Output>{items}{strings}{bits}</Output></IOData>\
         <RecordDataList><ParameterRecordDataItem Index=\"1\" Length=\"800\"><Name TextId=\"X\"/>{refs}\
         </ParameterRecordDataItem></RecordDataList>"
    );
    let text = rust(
        Gsdml::new().named("Info", "").named("X", "Value").module("Types", &content).xml("Types"),
        &RustOptions::default(),
    );
    accept("types", &text);
    assert!(text.contains("1 parameters are left out because they are not within the bytes of the record."), "{text}");
    assert!(text.contains("const STATUS_LEN: usize = 2;"));
}

#[test]
fn lengths_out_of_all_proportion_cost_nothing() {
    let content = "<IOData><Input><DataItem DataType=\"OctetString\" Length=\"65535\" TextId=\"X\"/>\
                   <DataItem DataType=\"Unsigned8\" TextId=\"X\"/></Input></IOData><RecordDataList>\
                   <ParameterRecordDataItem Index=\"1\" Length=\"4294967295\"><Name TextId=\"X\"/>\
                   <Const ByteOffset=\"4294967295\" Data=\"0x01\"/>\
                   <Ref ID=\"R\" DataType=\"Unsigned64\" ByteOffset=\"536870910\" DefaultValue=\"0\" TextId=\"X\"/>\
                   </ParameterRecordDataItem>\
                   <ParameterRecordDataItem Index=\"2\" Length=\"0\"><Name TextId=\"X\"/></ParameterRecordDataItem>\
                   </RecordDataList>";
    let text = rust(
        Gsdml::new().named("Info", "").named("X", "X").module("Huge", content).xml("Huge"),
        &RustOptions::default(),
    );
    assert!(text.len() < 10_000, "{text}");
    assert!(text.contains("2 records are left out because their length is 0 or exceeds 65,535 bytes."), "{text}");
    accept("huge", &text);
}

#[test]
fn what_nothing_refers_to_costs_nothing() {
    let mut gsdml = valve();
    let text = gsdml.text("Orphan");
    let info = format!("<ModuleInfo><Name TextId=\"{text}\"/><InfoText TextId=\"{text}\"/></ModuleInfo>");
    let xml = gsdml.xml("Head").replace(
        "<ModuleList>",
        &format!("<ModuleList><ModuleItem ID=\"O\" ModuleIdentNumber=\"0x99\">{info}</ModuleItem>"),
    );
    let xml = xml.replace(
        "<ValueList>",
        "<ValueList><ValueItem ID=\"Unused\"><Assignments><Assign TextId=\"Slow\" Content=\"0\"/></Assignments></ValueItem>",
    );
    let text = rust(xml, &RustOptions::default());
    assert!(!text.contains("Orphan") && !text.contains("Unused"), "{text}");
}

#[test]
fn user_structures_need_no_enumeration() {
    let mut gsdml = Gsdml::new();
    let text = gsdml.text("Report");
    let structure = format!(
        "<UnitDiagTypeList><UnitDiagTypeItem UserStructureIdentifier=\"5\"><Name TextId=\"{text}\"/>\
         <Ref DataType=\"Unsigned8\" ByteOffset=\"0\" TextId=\"{text}\"/></UnitDiagTypeItem></UnitDiagTypeList>"
    );
    let text = rust(gsdml.lists(&structure).xml("Unit"), &RustOptions::default());
    assert!(text.contains("pub struct ReportDiagnosis"), "{text}");
    accept("unit_diagnosis", &text);
}

#[test]
fn optional_implementations_are_gated() {
    let options = RustOptions {
        debug: Presence::Never,
        partial_eq: Presence::Feature("eq".into()),
        serde: Presence::Feature("serde".into()),
        ..RustOptions::default()
    };
    let content = "<IOData><Input><DataItem DataType=\"OctetString\" Length=\"33\" TextId=\"Set\"/></Input></IOData>";
    let text = rust(valve().module("Octets", content).xml("Gated"), &options);
    assert!(
        text.contains("#[derive(Clone, Copy)]\n        #[cfg_attr(feature = \"eq\", derive(PartialEq))]"),
        "{text}"
    );
    assert!(text.contains("#[cfg_attr(feature = \"serde\", derive(serde::Serialize, serde::Deserialize))]"));
    assert!(text.contains("serde(with = \"::lexibus::octets\")"), "{text}");
    assert!(!text.contains("Debug"));
    assert_eq!(canonical("example", &text), Ok(()));
    // Suppress the rustc warning about features that the crate does not declare.
    compile("gated", &format!("#[allow(unexpected_cfgs)]\nmod inner {{\n{text}\n}}\npub use inner::*;\n"))
        .expect("it compiles");
}
