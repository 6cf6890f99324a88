//! What the tests of the EDS front end share: vectors in every encoding, and short questions to the result.

#![allow(dead_code)]

use std::collections::BTreeSet;

use lexibus_codegen::backend::json;
use lexibus_codegen::compile::{check, Compilation, Options};
use lexibus_codegen::diagnostics::{Diagnostic, Level};
use lexibus_codegen::ir::{Device, Group, Item, Pdo, Value};
use lexibus_codegen::source::Source;
use lexibus_codegen::{Presence, RustOptions};

use crate::compile_support::compile;

/// A checked file.
pub struct Checked(pub Compilation);

impl Checked {
    pub fn device(&self) -> &Device {
        &self.0.catalog.as_ref().expect("the file is usable").devices[0]
    }

    pub fn group(&self, index: u16) -> &Group {
        self.device().object(index).unwrap_or_else(|| panic!("no object 0x{index:04X}"))
    }

    pub fn item(&self, index: u16, sub: u8) -> &Item {
        self.device().entry(index, sub).unwrap_or_else(|| panic!("no entry 0x{index:04X}:{sub}"))
    }

    pub fn default(&self, index: u16, sub: u8) -> Option<Value> {
        self.item(index, sub).default.clone()
    }

    /// The sub-indices of an object, in order.
    pub fn subs(&self, index: u16) -> Vec<u8> {
        self.group(index).items.iter().map(|item| item.object().unwrap().1).collect()
    }

    /// The names of an object's items, in order.
    pub fn names(&self, index: u16) -> Vec<&str> {
        self.group(index).items.iter().map(|item| item.name.as_str()).collect()
    }

    pub fn pdo(&self, mapping: u16) -> &Pdo {
        let mut pdos = self.device().process_data.pdos.iter();
        pdos.find(|pdo| pdo.mapping_index == mapping).unwrap_or_else(|| panic!("no PDO 0x{mapping:04X}"))
    }

    /// The codes of all diagnostics, from top to bottom.
    pub fn codes(&self) -> Vec<&'static str> {
        self.diagnostics().map(|found| found.code.id).collect()
    }

    /// Line and column of every diagnostic with this code.
    pub fn places(&self, code: &str) -> Vec<(u32, u32)> {
        let found = self.diagnostics().filter(|found| found.code.id == code);
        found.map(|found| self.place(found)).collect()
    }

    /// The only diagnostic with this code.
    pub fn only(&self, code: &str) -> &Diagnostic {
        let found: Vec<_> = self.diagnostics().filter(|found| found.code.id == code).collect();
        assert_eq!(found.len(), 1, "{code} among {:?}", self.codes());
        found[0]
    }

    fn diagnostics(&self) -> impl Iterator<Item = &Diagnostic> {
        self.0.diagnostics.list().iter()
    }

    fn place(&self, diagnostic: &Diagnostic) -> (u32, u32) {
        assert_eq!(diagnostic.span.file.0, 0);
        let place = self.0.sources[0].position(diagnostic.span.start);
        (place.line, place.column)
    }

    /// Value of the extension attribute `key` of the device.
    pub fn extension(&self, key: &str) -> Option<&str> {
        value_of(&self.device().extensions, key)
    }

    pub fn rust(&self) -> String {
        self.0.rust(&RustOptions::default()).expect("no errors")
    }

    pub fn info(&self) -> serde_json::Value {
        serde_json::to_value(json::info(&self.0)).unwrap()
    }
}

/// Value of the extension attribute `key`.
pub fn value_of<'e>(extensions: &'e [lexibus_codegen::ir::Extension], key: &str) -> Option<&'e str> {
    extensions.iter().find(|extension| extension.key == key).map(|extension| extension.value.as_str())
}

/// The rest of a file without any fault; each section is left out where a vector has its own.
const REST: [(&str, &str); 9] = [
    ("FileInfo", "FileName=pump.eds\nFileVersion=1\nFileRevision=2\nEDSVersion=4.0\nDescription=A pump"),
    (
        "DeviceInfo",
        "VendorName=Maker\nVendorNumber=1\nProductName=Pump\nProductNumber=2\nRevisionNumber=3\nBaudRate_125=1",
    ),
    ("MandatoryObjects", "SupportedObjects=3\n1=0x1000\n2=0x1001\n3=0x1018"),
    (
        "1000",
        "ParameterName=Device type\nObjectType=0x7\nDataType=0x0007\nAccessType=ro\nDefaultValue=0x0\nPDOMapping=0",
    ),
    ("1001", "ParameterName=Error register\nObjectType=0x7\nDataType=0x0005\nAccessType=ro\nPDOMapping=0"),
    ("1018", "ParameterName=Identity\nObjectType=0x9\nSubNumber=4"),
    ("1018sub0", "ParameterName=Highest sub-index\nObjectType=0x7\nDataType=0x0005\nAccessType=const\nDefaultValue=3"),
    ("1018sub1", "ParameterName=Vendor\nObjectType=0x7\nDataType=0x0007\nAccessType=ro\nDefaultValue=1"),
    ("1018sub2", "ParameterName=Product\nObjectType=0x7\nDataType=0x0007\nAccessType=ro\nDefaultValue=2"),
];

const REVISION: (&str, &str) =
    ("1018sub3", "ParameterName=Revision\nObjectType=0x7\nDataType=0x0007\nAccessType=ro\nDefaultValue=3");

/// A whole file of `vector` and what it lacks, so that nothing but the vector gives rise to a diagnostic. The vector
/// comes first: its first line is the file's.
pub fn file(vector: &str) -> String {
    let names: Vec<String> = vector
        .lines()
        .filter_map(|line| Some(line.trim_start().strip_prefix('[')?.split_once(']')?.0.to_ascii_lowercase()))
        .collect();
    let has = |name: &str| names.iter().any(|own| own.eq_ignore_ascii_case(name));
    let mut text = vector.trim_end_matches('\n').to_owned() + "\n";
    for (name, entries) in REST.iter().chain([&REVISION]).filter(|(name, _)| !has(name)) {
        text += &format!("[{name}]\n{entries}\n");
    }
    let indices: BTreeSet<u16> = names.iter().filter_map(|name| u16::from_str_radix(name.get(..4)?, 16).ok()).collect();
    let manufacturer = |index: &u16| (0x2000..0x6000).contains(index);
    let optional = |index: &u16| *index > 0x1001 && *index != 0x1018 && !manufacturer(index);
    let of = |belongs: &dyn Fn(&u16) -> bool| indices.iter().copied().filter(|index| belongs(index)).collect();
    let lists: [(&str, Vec<u16>); 2] = [("OptionalObjects", of(&optional)), ("ManufacturerObjects", of(&manufacturer))];
    for (name, listed) in lists.iter().filter(|(name, _)| !has(name)) {
        text += &format!("[{name}]\nSupportedObjects={}\n", listed.len());
        for (number, index) in listed.iter().enumerate() {
            text += &format!("{}=0x{index:04X}\n", number + 1);
        }
    }
    text
}

/// Checks `vector` and what it lacks of a whole file.
pub fn read(vector: &str) -> Checked {
    read_as(&file(vector), "pump.eds", &Options::default())
}

/// The same for a DCF.
pub fn read_dcf(vector: &str) -> Checked {
    read_as(&file(vector), "pump.dcf", &Options::default())
}

/// The same with lints that are off by default.
pub fn read_with(vector: &str, lints: &[&str]) -> Checked {
    let mut options = Options::default();
    for lint in lints {
        options.levels.set(lint, Level::Warn).unwrap();
    }
    read_as(&file(vector), "pump.eds", &options)
}

/// Checks `text` as it stands, in every variant of line ends, marks and encodings, which all have to say the same.
pub fn read_as(text: &str, name: &str, options: &Options) -> Checked {
    let plain = check(Source::new(name, text.as_bytes().to_vec()), options);
    let (device, found) = (stripped(&plain), findings(&plain));
    assert!(!plain.diagnostics.list().iter().any(|found| found.code.id == "EDS013"), "UTF-8 is fine");
    for (variant, bytes, is_utf8) in variants(text) {
        let other = check(Source::new(name, bytes), options);
        assert_eq!(stripped(&other), device, "{variant}: another IR");
        assert_eq!(findings(&other), found, "{variant}: other diagnostics");
        let complaints = other.diagnostics.list().iter().filter(|found| found.code.id == "EDS013").count();
        let expected = !is_utf8 && other.catalog.is_some();
        assert_eq!(complaints, usize::from(expected), "{variant}: EDS013");
    }
    compiles(&plain, text);
    Checked(plain)
}

/// What comes out is Rust without a warning, or there is an error that says why nothing does.
fn compiles(checked: &Compilation, text: &str) {
    let options = RustOptions { table: Presence::Always, ..RustOptions::default() };
    match checked.rust(&options) {
        Some(bindings) => compile(text, &bindings).unwrap_or_else(|message| panic!("{message}")),
        None => assert!(checked.diagnostics.has_errors(), "rejected in silence:\n{text}"),
    }
}

/// `text` with every line end, with and without a byte order mark, and in Windows-1252; and whether that is UTF-8.
fn variants(text: &str) -> Vec<(String, Vec<u8>, bool)> {
    let mut variants = Vec::new();
    for (name, end) in [("LF", "\n"), ("CRLF", "\r\n"), ("CR", "\r")] {
        let text = text.replace('\n', end);
        let (cp1252, _, lossy) = encoding_rs::WINDOWS_1252.encode(&text);
        assert!(!lossy, "the vector can't be written in Windows-1252");
        for (encoding, bytes) in [("UTF-8", text.as_bytes()), ("cp1252", &*cp1252)] {
            let is_utf8 = text.is_ascii() || encoding == "UTF-8";
            variants.push((format!("{name} {encoding}"), bytes.to_vec(), is_utf8));
            variants.push((format!("{name} {encoding} BOM"), [b"\xef\xbb\xbf", bytes].concat(), is_utf8));
        }
    }
    variants
}

/// Code, line and column of every diagnostic but that on the encoding.
fn findings(compilation: &Compilation) -> Vec<(&'static str, u32, u32)> {
    let found = compilation.diagnostics.list().iter().filter(|found| found.code.id != "EDS013");
    let place = |found: &Diagnostic| compilation.sources[0].position(found.span.start);
    found.map(|found| (found.code.id, place(found).line, place(found).column)).collect()
}

/// The IR without places in the file.
fn stripped(compilation: &Compilation) -> serde_json::Value {
    let mut value = serde_json::to_value(compilation.catalog.as_ref().map(|catalog| &catalog.devices)).unwrap();
    strip(&mut value);
    value
}

fn strip(value: &mut serde_json::Value) {
    match value {
        serde_json::Value::Object(fields) => {
            fields.retain(|key, _| !matches!(key.as_str(), "span" | "origin" | "at" | "name_at"));
            fields.values_mut().for_each(strip);
        }
        serde_json::Value::Array(values) => values.iter_mut().for_each(strip),
        _ => {}
    }
}

/// A VAR at 0x2000: type, access and whatever lines follow, the first of which is line 6.
pub fn var(ty: u32, more: &str) -> String {
    format!("[2000]\nParameterName=Speed\nObjectType=0x7\nDataType={ty:#06x}\nAccessType=rw\n{more}\n")
}

/// A VAR at 0x2000 with a default, which stands at line 6, column 14.
pub fn with_default(ty: u32, text: &str) -> Checked {
    read(&var(ty, &format!("DefaultValue={text}")))
}

/// Asserts what the default `text` of type `ty` is read as, and with which diagnostics, all of them at its value.
#[track_caller]
pub fn assert_default(ty: u32, text: &str, expected: impl Into<Option<Value>>, codes: &[&str]) {
    let checked = with_default(ty, text);
    assert_eq!(checked.default(0x2000, 0), expected.into(), "{text}");
    assert_eq!(checked.codes(), codes, "{text}");
    for code in codes {
        assert_eq!(checked.places(code), [(6, 14)], "{text}");
    }
}

pub fn raw(text: &str) -> Value {
    Value::Raw(text.into())
}

pub fn text(text: &str) -> Value {
    Value::Text(text.into())
}

pub const BOOLEAN: u32 = 0x01;
pub const I16: u32 = 0x03;
pub const I32: u32 = 0x04;
pub const U8: u32 = 0x05;
pub const U16: u32 = 0x06;
pub const U32: u32 = 0x07;
pub const REAL32: u32 = 0x08;
pub const STRING: u32 = 0x09;
pub const OCTETS: u32 = 0x0A;
pub const TIME: u32 = 0x0C;
pub const DOMAIN: u32 = 0x0F;
pub const I24: u32 = 0x10;
pub const REAL64: u32 = 0x11;
pub const U24: u32 = 0x16;
