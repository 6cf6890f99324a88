//! Reads channel diagnosis, process alarms, user-structure diagnosis and the log book.

use std::fmt::Write;

use super::location::Location;
use super::reader::Reader;
use crate::frontend::xml::Read;
use crate::ir::{Catalog, CodeRow, CodeTable, Type, UnitDiagnosis, UnitDiagnosisField, Value};
use crate::source::Origin;
use crate::syntax::xml::Tag;

/// Names for a list of codes: the attribute that contains the code, and the tables of codes and extended codes, each
/// with its columns.
struct List {
    code: &'static str,
    table: &'static str,
    columns: &'static [&'static str],
    extended: &'static str,
    extended_columns: &'static [&'static str],
}

/// Code list of channel errors. In the table of extended errors, the first column is the error type to which the
/// extended error belongs.
static CHANNEL_DIAGNOSIS: List = List {
    code: "ErrorType",
    table: "channel_diagnosis",
    columns: &["maintenance_alarm_state", "api"],
    extended: "extended_channel_diagnosis",
    extended_columns: &["error_type", "maintenance_alarm_state", "api", "add_value"],
};

/// Code list of process alarms. In the table of extended reasons, the first column is the reason to which the extended
/// reason belongs.
static PROCESS_ALARMS: List = List {
    code: "Reason",
    table: "process_alarms",
    columns: &["maintenance_alarm_state", "api"],
    extended: "extended_process_alarms",
    extended_columns: &["reason", "maintenance_alarm_state", "api", "add_value"],
};

/// Rows for the codes and extended codes of a list.
#[derive(Default)]
struct Rows {
    codes: Vec<CodeRow>,
    extended: Vec<CodeRow>,
}

impl<'a> Reader<'a, '_> {
    /// Reads a `ChannelDiagList` element.
    pub fn channel_diagnosis(&mut self, list: &Tag<'a>, catalog: &mut Catalog) -> Read<()> {
        self.code_list(list, &CHANNEL_DIAGNOSIS, catalog)
    }

    /// Reads a `ChannelProcessAlarmList` element.
    pub fn process_alarms(&mut self, list: &Tag<'a>, catalog: &mut Catalog) -> Read<()> {
        self.code_list(list, &PROCESS_ALARMS, catalog)
    }

    fn code_list(&mut self, parent: &Tag<'a>, list: &'static List, catalog: &mut Catalog) -> Read<()> {
        let origin = self.origin(parent);
        let mut rows = Rows::default();
        while let Some(tag) = self.child(parent)? {
            if is_code(tag.name) {
                self.code(&tag, list, None, &mut rows)?;
            } else {
                self.unknown(&tag)?;
            }
        }
        catalog.code_tables.push(table(list.table, list.columns, rows.codes, origin));
        if !rows.extended.is_empty() {
            catalog.code_tables.push(table(list.extended, list.extended_columns, rows.extended, origin));
        }
        Ok(())
    }

    /// Reads a code and its extended codes. For an extended code, `parent` contains the code and the API number of the
    /// parent element.
    fn code(&mut self, tag: &Tag<'a>, list: &'static List, parent: Option<(i128, u32)>, rows: &mut Rows) -> Read<()> {
        // Some files have the attribute `ErrorType` instead of `Reason`.
        let names = [list.code, "MaintenanceAlarmState", "API", "ErrorType"];
        let [mut given, state, api, other] = self.attributes(tag, names)?;
        if given.is_missing() {
            given = other;
        }
        self.require(tag, &given, list.code, "left out");
        let code = self.unsigned16(&given, "code").map(i128::from);
        let state = Value::Text(if state.is_missing() { "D".into() } else { state.compact() });
        // An extended code belongs to the API of its parent unless it declares another API.
        let api = self.unsigned(&api, u32::MAX, "API number").or(parent.map(|(_, api)| api)).unwrap_or(0);
        let mut row = CodeRow { code: code.unwrap_or_default(), ..CodeRow::default() };
        let mut add_value = String::new();
        while let Some(child) = self.child(tag)? {
            match child.name {
                "Name" => row.name = self.text_reference(&child)?,
                "Help" => row.documentation = self.documentation(&child)?,
                "ExtChannelDiagList" | "ExtChannelProcessAlarmList" => {
                    while let Some(inner) = self.child(&child)? {
                        match code {
                            Some(number) if is_code(inner.name) && parent.is_none() => {
                                self.code(&inner, list, Some((number, api)), rows)?;
                            }
                            _ => self.unknown(&inner)?,
                        }
                    }
                }
                "ExtChannelAddValue" | "ProcessAlarmReasonAddValue" => self.add_values(&child, &mut add_value)?,
                _ => self.unknown(&child)?,
            }
        }
        let api = Value::Int(api.into());
        let (cells, rows) = match parent {
            None => (vec![state, api], &mut rows.codes),
            Some((parent, _)) => {
                (vec![Value::Int(parent), state, api, Value::Text(add_value.into())], &mut rows.extended)
            }
        };
        rows.extend(code.map(|_| CodeRow { cells, ..row }));
        Ok(())
    }

    /// Appends the additional values of a code to `text`, in the form `1 Unsigned16, 2 Float32` (identifier and data
    /// type).
    fn add_values(&mut self, list: &Tag<'a>, text: &mut String) -> Read<()> {
        self.each(list, "DataItem", |reader, tag| {
            let [id, data_type] = reader.attributes(tag, ["Id", "DataType"])?;
            let comma = if text.is_empty() { "" } else { ", " };
            let _ = write!(text, "{comma}{} {}", id.text, data_type.text);
            reader.no_children(tag)
        })
    }

    /// Reads a `LogBookEntryList` element. The code of a row is the complete status, whose last byte is `ErrorCode2`.
    pub fn log_book(&mut self, list: &Tag<'a>, catalog: &mut Catalog) -> Read<()> {
        let origin = self.origin(list);
        let mut rows = Vec::new();
        self.each(list, "LogBookEntryItem", |reader, tag| {
            let [status] = reader.attributes(tag, ["Status"])?;
            reader.require(tag, &status, "Status", "read as 0");
            let status = reader.unsigned(&status, 0xFF_FFFF, "three-byte status").unwrap_or(0);
            reader.log_entries(tag, i128::from(status) << 8, &mut rows)
        })?;
        catalog.code_tables.push(table("log_book", &[], rows, origin));
        Ok(())
    }

    fn log_entries(&mut self, parent: &Tag<'a>, first: i128, rows: &mut Vec<CodeRow>) -> Read<()> {
        while let Some(tag) = self.child(parent)? {
            match tag.name {
                "ErrorCode2Value" => rows.push(self.log_entry(&tag, first, Some(first + 0xFF))?),
                "ErrorCode2List" => self.each(&tag, "ErrorCode2Item", |reader, tag| {
                    let given = reader.attribute(tag, "ErrorCode2")?;
                    reader.require(tag, &given, "ErrorCode2", "read as 0");
                    let code = reader.unsigned(&given, u8::MAX.into(), "one-byte error code").unwrap_or(0);
                    rows.push(reader.log_entry(tag, first + i128::from(code), None)?);
                    Ok(())
                })?,
                _ => self.unknown(&tag)?,
            }
        }
        Ok(())
    }

    fn log_entry(&mut self, tag: &Tag<'a>, code: i128, last: Option<i128>) -> Read<CodeRow> {
        let mut row = CodeRow { code, last, ..CodeRow::default() };
        while let Some(child) = self.child(tag)? {
            match child.name {
                "Name" => row.name = self.text_reference(&child)?,
                "Help" => row.documentation = self.documentation(&child)?,
                _ => self.unknown(&child)?,
            }
        }
        Ok(row)
    }

    /// Reads a `UnitDiagTypeList` element.
    pub fn unit_diagnoses(&mut self, list: &Tag<'a>, catalog: &mut Catalog) -> Read<()> {
        while let Some(tag) = self.child(list)? {
            match tag.name {
                "UnitDiagTypeItem" | "ProfileUnitDiagTypeItem" => {
                    catalog.unit_diagnoses.push(self.unit_diagnosis(&tag)?)
                }
                _ => self.unknown(&tag)?,
            }
        }
        Ok(())
    }

    fn unit_diagnosis(&mut self, parent: &Tag<'a>) -> Read<UnitDiagnosis> {
        let start = self.extensions.len();
        let mut diagnosis = UnitDiagnosis { origin: self.origin(parent), ..UnitDiagnosis::default() };
        let names = ["API", "UserStructureIdentifier"];
        let [api, identifier] = self.attributes(parent, names)?;
        diagnosis.api = self.unsigned(&api, u32::MAX, "API number").unwrap_or(0);
        self.require(parent, &identifier, "UserStructureIdentifier", "read as 0");
        diagnosis.identifier = self.unsigned16(&identifier, "structure identifier").unwrap_or(0);
        while let Some(tag) = self.child(parent)? {
            match tag.name {
                "Name" => diagnosis.name = self.text_reference(&tag)?,
                "Help" => diagnosis.documentation = self.documentation(&tag)?,
                "Ref" => diagnosis.fields.push(self.unit_field(&tag)?),
                _ => self.unknown(&tag)?,
            }
        }
        diagnosis.extensions = self.extensions_since(start);
        Ok(diagnosis)
    }

    fn unit_field(&mut self, tag: &Tag<'a>) -> Read<UnitDiagnosisField> {
        let names =
            ["DataType", "ByteOffset", "BitOffset", "BitLength", "Length", "TextId", "ValueItemTarget", "DefaultValue"];
        let [data_type, byte, bit, bits, length, text, values, default] = self.attributes(tag, names)?;
        let Location { ty, bit_offset, bits, .. } = self.location(tag, &data_type, [&byte, &bit, &bits, &length]);
        let name = self.name(tag, text);
        let default = if default.is_missing() { None } else { self.default_value(&default, ty, bits) };
        let values = match self.named_values(&values, ty) {
            Some(Type::Named(id)) => Some(id),
            _ => {
                self.note("ValueItemTarget", &values);
                None
            }
        };
        self.no_children(tag)?;
        Ok(UnitDiagnosisField { name, names: Default::default(), bit_offset, bits, ty, values, default })
    }
}

fn table(name: &'static str, columns: &[&'static str], rows: Vec<CodeRow>, origin: Origin) -> CodeTable {
    CodeTable {
        name: name.into(),
        columns: columns.iter().map(|&name| name.into()).collect(),
        rows: rows.into(),
        origin,
        ..CodeTable::default()
    }
}

/// Returns whether an element of a list describes a code.
fn is_code(element: &str) -> bool {
    let kind = ["ChannelDiagItem", "ChannelProcessAlarmItem"].iter().find_map(|item| element.strip_suffix(item));
    matches!(kind, Some("" | "SystemDefined" | "Profile" | "Ext" | "ProfileExt"))
}
