//! Code tables: alarms, emergency codes and abort codes.

use super::bus_facts;
use super::code::{call, slice, Doc};
use super::code_type::{self, CodeTypeModel};
use super::context::Context;
use super::docs::{self, WORDS};
use super::links::is_derive;
use super::literal;
use super::options::RustOptions;
use crate::facts::words::bus_names;
use crate::ir::stated::is_of_profile;
use crate::ir::{CodeRow, CodeTable, Device, Documentation, Value};
use crate::names::{self, Case};

/// A code table, ready to be printed.
pub(super) struct CodeTableModel {
    pub name: String,
    /// True if a profile states the table.
    pub is_of_profile: bool,
    /// Link to the table, relative to its module.
    pub link: String,
    pub docs: Vec<String>,
    pub rows: Vec<Doc>,
    /// True if a cell may contain a real number close to a mathematical constant. Clippy reports such literals.
    pub has_real: bool,
    /// Enumeration of the codes.
    pub ty: Option<CodeTypeModel>,
}

pub(super) fn models(context: &Context<'_>, device: &Device, options: &RustOptions) -> Vec<CodeTableModel> {
    let tables: Vec<&CodeTable> = device.code_tables.iter().filter(|table| !table.rows.is_empty()).collect();
    let name_requests = || names::numbered(tables.iter().map(|table| table.name.as_str()), "codes");
    let names = names::unique(name_requests(), &bus_facts::RESERVED, Case::Snake);
    let types = names::unique(name_requests(), &["Self"], Case::Pascal);
    let named = tables.iter().zip(names.iter().zip(types));
    named.map(|(table, (name, ty))| model(table, name.to_ascii_uppercase(), ty, context, options)).collect()
}

fn model(
    table: &CodeTable,
    name: String,
    type_name: String,
    context: &Context<'_>,
    options: &RustOptions,
) -> CodeTableModel {
    let manual = &context.manual;
    let documentation = table.documentation.as_deref();
    let mut docs = vec![docs::sentence(&docs::escape(&table.name))];
    let text = Documentation::text_of(documentation);
    if !text.is_empty() {
        docs.push(docs::sentence(&docs::escape(text)));
    }
    docs.extend(WORDS.manual_entry(manual, "", documentation, &[]));
    docs.extend(WORDS.defined_by(table.stated_by.as_deref(), documentation));
    docs.extend(docs::doubts(&table.doubts, manual));
    if !table.buses.is_empty() {
        docs.push(format!("These codes occur on {}.", bus_names(table.buses)));
    }
    if !table.columns.is_empty() {
        let columns: Vec<String> = table.columns.iter().map(|column| docs::escape(column)).collect();
        docs.push(format!("Additional columns: {}.", columns.join(", ")));
    }
    let rows = table.rows.iter().filter_map(|code_row| row(code_row, table.columns.len())).collect();
    let ty = code_type::model(table, manual, options).map(|model| CodeTypeModel { name: type_name, ..model });
    // The static and the enumeration of a code table can have the same name, for example a single letter. A name can
    // also be that of a derive macro. In both cases, the link must state the kind of its target.
    let link = |name: &str, kind: &str, other: &str| match name == other || is_derive(name) {
        true => format!("[`{name}`]({kind}@{name})"),
        false => format!("[`{name}`]"),
    };
    let static_link = link(&name, "static", ty.as_ref().map_or("", |model| model.name.as_str()));
    if let Some(model) = &ty {
        docs.push(format!("The codes have the type {}.", link(&model.name, "enum", &name)));
    }
    let has_real = table.rows.iter().flat_map(|row| &row.cells).any(|cell| matches!(cell, Value::Real(_)));
    let is_of_profile = is_of_profile(table.stated_by.as_deref());
    let docs = docs::paragraphs(docs);
    CodeTableModel { name, is_of_profile, link: static_link, docs, rows, has_real, ty }
}

/// Returns the expression for a row of a code table. Returns `None` if the first or last code does not fit in an `i64`.
fn row(row: &CodeRow, columns: usize) -> Option<Doc> {
    let (first, last) = (i64::try_from(row.code).ok()?, i64::try_from(row.last.unwrap_or(row.code)).ok()?);
    let mut text = row.documentation.as_ref().map_or_else(String::new, |documentation| documentation.text.to_string());
    if let Some(availability) = &row.availability {
        let whole = if text.is_empty() { String::new() } else { docs::sentence(&text) + " " };
        text = whole + &WORDS.availability(availability);
    }
    let mut cells: Vec<Doc> = row.cells.iter().take(columns.max(row.cells.len())).map(cell).collect();
    cells.resize(columns.max(cells.len()), Doc::from("rt::codes::Cell::Empty"));
    let cells = if cells.is_empty() { Doc::from("&[]") } else { slice(cells) };
    let (name, text) = (literal::string(&row.name), literal::string(&text));
    let [first, last] = [first, last].map(code_type::number);
    Some(call!("rt::codes::Code::new", first, last, name, text, cells))
}

fn cell(value: &Value) -> Doc {
    let text = |text: &str| call!("rt::codes::Cell::Text", literal::string(text));
    match value {
        Value::Real(real) if real.is_finite() => Doc::from(format!("rt::codes::Cell::Real({real:?})")),
        Value::Text(string) => text(string),
        other => match other.as_int().and_then(|number| i64::try_from(number).ok()) {
            Some(number) => Doc::from(format!("rt::codes::Cell::Number({number})")),
            None => text(&other.to_string()),
        },
    }
}
