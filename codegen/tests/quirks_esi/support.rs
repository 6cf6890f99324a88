//! What the tests of the ESI front end share: whole files around a vector, and short questions to the result.

#![allow(dead_code)]

use lexibus_codegen::compile::{check, Compilation, Options};
use lexibus_codegen::diagnostics::{Diagnostic, Level};
use lexibus_codegen::ir::{Catalog, Device, EtherCatSettings, Extension, Group, Item, Module, Pdo, Value};
use lexibus_codegen::source::Source;

/// A checked file.
pub struct Checked(pub Compilation);

impl Checked {
    pub fn catalog(&self) -> &Catalog {
        self.0.catalog.as_ref().expect("the file is usable")
    }

    pub fn device(&self) -> &Device {
        &self.catalog().devices[0]
    }

    pub fn settings(&self) -> &EtherCatSettings {
        self.device().ethercat.as_ref().expect("an EtherCAT slave")
    }

    pub fn module(&self) -> &Module {
        &self.catalog().modules[0]
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

    /// Sub-index and name of an object's items, in order.
    pub fn subs(&self, index: u16) -> Vec<(u8, &str)> {
        self.group(index).items.iter().map(|item| (item.object().unwrap().1, item.name.as_str())).collect()
    }

    pub fn pdo(&self, index: u16) -> &Pdo {
        let mut pdos = self.device().process_data.pdos.iter();
        pdos.find(|pdo| pdo.mapping_index == index).unwrap_or_else(|| panic!("no PDO 0x{index:04X}"))
    }

    /// `code line:column` of every diagnostic, from top to bottom.
    pub fn found(&self) -> Vec<String> {
        self.0.diagnostics.list().iter().map(|found| self.place(found)).collect()
    }

    /// The only diagnostic with this code.
    pub fn only(&self, code: &str) -> &Diagnostic {
        let found: Vec<_> = self.0.diagnostics.list().iter().filter(|found| found.code.id == code).collect();
        assert_eq!(found.len(), 1, "{code} among {:?}", self.found());
        found[0]
    }

    fn place(&self, found: &Diagnostic) -> String {
        let at = self.0.sources[found.span.file.0 as usize].position(found.span.start);
        format!("{} {}:{}", found.code.id, at.line, at.column)
    }
}

/// Value of the extension attribute `key`.
pub fn value_of<'e>(extensions: &'e [Extension], key: &str) -> Option<&'e str> {
    extensions.iter().find(|extension| extension.key == key).map(|extension| extension.value.as_str())
}

pub fn int(value: i128) -> Option<Value> {
    Some(Value::Int(value))
}

pub const NOTHING: [&str; 0] = [];

/// A whole file with these elements in Descriptions, beside those of a vendor. The vector begins on line 2.
pub fn file(descriptions: &str) -> String {
    format!(
        "<EtherCATInfo><Vendor><Id>#x1</Id><Name>Maker</Name></Vendor><Descriptions>\n{descriptions}\n\
         </Descriptions></EtherCATInfo>"
    )
}

/// A whole file of a device with these elements besides Type and Name. The vector begins on line 3.
pub fn device_file(elements: &str) -> String {
    file(&format!(
        "<Devices><Device Physics='YY'><Type ProductCode='#x2' RevisionNo='#x3'>D1</Type><Name>Drive</Name>\n{elements}\n\
         </Device></Devices>"
    ))
}

/// Checks `text` as it stands, with each kind of line end and with a byte order mark, which all have to say the same.
pub fn read_text(text: &str) -> Checked {
    read_with(text, &[])
}

/// The same with lints that are off by default.
pub fn read_with(text: &str, lints: &[&str]) -> Checked {
    let mut options = Options::default();
    for lint in lints {
        options.levels.set(lint, Level::Warn).unwrap();
    }
    let read = |bytes: Vec<u8>| Checked(check(Source::new("slave.xml", bytes), &options));
    let plain = read(text.as_bytes().to_vec());
    for other in [text.replace('\n', "\r\n"), text.replace('\n', "\r"), format!("\u{feff}{text}")] {
        let other = read(other.into_bytes());
        assert_eq!(other.found(), plain.found(), "other diagnostics");
        let (one, two) = (&plain.0.catalog, &other.0.catalog);
        assert_eq!(one.is_some(), two.is_some());
        if let (Some(one), Some(two)) = (one, two) {
            assert_eq!(one.devices.len(), two.devices.len());
            for (one, two) in one.devices.iter().zip(&two.devices) {
                assert_eq!((&one.name, &one.identity, one.groups.len()), (&two.name, &two.identity, two.groups.len()));
            }
        }
    }
    plain
}

/// Checks a device with these elements; they begin on line 3.
pub fn device(elements: &str) -> Checked {
    read_text(&device_file(elements))
}

/// A Profile with these data types and objects; the types begin on line 3, and the objects on the line behind them.
pub fn profile(types: &str, objects: &str) -> String {
    format!(
        "<Profile><Dictionary><DataTypes>\n{types}</DataTypes><Objects>\n{objects}</Objects></Dictionary></Profile>"
    )
}

/// Checks a device with these data types and objects; the types begin on line 4, and the objects on the line behind them.
pub fn dictionary(types: &str, objects: &str) -> Checked {
    device(&profile(types, objects))
}

pub fn basic(name: &str, bits: u32) -> String {
    format!("<DataType><Name>{name}</Name><BitSize>{bits}</BitSize></DataType>")
}

/// An object that is one value, read-only.
pub fn var(index: &str, ty: &str, info: &str) -> String {
    format!(
        "<Object><Index>{index}</Index><Name>Value</Name><Type>{ty}</Type><Info>{info}</Info>\
         <Flags><Access>ro</Access></Flags></Object>"
    )
}

/// A sub-item of a data type.
pub fn sub_item(sub: u8, name: &str, ty: &str, bits: u32, offset: u32) -> String {
    format!(
        "<SubItem><SubIdx>{sub}</SubIdx><Name>{name}</Name><Type>{ty}</Type><BitSize>{bits}</BitSize>\
         <BitOffs>{offset}</BitOffs><Flags><Access>rw</Access></Flags></SubItem>"
    )
}

/// A PDO.
pub fn tx_pdo(index: &str, entries: &str) -> String {
    format!("<TxPdo Sm='3' Fixed='1'><Index>{index}</Index><Name>Inputs</Name>{entries}</TxPdo>")
}

/// An entry of a PDO.
pub fn entry(index: &str, sub: u8, bits: u32, ty: &str) -> String {
    format!(
        "<Entry><Index>{index}</Index><SubIndex>{sub}</SubIndex><BitLen>{bits}</BitLen><Name>E{sub}</Name>\
         <DataType>{ty}</DataType></Entry>"
    )
}
