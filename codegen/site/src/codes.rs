//! Code tables (alarms, emergency codes, abort codes) with causes and remedies.

use super::anchor::Names;
use super::entry::{self, Doubt};
use super::link::Relation;
use super::split::Section;
use super::words::{self, PLAIN};
use lexibus_codegen::facts::code;
use lexibus_codegen::facts::words::capital;
use lexibus_codegen::ir::{CodeTable, Device, Manual};

/// A code table on a page.
#[derive(Debug)]
pub(super) struct Codes {
    /// Position of the table in the device.
    pub position: usize,
    /// True if the first rows of the table are on a previous page.
    pub is_continued: bool,
    pub anchor: String,
    pub title: String,
    pub facts: Vec<String>,
    pub doubts: Vec<Doubt>,
    /// Links to elements that the description of the table mentions.
    pub relations: Vec<Relation>,
    pub columns: Vec<String>,
    pub rows: Vec<Code>,
}

/// A row of a code table on a page.
#[derive(Debug)]
pub(super) struct Code {
    /// Position of the row in the table.
    pub position: usize,
    pub anchor: String,
    pub number: String,
    pub name: String,
    pub names: Vec<(String, String)>,
    pub facts: String,
    pub cells: Vec<String>,
    /// Links to the elements that report the code, and to those that the description of the code mentions.
    pub relations: Vec<Relation>,
}

impl Section for Codes {
    type Element = Code;

    fn elements(&mut self) -> &mut Vec<Code> {
        &mut self.rows
    }

    fn continued(&self) -> Self {
        let (anchor, title, columns) = (self.anchor.clone(), self.title.clone(), self.columns.clone());
        let (facts, doubts, relations, rows) = Default::default();
        Codes { position: self.position, is_continued: true, anchor, title, facts, doubts, relations, columns, rows }
    }

    fn texts(row: &Code) -> impl Iterator<Item = &str> {
        let names = row.names.iter().map(|(_, name)| name);
        let texts = [&row.anchor, &row.anchor, &row.number, &row.name, &row.facts].into_iter();
        texts.chain(names).chain(&row.cells).map(String::as_str)
    }
}

pub(super) fn tables(device: &Device, manual: &Manual) -> Vec<Codes> {
    let mut names = Names::default();
    let with = device.code_tables.iter().enumerate().filter(|(_, table)| !table.rows.is_empty());
    with.map(|(position, table)| Codes { position, ..self::table(table, manual, &mut names) }).collect()
}

fn table(table: &CodeTable, manual: &Manual, names: &mut Names) -> Codes {
    let anchor = names.anchor(&table.name);
    let mut facts = PLAIN.description(table.documentation.as_deref());
    if !table.buses.is_empty() {
        let buses: Vec<&str> = table.buses.iter().map(lexibus_codegen::facts::words::bus_name).collect();
        facts.push(format!("On {}.", buses.join(", ")));
    }
    facts.extend(PLAIN.manual_entry(manual, "", table.documentation.as_deref(), &[]));
    facts.extend(PLAIN.defined_by(table.stated_by.as_deref(), table.documentation.as_deref()));
    let rows = table.rows.iter().enumerate().map(|(position, row)| {
        let mut facts = PLAIN.description(row.documentation.as_deref());
        facts.extend(row.availability.as_ref().map(|availability| PLAIN.availability(availability)));
        facts.extend(PLAIN.manual_entry(manual, "", row.documentation.as_deref(), &row.names));
        facts.extend(PLAIN.defined_by(row.stated_by.as_deref(), row.documentation.as_deref()));
        let number = row.printed_code();
        Code {
            position,
            anchor: names.anchor(&format!("{}-{number}", table.name)),
            number,
            name: row.name.to_string(),
            names: words::names(&row.name, &row.names),
            facts: facts.join(" "),
            cells: (0..table.columns.len()).map(|at| code::cell(row, at)).collect(),
            relations: Vec::new(),
        }
    });
    let rows = rows.collect();
    let columns = table.columns.iter().map(|column| capital(column)).collect();
    let doubts = entry::doubts(&table.doubts, &table.name, manual);
    let title = table.name.to_string();
    Codes { position: 0, is_continued: false, anchor, title, facts, doubts, relations: Vec::new(), columns, rows }
}
