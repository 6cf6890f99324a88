//! What the tests of the GSDML front end share: a file without any fault around each vector, and short questions to the
//! result.

#![allow(dead_code)]

use lexibus_codegen::compile::{check, Compilation, Options};
use lexibus_codegen::diagnostics::{Diagnostic, Level};
use lexibus_codegen::ir::{
    Catalog, CodeTable, Device, Group, GroupKind, IoData, Item, PdoEntry, ProfinetSettings, Record, Submodule, TypeDef,
};
use lexibus_codegen::source::Source;

/// Parts of a file that a vector may have.
#[derive(Clone, Debug, Default)]
pub struct Parts<'p> {
    /// Further attributes of the device access point.
    pub device_attributes: &'p str,
    /// Further children of the device access point.
    pub device: &'p str,
    /// What the virtual submodule of the device access point has.
    pub submodule: &'p str,
    /// Items of ModuleList.
    pub modules: &'p str,
    /// Items of SubmoduleList.
    pub submodules: &'p str,
    /// Further lists of the application process.
    pub lists: &'p str,
    /// Further languages.
    pub languages: &'p str,
}

/// Texts that every file has: identifier and text are the same but for the prefix.
const TEXTS: [&str; 10] = ["Device", "Info", "Speed", "Torque", "Ready", "Fault", "Mode", "Off", "On", "Help"];

/// A whole file of `parts` and what they lack, so that nothing but the vector gives rise to a diagnostic.
pub fn file(parts: &Parts<'_>) -> String {
    let texts: String = TEXTS.iter().map(|text| format!("<Text TextId=\"T_{text}\" Value=\"{text}\"/>\n")).collect();
    let list = |name: &str, items: &str| {
        if items.is_empty() {
            String::new()
        } else {
            format!("<{name}>\n{items}</{name}>\n")
        }
    };
    let Parts { device_attributes, device, submodule, lists, languages, .. } = parts;
    let (modules, submodules) = (list("ModuleList", parts.modules), list("SubmoduleList", parts.submodules));
    let submodule = if submodule.is_empty() { "<IOData/>\n" } else { submodule };
    format!(
        "<?xml version=\"1.0\" encoding=\"utf-8\"?>
<ISO15745Profile xmlns=\"http://www.profibus.com/GSDML/2003/11/DeviceProfile\">
<ProfileBody>
<DeviceIdentity VendorID=\"0x0FFF\" DeviceID=\"0x0001\">
<InfoText TextId=\"T_Info\"/>
<VendorName Value=\"Maker\"/>
</DeviceIdentity>
<DeviceFunction><Family MainFamily=\"Drives\" ProductFamily=\"Pumps\"/></DeviceFunction>
<ApplicationProcess>
<DeviceAccessPointList>
<DeviceAccessPointItem ID=\"DAP\" ModuleIdentNumber=\"0x00000001\" PhysicalSlots=\"0..4\" FixedInSlots=\"0\" {device_attributes}>
<ModuleInfo>
<Name TextId=\"T_Device\"/>
<InfoText TextId=\"T_Info\"/>
</ModuleInfo>
{device}<VirtualSubmoduleList>
<VirtualSubmoduleItem ID=\"SUB\" SubmoduleIdentNumber=\"0x00000001\">
{submodule}<ModuleInfo><Name TextId=\"T_Device\"/></ModuleInfo>
</VirtualSubmoduleItem>
</VirtualSubmoduleList>
</DeviceAccessPointItem>
</DeviceAccessPointList>
{modules}{submodules}{lists}<ExternalTextList>
<PrimaryLanguage>
{texts}</PrimaryLanguage>
{languages}</ExternalTextList>
</ApplicationProcess>
</ProfileBody>
</ISO15745Profile>
"
    )
}

/// A checked file.
pub struct Checked {
    pub text: String,
    pub compilation: Compilation,
}

impl Checked {
    pub fn catalog(&self) -> &Catalog {
        self.compilation.catalog.as_ref().expect("the file is usable")
    }

    pub fn device(&self) -> &Device {
        &self.catalog().devices[0]
    }

    pub fn settings(&self) -> &ProfinetSettings {
        self.device().profinet.as_ref().expect("settings")
    }

    /// The submodule with this identifier.
    pub fn submodule(&self, id: &str) -> &Submodule {
        let mut submodules = self.catalog().submodules.iter();
        submodules.find(|submodule| submodule.id == id).unwrap_or_else(|| panic!("no submodule {id}"))
    }

    /// Inputs of the vector's submodule.
    pub fn input(&self) -> &IoData {
        self.submodule("SUB").input.as_ref().expect("inputs")
    }

    /// The fields of the inputs that have a name: name, first bit, number of bits.
    pub fn fields(&self) -> Vec<(&str, u32, u32)> {
        let named = self.input().image.fields.iter().filter(|field| !field.name.is_empty());
        named.map(|field| (field.name.as_str(), field.bit_offset, field.bits)).collect()
    }

    /// The field of the inputs with this name.
    pub fn field(&self, name: &str) -> &PdoEntry {
        let mut fields = self.input().image.fields.iter();
        fields.find(|field| field.name == name).unwrap_or_else(|| panic!("no field {name}"))
    }

    /// The first record of the vector's submodule.
    pub fn group(&self) -> &Group {
        &self.submodule("SUB").records[0]
    }

    pub fn record(&self) -> &Record {
        match &self.group().kind {
            GroupKind::Record(record) => record,
            other => panic!("{other:?} is no record"),
        }
    }

    /// The parameter at this position of the first record.
    pub fn parameter(&self, position: usize) -> &Item {
        &self.group().items[position]
    }

    pub fn table(&self, name: &str) -> &CodeTable {
        let mut tables = self.catalog().code_tables.iter();
        tables.find(|table| table.name == name).unwrap_or_else(|| panic!("no table {name}"))
    }

    pub fn type_def(&self, name: &str) -> &TypeDef {
        let mut types = self.catalog().types.iter();
        types.find(|def| def.name == name).unwrap_or_else(|| panic!("no type {name}"))
    }

    /// The codes of all diagnostics, from top to bottom.
    pub fn codes(&self) -> Vec<&'static str> {
        self.compilation.diagnostics.list().iter().map(|found| found.code.id).collect()
    }

    /// Line and column of every diagnostic with this code.
    pub fn places(&self, code: &str) -> Vec<(u32, u32)> {
        let found = self.compilation.diagnostics.list().iter().filter(|found| found.code.id == code);
        found.map(|found| self.place(found)).collect()
    }

    fn place(&self, diagnostic: &Diagnostic) -> (u32, u32) {
        let place = self.compilation.sources[0].position(diagnostic.span.start);
        (place.line, place.column)
    }

    /// Line and column of `part`, which the file has once, or of what stands behind the `|` in it.
    pub fn place_of(&self, part: &str) -> (u32, u32) {
        let (before, after) = part.split_once('|').unwrap_or(("", part));
        let whole = format!("{before}{after}");
        assert_eq!(self.text.matches(&whole).count(), 1, "{whole}");
        let at = self.text.find(&whole).unwrap() + before.len();
        let line = self.text[..at].matches('\n').count() + 1;
        let start = self.text[..at].rfind('\n').map_or(0, |end| end + 1);
        (u32::try_from(line).unwrap(), u32::try_from(self.text[start..at].chars().count() + 1).unwrap())
    }

    /// Asserts that there is exactly one diagnostic, of this code and at `part` (see [`Checked::place_of`]).
    #[track_caller]
    pub fn assert_only(&self, code: &str, part: &str) -> &Diagnostic {
        assert_eq!(self.codes(), [code]);
        assert_eq!(self.places(code), [self.place_of(part)]);
        &self.compilation.diagnostics.list()[0]
    }

    /// Asserts that there is no diagnostic at all.
    #[track_caller]
    pub fn assert_clean(&self) {
        let all: Vec<String> =
            self.compilation.diagnostics.list().iter().map(|found| self.compilation.one_line(found)).collect();
        assert_eq!(all, [""; 0]);
    }
}

/// The name of a file that is formed as it should be.
pub const NAME: &str = "GSDML-V2.35-Maker-Pump-20200131.xml";

/// Checks `text` as it stands, with every kind of line end, which have to say the same.
pub fn read_as(text: &str, options: &Options) -> Checked {
    let compilation = check(Source::new(NAME, text.as_bytes().to_vec()), options);
    for end in ["\r\n", "\r"] {
        let other = check(Source::new(NAME, text.replace('\n', end).into_bytes()), options);
        assert_eq!(findings(&other), findings(&compilation), "{end:?}: other diagnostics");
        assert_eq!(stripped(&other), stripped(&compilation), "{end:?}: another IR");
    }
    Checked { text: text.to_owned(), compilation }
}

/// Code, line and column of every diagnostic.
fn findings(compilation: &Compilation) -> Vec<(&'static str, u32, u32)> {
    let place = |found: &Diagnostic| compilation.sources[0].position(found.span.start);
    let found = compilation.diagnostics.list().iter();
    found.map(|found| (found.code.id, place(found).line, place(found).column)).collect()
}

/// The IR without places in the file.
pub fn stripped(compilation: &Compilation) -> serde_json::Value {
    let mut value = serde_json::to_value(&compilation.catalog).unwrap();
    strip(&mut value);
    value
}

fn strip(value: &mut serde_json::Value) {
    match value {
        serde_json::Value::Object(fields) => {
            fields.retain(|key, _| !matches!(key.as_str(), "span" | "origin" | "at" | "name_at" | "files"));
            fields.values_mut().for_each(strip);
        }
        serde_json::Value::Array(values) => values.iter_mut().for_each(strip),
        _ => {}
    }
}

/// Checks a file of `parts`.
pub fn read(parts: &Parts<'_>) -> Checked {
    read_as(&file(parts), &Options::default())
}

/// The same with lints that are off by default.
pub fn read_with(parts: &Parts<'_>, lints: &[&str]) -> Checked {
    read_as(&file(parts), &options(lints))
}

/// Options with lints that are off by default.
pub fn options(lints: &[&str]) -> Options {
    let mut options = Options::default();
    for lint in lints {
        options.levels.set(lint, Level::Warn).unwrap();
    }
    options
}

/// Checks a file whose submodule has these inputs.
pub fn inputs(items: &str) -> Checked {
    let submodule = format!("<IOData>\n<Input>\n{items}\n</Input>\n</IOData>\n");
    read(&Parts { submodule: &submodule, ..Parts::default() })
}

/// Checks a file whose submodule has a record of 16 bytes with this content.
pub fn record(content: &str) -> Checked {
    read(&Parts { submodule: &record_list(content), ..Parts::default() })
}

/// A list of one record of 16 bytes.
pub fn record_list(content: &str) -> String {
    format!(
        "<IOData/>\n<RecordDataList>\n<ParameterRecordDataItem Index=\"10\" Length=\"16\">\n<Name TextId=\"T_Mode\"/>\n\
         {content}\n</ParameterRecordDataItem>\n</RecordDataList>\n"
    )
}

/// Checks a file whose record has one parameter with these attributes.
pub fn parameter(attributes: &str) -> Checked {
    record(&format!("<Ref ByteOffset=\"0\" TextId=\"T_Speed\" {attributes}/>"))
}

/// Value of the attribute `key`.
pub fn value_of<'l>(
    list: &'l [(lexibus_codegen::ir::CompactString, lexibus_codegen::ir::CompactString)],
    key: &str,
) -> Option<&'l str> {
    list.iter().find(|(own, _)| own == key).map(|(_, value)| value.as_str())
}

/// Value of the extension attribute `key`.
pub fn extension<'l>(list: &'l [lexibus_codegen::ir::Extension], key: &str) -> Option<&'l str> {
    list.iter().find(|own| own.key == key).map(|own| own.value.as_str())
}
