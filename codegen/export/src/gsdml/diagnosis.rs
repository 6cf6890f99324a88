//! Writes channel diagnosis, process alarms, user-defined diagnosis structures and the log book.

use std::collections::HashMap;

use super::types;
use super::Context;
use crate::note::{NoteKind, Subject};
use crate::xml::Xml;
use lexibus_codegen::ir::{Catalog, CodeRow, UnitDiagnosis, UnitDiagnosisField, Value};

/// Names of the elements and attributes of a diagnosis list.
struct List {
    /// Name of the code table. The name of the table of extended codes begins with `extended_`.
    table: &'static str,
    /// Beginning of the names of the list and its items, after the prefix `SystemDefined`, `Profile` or `Ext`.
    element: &'static str,
    code: &'static str,
    add_value: &'static str,
    has_state: bool,
}

static CHANNEL_DIAGNOSIS: List = List {
    table: "channel_diagnosis",
    element: "ChannelDiag",
    code: "ErrorType",
    add_value: "ExtChannelAddValue",
    has_state: true,
};

static PROCESS_ALARMS: List = List {
    table: "process_alarms",
    element: "ChannelProcessAlarm",
    code: "Reason",
    add_value: "ProcessAlarmReasonAddValue",
    has_state: false,
};

/// First code of the range that profiles use.
const FIRST_OF_PROFILE: i128 = 0x9000;

/// Returns whether the code table with this name contains a diagnosis list or the log book of a GSDML.
pub(super) fn is_list(name: &str) -> bool {
    let table = name.strip_prefix("extended_").unwrap_or(name);
    name == "log_book" || [&CHANNEL_DIAGNOSIS, &PROCESS_ALARMS].iter().any(|list| table == list.table)
}

/// Writes all diagnosis lists and the log book.
pub(super) fn write(xml: &mut Xml, context: &mut Context<'_>, catalog: &Catalog) {
    code_list(xml, context, catalog, &CHANNEL_DIAGNOSIS);
    code_list(xml, context, catalog, &PROCESS_ALARMS);
    xml.list("UnitDiagTypeList", &catalog.unit_diagnoses, |xml, diagnosis| unit_diagnosis(xml, context, diagnosis));
    log_book(xml, context, catalog);
}

fn rows<'c>(catalog: &'c Catalog, name: &str) -> Vec<&'c CodeRow> {
    catalog.code_tables.iter().filter(|table| table.name == name).flat_map(|table| &table.rows).collect()
}

fn code_list(xml: &mut Xml, context: &mut Context<'_>, catalog: &Catalog, list: &'static List) {
    let (rows_of_list, name_of_extended) = (rows(catalog, list.table), format!("extended_{}", list.table));
    if rows_of_list.is_empty() {
        return;
    }
    let mut extended: HashMap<i128, Vec<&CodeRow>> = HashMap::new();
    for row in rows(catalog, &name_of_extended) {
        extended.entry(number(row.cells.first())).or_default().push(row);
    }
    xml.list(format!("{}List", list.element), rows_of_list, |xml, row| {
        let api = number(row.cells.get(1));
        let prefix = match (api, row.name.is_empty()) {
            (1.., _) => "Profile",
            (_, true) => "SystemDefined",
            (_, false) => "",
        };
        xml.open(format!("{prefix}{}Item", list.element));
        head(xml, list, row, row.cells.first(), api);
        if prefix != "SystemDefined" {
            texts(xml, context, row);
        }
        extended_codes(xml, context, list, extended.remove(&row.code).unwrap_or_default());
        xml.close();
    });
    let unused: usize = extended.values().map(Vec::len).sum();
    xml.notes.add_many(NoteKind::OtherPart, unused, Subject::Named(&name_of_extended));
}

fn extended_codes(xml: &mut Xml, context: &mut Context<'_>, list: &'static List, rows: Vec<&CodeRow>) {
    xml.list(format!("Ext{}List", list.element), rows, |xml, row| {
        let api = number(row.cells.get(2));
        let prefix = if api > 0 || row.code >= FIRST_OF_PROFILE { "Profile" } else { "" };
        xml.open(format!("{prefix}Ext{}Item", list.element));
        head(xml, list, row, row.cells.get(1), api);
        texts(xml, context, row);
        add_values(xml, list, row.cells.get(3));
        xml.close();
    });
}

fn number(value: Option<&Value>) -> i128 {
    value.and_then(Value::as_int).unwrap_or(0)
}

fn head(xml: &mut Xml, list: &'static List, row: &CodeRow, state: Option<&Value>, api: i128) {
    xml.optional("API", Some(api).filter(|api| *api > 0));
    xml.attribute(list.code, row.code);
    match state {
        Some(Value::Text(state)) if list.has_state && state != "D" => xml.attribute("MaintenanceAlarmState", state),
        _ => {}
    }
}

/// Writes the name and the help text of a code.
fn texts(xml: &mut Xml, context: &mut Context<'_>, row: &CodeRow) {
    context.texts.text(xml, "Name", &row.name, &row.names);
    context.texts.documentation(xml, "Help", row.documentation.as_deref());
}

/// Writes the additional values of a code. The IR stores their identifiers and types in the form
/// `1 Unsigned16, 2 Float32`.
fn add_values(xml: &mut Xml, list: &'static List, cell: Option<&Value>) {
    let Some(Value::Text(text)) = cell else { return };
    let items = text.split(", ").filter_map(|item| item.split_once(' '));
    xml.list(list.add_value, items, |xml, (id, data_type)| {
        xml.empty("DataItem", &[("Id", &id), ("DataType", &data_type)]);
    });
}

fn unit_diagnosis(xml: &mut Xml, context: &mut Context<'_>, diagnosis: &UnitDiagnosis) {
    let prefix = if diagnosis.api > 0 { "Profile" } else { "" };
    xml.open(format!("{prefix}UnitDiagTypeItem"));
    xml.unless("API", diagnosis.api, 0);
    xml.attribute("UserStructureIdentifier", diagnosis.identifier);
    context.texts.text(xml, "Name", &diagnosis.name, &diagnosis.names);
    context.texts.documentation(xml, "Help", diagnosis.documentation.as_deref());
    diagnosis.fields.iter().for_each(|each| field(xml, context, each));
    xml.close();
    xml.notes.add_many(NoteKind::Extension, diagnosis.extensions.len(), Subject::Named(&diagnosis.name));
}

fn field(xml: &mut Xml, context: &mut Context<'_>, field: &UnitDiagnosisField) {
    let values = field.values.and_then(|id| context.types.get(id.0 as usize));
    xml.open("Ref");
    xml.optional("ValueItemTarget", values.map(|def| &def.name));
    types::position(xml, context, field.ty, field.bit_offset, field.bits, &field.name);
    match &field.default {
        Some(Value::Bool(value)) => xml.attribute("DefaultValue", u8::from(*value)),
        Some(Value::Int(value)) => xml.attribute("DefaultValue", value),
        Some(Value::Real(value)) => xml.attribute("DefaultValue", format!("{value:?}")),
        Some(Value::Text(text) | Value::Raw(text)) => xml.attribute("DefaultValue", text),
        _ => {}
    }
    xml.attribute("TextId", context.texts.id(&field.name, &field.names));
    xml.close();
}

/// Writes the log book. The code of a row is the complete status, whose last byte is ErrorCode2.
fn log_book(xml: &mut Xml, context: &mut Context<'_>, catalog: &Catalog) {
    let rows = rows(catalog, "log_book");
    if rows.is_empty() {
        return;
    }
    xml.open("LogBookEntryList");
    let mut next = 0;
    while let Some(first) = rows.get(next) {
        let status = first.code >> 8;
        let same =
            rows.iter().skip(next).take_while(|row| row.code >> 8 == status && row.last.is_none()).count().max(1);
        xml.open("LogBookEntryItem");
        xml.attribute("Status", status);
        if first.last.is_some() {
            xml.open("ErrorCode2Value");
            texts(xml, context, first);
            xml.close();
        } else {
            xml.open("ErrorCode2List");
            for row in rows.iter().skip(next).take(same) {
                xml.open("ErrorCode2Item");
                xml.attribute("ErrorCode2", row.code & 0xFF);
                texts(xml, context, row);
                xml.close();
            }
            xml.close();
        }
        xml.close();
        next += same;
    }
    xml.close();
}
