//! Channel diagnosis, process alarms, diagnosis of user structures and the log book.

use std::fmt::Write;

use super::data_type::DataType;
use super::reader::{note, Given, Read, Reader};
use crate::ir::{
    Catalog, CodeRow, CodeTable, CompactString, Documentation, Extensions, Type, UnitDiagnosis, UnitDiagnosisField,
    Value,
};
use crate::syntax::xml::Tag;

/// A list of codes: the attribute that has the code, the tables, and what they are called.
struct List {
    code: &'static str,
    table: &'static str,
    columns: &'static [&'static str],
    extended: &'static str,
    extended_columns: &'static [&'static str],
}

/// Errors of channels; an extended error belongs to the error type in its first cell.
static CHANNEL_DIAGNOSIS: List = List {
    code: "ErrorType",
    table: "channel_diagnosis",
    columns: &["maintenance_alarm_state", "api"],
    extended: "extended_channel_diagnosis",
    extended_columns: &["error_type", "maintenance_alarm_state", "api", "add_value"],
};

/// Reasons of process alarms.
static PROCESS_ALARMS: List = List {
    code: "Reason",
    table: "process_alarms",
    columns: &["maintenance_alarm_state", "api"],
    extended: "extended_process_alarms",
    extended_columns: &["reason", "maintenance_alarm_state", "api", "add_value"],
};

/// The rows of a list, and those of its extended codes.
#[derive(Default)]
struct Rows {
    own: Vec<CodeRow>,
    extended: Vec<CodeRow>,
}

/// One code as it is written.
struct Code<'a> {
    code: Option<i128>,
    state: CompactString,
    api: u32,
    name: CompactString,
    documentation: Option<Box<Documentation>>,
    add_value: String,
    given: Option<Given<'a>>,
}

impl<'a> Reader<'a, '_> {
    /// Reads ChannelDiagList.
    pub fn channel_diagnosis(&mut self, list: &Tag<'a>, catalog: &mut Catalog) -> Read<()> {
        self.code_list(list, &CHANNEL_DIAGNOSIS, catalog)
    }

    /// Reads ChannelProcessAlarmList.
    pub fn process_alarms(&mut self, list: &Tag<'a>, catalog: &mut Catalog) -> Read<()> {
        self.code_list(list, &PROCESS_ALARMS, catalog)
    }

    fn code_list(&mut self, parent: &Tag<'a>, list: &'static List, catalog: &mut Catalog) -> Read<()> {
        let origin = self.cursor.origin(parent);
        let mut rows = Rows::default();
        while let Some(tag) = self.cursor.child(parent)? {
            if is_code(tag.name) {
                self.code(&tag, list, None, &mut rows, &mut catalog.extensions)?;
            } else {
                self.unknown(&tag, &mut catalog.extensions)?;
            }
        }
        let named = |names: &[&str]| names.iter().map(|&name| name.into()).collect();
        let Rows { own, extended } = rows;
        catalog.code_tables.push(CodeTable {
            name: list.table.into(),
            columns: named(list.columns),
            rows: own.into(),
            buses: Vec::new(),
            documentation: None,
            origin,
        });
        if !extended.is_empty() {
            catalog.code_tables.push(CodeTable {
                name: list.extended.into(),
                columns: named(list.extended_columns),
                rows: extended.into(),
                buses: Vec::new(),
                documentation: None,
                origin,
            });
        }
        Ok(())
    }

    /// Reads a code, or an extended code of the code and application process `parent`, and the codes within it.
    fn code(
        &mut self,
        tag: &Tag<'a>,
        list: &'static List,
        parent: Option<(i128, u32)>,
        rows: &mut Rows,
        rest: &mut Extensions,
    ) -> Read<()> {
        // Some files have errors where reasons belong.
        let names = [list.code, "MaintenanceAlarmState", "API", "ErrorType"];
        let [given, state, api, other] = self.fields(tag, &names, rest)?;
        let given = given.or(other);
        let mut code = Code {
            code: self.unsigned16(given.as_ref(), "code").map(i128::from),
            state: state.map_or_else(|| "D".into(), |given| given.text.into()),
            // What is within the error of a profile is that profile's.
            api: self.unsigned(api.as_ref(), u32::MAX, "API number").or(parent.map(|(_, api)| api)).unwrap_or(0),
            name: CompactString::default(),
            documentation: None,
            add_value: String::new(),
            given,
        };
        if code.given.is_none() {
            self.missing(tag, list.code, "left out");
        }
        while let Some(child) = self.cursor.child(tag)? {
            match child.name {
                "Name" => code.name = self.text_reference(&child)?,
                "Help" => code.documentation = self.documentation(&child)?,
                "ExtChannelDiagList" | "ExtChannelProcessAlarmList" => {
                    while let Some(inner) = self.cursor.child(&child)? {
                        match code.code {
                            Some(own) if is_code(inner.name) && parent.is_none() => {
                                self.code(&inner, list, Some((own, code.api)), rows, rest)?;
                            }
                            _ => self.unknown(&inner, rest)?,
                        }
                    }
                }
                "ExtChannelAddValue" | "ProcessAlarmReasonAddValue" => {
                    self.add_values(&child, &mut code.add_value, rest)?;
                }
                _ => self.unknown(&child, rest)?,
            }
        }
        if let Some(row) = code.row(parent.map(|(code, _)| code)) {
            let rows = if parent.is_some() { &mut rows.extended } else { &mut rows.own };
            rows.push(row);
        }
        Ok(())
    }

    /// What comes along with a code, as `1 Unsigned16, 2 Float32`.
    fn add_values(&mut self, list: &Tag<'a>, text: &mut String, rest: &mut Extensions) -> Read<()> {
        while let Some(tag) = self.cursor.child(list)? {
            if tag.name != "DataItem" {
                self.unknown(&tag, rest)?;
                continue;
            }
            let [id, data_type] = self.fields(&tag, &["Id", "DataType"], rest)?;
            let [id, data_type] = [id, data_type].map(|given| given.map_or_else(Default::default, |given| given.text));
            let comma = if text.is_empty() { "" } else { ", " };
            let _ = write!(text, "{comma}{id} {data_type}");
            self.no_children(&tag, rest)?;
        }
        Ok(())
    }

    /// Reads LogBookEntryList: the code of a row is the whole status, ErrorCode2 being its last byte.
    pub fn log_book(&mut self, list: &Tag<'a>, catalog: &mut Catalog) -> Read<()> {
        let origin = self.cursor.origin(list);
        let mut rows = Vec::new();
        while let Some(tag) = self.cursor.child(list)? {
            if tag.name != "LogBookEntryItem" {
                self.unknown(&tag, &mut catalog.extensions)?;
                continue;
            }
            let [status] = self.fields(&tag, &["Status"], &mut catalog.extensions)?;
            if status.is_none() {
                self.missing(&tag, "Status", "taken for 0");
            }
            let status = self.unsigned(status.as_ref(), 0xFF_FFFF, "status of three bytes").unwrap_or(0);
            let first = i128::from(status) << 8;
            while let Some(child) = self.cursor.child(&tag)? {
                match child.name {
                    "ErrorCode2Value" => {
                        let row = self.log_entry(&child, first, Some(first + 0xFF), &mut catalog.extensions)?;
                        rows.push(row);
                    }
                    "ErrorCode2List" => self.log_entries(&child, first, &mut rows, &mut catalog.extensions)?,
                    _ => self.unknown(&child, &mut catalog.extensions)?,
                }
            }
        }
        catalog.code_tables.push(CodeTable {
            name: "log_book".into(),
            columns: Vec::new(),
            rows: rows.into(),
            buses: Vec::new(),
            documentation: None,
            origin,
        });
        Ok(())
    }

    fn log_entries(&mut self, list: &Tag<'a>, first: i128, rows: &mut Vec<CodeRow>, rest: &mut Extensions) -> Read<()> {
        while let Some(tag) = self.cursor.child(list)? {
            if tag.name != "ErrorCode2Item" {
                self.unknown(&tag, rest)?;
                continue;
            }
            let given = self.field(&tag, "ErrorCode2")?;
            if given.is_none() {
                self.missing(&tag, "ErrorCode2", "taken for 0");
            }
            let code = self.unsigned(given.as_ref(), u8::MAX.into(), "error code of one byte").unwrap_or(0);
            let row = self.log_entry(&tag, first + i128::from(code), None, rest)?;
            rows.push(row);
        }
        Ok(())
    }

    fn log_entry(&mut self, tag: &Tag<'a>, code: i128, last: Option<i128>, rest: &mut Extensions) -> Read<CodeRow> {
        let mut row = empty_row(code);
        row.last = last;
        while let Some(child) = self.cursor.child(tag)? {
            match child.name {
                "Name" => row.name = self.text_reference(&child)?,
                "Help" => row.documentation = self.documentation(&child)?,
                _ => self.unknown(&child, rest)?,
            }
        }
        Ok(row)
    }

    /// Reads UnitDiagTypeList.
    pub fn unit_diagnoses(&mut self, list: &Tag<'a>, catalog: &mut Catalog) -> Read<()> {
        while let Some(tag) = self.cursor.child(list)? {
            match tag.name {
                "UnitDiagTypeItem" | "ProfileUnitDiagTypeItem" => {
                    let diagnosis = self.unit_diagnosis(&tag)?;
                    catalog.unit_diagnoses.push(diagnosis);
                }
                _ => self.unknown(&tag, &mut catalog.extensions)?,
            }
        }
        Ok(())
    }

    fn unit_diagnosis(&mut self, parent: &Tag<'a>) -> Read<UnitDiagnosis> {
        let mut diagnosis = UnitDiagnosis { origin: self.cursor.origin(parent), ..UnitDiagnosis::default() };
        let names = ["API", "UserStructureIdentifier"];
        let [api, identifier] = self.fields(parent, &names, &mut diagnosis.extensions)?;
        diagnosis.api = self.unsigned(api.as_ref(), u32::MAX, "API number").unwrap_or(0);
        if identifier.is_none() {
            self.missing(parent, "UserStructureIdentifier", "taken for 0");
        }
        diagnosis.identifier = self.unsigned16(identifier.as_ref(), "structure identifier").unwrap_or(0);
        while let Some(tag) = self.cursor.child(parent)? {
            match tag.name {
                "Name" => diagnosis.name = self.text_reference(&tag)?,
                "Help" => diagnosis.documentation = self.documentation(&tag)?,
                "Ref" => {
                    let field = self.unit_field(&tag, &mut diagnosis.extensions)?;
                    diagnosis.fields.push(field);
                }
                _ => self.unknown(&tag, &mut diagnosis.extensions)?,
            }
        }
        Ok(diagnosis)
    }

    fn unit_field(&mut self, tag: &Tag<'a>, rest: &mut Extensions) -> Read<UnitDiagnosisField> {
        let names =
            ["DataType", "ByteOffset", "BitOffset", "BitLength", "Length", "TextId", "ValueItemTarget", "DefaultValue"];
        let [data_type, byte, bit, bits, length, text, values, default] = self.fields(tag, &names, rest)?;
        let byte = self.unsigned(byte.as_ref(), u32::MAX / 8 - 1, "byte offset").unwrap_or(0);
        let bit = self.unsigned(bit.as_ref(), 7, "offset of a bit in its byte").unwrap_or(0);
        let length = self.unsigned(length.as_ref(), u16::MAX.into(), "length in bytes");
        let (ty, bits, bit) = match self.data_type(tag, data_type.as_ref()) {
            Some(DataType::Bit) => (Type::Boolean, 1, bit),
            Some(DataType::BitArea) => {
                let bits = self.unsigned(bits.as_ref(), 64, "number of bits").unwrap_or(1).max(1);
                (Type::Unsigned(u8::try_from(bits).unwrap_or(64)), bits, bit)
            }
            Some(found) => {
                let (ty, bytes) = found.lower(length, &mut self.types);
                (ty, bytes * 8, 0)
            }
            None => (Type::Opaque(None), length.unwrap_or(0) * 8, 0),
        };
        let name = self.name(tag, text);
        let default = default.and_then(|given| self.default_value(&given, ty, bits));
        let mut field = UnitDiagnosisField {
            name,
            names: Default::default(),
            bit_offset: byte * 8 + bit,
            bits,
            ty,
            values: None,
            default,
        };
        if let Some(target) = values {
            self.unit_values(target, &mut field, rest);
        }
        self.no_children(tag, rest)?;
        Ok(field)
    }

    fn unit_values(&mut self, target: Given<'a>, field: &mut UnitDiagnosisField, rest: &mut Extensions) {
        let base = if field.ty == Type::Boolean { Type::Unsigned(1) } else { field.ty };
        if !matches!(base, Type::Integer(_) | Type::Unsigned(_)) {
            self.bad(&target, "list of values for this type", "kept as an extension attribute");
            return note("ValueItemTarget", Some(&target), rest);
        }
        if let Type::Named(id) = self.types.enumeration(target, base) {
            field.values = Some(id);
        }
    }
}

impl Code<'_> {
    fn row(self, parent_code: Option<i128>) -> Option<CodeRow> {
        let mut row = empty_row(self.code?);
        (row.name, row.documentation) = (self.name, self.documentation);
        let (state, api) = (Value::Text(self.state), Value::Int(self.api.into()));
        row.cells = match parent_code {
            None => vec![state, api],
            Some(parent) => vec![Value::Int(parent), state, api, Value::Text(self.add_value.into())],
        };
        Some(row)
    }
}

fn empty_row(code: i128) -> CodeRow {
    CodeRow {
        printed: CompactString::default(),
        printed_cells: Vec::new(),
        code,
        last: None,
        name: CompactString::default(),
        names: Default::default(),
        availability: None,
        documentation: None,
        cells: Vec::new(),
    }
}

/// Whether an element of a list is a code.
fn is_code(element: &str) -> bool {
    const NAMES: [&str; 10] = [
        "ChannelDiagItem",
        "SystemDefinedChannelDiagItem",
        "ProfileChannelDiagItem",
        "ExtChannelDiagItem",
        "ProfileExtChannelDiagItem",
        "ChannelProcessAlarmItem",
        "SystemDefinedChannelProcessAlarmItem",
        "ProfileChannelProcessAlarmItem",
        "ExtChannelProcessAlarmItem",
        "ProfileExtChannelProcessAlarmItem",
    ];
    NAMES.contains(&element)
}
