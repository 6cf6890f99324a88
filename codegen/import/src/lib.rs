//! Converts lists of registers to register tables. The lists are CSV files that were exported from spreadsheets.
//! [`lexibus-codegen`](lexibus_codegen) compiles the tables to typed Rust. The command `lexibus import` uses this crate.
//!
//! ```
//! use lexibus_codegen::source::Source;
//! use lexibus_import::{import, Options};
//!
//! let list = "Register,Name,Type,Access,Unit\n40001,Set point,INT16,RW,rpm\n";
//! let import = import(Source::new("pump.csv", list.into()), &Options::default());
//! assert!(import.table.unwrap().contains(r#""Set point" = { reg = 40001, type = "i16", access = "rw", unit = "rpm" }"#));
//! for diagnostic in import.compilation.diagnostics.list() {
//!     println!("{}: {}", diagnostic.code.id, diagnostic.message);
//! }
//! ```
//!
//! | file | subject |
//! |---|---|
//! | `records` | lines and cells with their positions |
//! | `quotes` | lines and cells of a file whose quotation marks are ordinary characters |
//! | `columns` | determines the field of each column by its title |
//! | `cells`, `types`, `address`, `values` | content of a single cell |
//! | `style` | notation of a whole column: decimal comma, hexadecimal addresses, limits in physical units |
//! | `rows` | address, type and access rights of each row |
//! | `facts` | further attributes of a row: unit, factor, limits, named values, documentation |
//! | `layout` | chapters and spaces of the rows; repeated names and addresses |
//! | `write` | the table as TOML |
//!
//! The import reports unreadable cells, and lines that cannot become rows. Such lines are kept as comments.
#![forbid(unsafe_code)]

mod address;
mod cells;
mod columns;
mod definitions;
mod facts;
mod layout;
mod quotes;
mod records;
mod rows;
mod style;
mod types;
mod values;
mod write;

pub use columns::Field;

use lexibus_codegen::compile::Compilation;
use lexibus_codegen::diagnostics::{codes, Diagnostic, Diagnostics, Levels};
use lexibus_codegen::source::{FileId, Source, Span};
use lexibus_codegen::text::brief;

use columns::Columns;
use records::{Record, Records};

/// Options of an import.
#[derive(Clone, Debug, Default)]
pub struct Options {
    /// Levels of the diagnostic codes.
    pub levels: Levels,
    /// The fields of columns that the caller identifies. A column is identified by its title, or by `#` and its number.
    pub map: Vec<(Field, String)>,
    /// Delimiter between cells. By default, the delimiter comes from a first line such as `sep=;`. Without such a line,
    /// the delimiter with the most recognized titles is used.
    pub delimiter: Option<u8>,
    /// Name of the device. The default name is the file name without extension.
    pub name: Option<String>,
}

/// Result of an import.
#[derive(Debug)]
pub struct Import {
    /// The list and its diagnostics. The compilation has no catalog.
    pub compilation: Compilation,
    /// The register table. `None` if there are errors.
    pub table: Option<String>,
}

/// File number of the imported list.
const FILE: FileId = FileId(0);

/// Converts a list of registers to a register table.
pub fn import(source: Source, options: &Options) -> Import {
    let mut diagnostics = Diagnostics::new(options.levels.clone());
    let table = convert(&source, options, &mut diagnostics).filter(|_| !diagnostics.has_errors());
    diagnostics.sort();
    Import { compilation: Compilation::of_diagnostics(source, diagnostics), table }
}

fn convert(source: &Source, options: &Options, diagnostics: &mut Diagnostics) -> Option<String> {
    let (records, columns) = match divide(source, options) {
        Ok(divided) => divided,
        Err(column) => {
            let message = format!("the list has no column `{}`", brief(&column));
            diagnostics.push(Diagnostic::new(&codes::CSV_NO_SUCH_COLUMN, Span::new(FILE, 0, 0), message));
            return None;
        }
    };
    if let Some(span) = records.unclosed {
        let message = "the quotation mark is never closed";
        diagnostics.push(Diagnostic::new(&codes::CSV_UNCLOSED_QUOTE, span, message));
    }
    for &span in &records.letters {
        let message = "the quotation mark is not closed in its cell";
        diagnostics.push(Diagnostic::new(&codes::CSV_UNCLOSED_QUOTE, span, message).label("read as part of the text"));
    }
    if !columns.has_address() {
        let message = "no line contains the titles of an address column and of another column";
        let help = "use titles such as Name, Address, Type and Access, or name the address column with `--map reg=#2`";
        diagnostics.push(Diagnostic::new(&codes::CSV_NO_COLUMNS, Span::new(FILE, 0, 0), message).help(help));
        return None;
    }
    unknown_columns(&records, &columns, diagnostics);
    let list = rows::read(&records, &columns, diagnostics);
    let list = layout::arrange(list, diagnostics);
    let stem = std::path::Path::new(source.name()).file_stem().map(|stem| stem.to_string_lossy().into_owned());
    let name = options.name.clone().or(stem).unwrap_or_else(|| "device".to_owned());
    Some(write::table(&list, &name, source.name()))
}

/// Splits a file into lines and determines its columns.
///
/// # Errors
///
/// Returns the title or number of a column in `options.map` that the list does not contain.
fn divide(source: &Source, options: &Options) -> Result<(Records, Columns), String> {
    let declared = records::declared_delimiter(source.text());
    let start = declared.map_or(0, |(_, length)| length);
    let known = options.delimiter.or(declared.map(|(delimiter, _)| delimiter));
    let candidates = known.map_or(vec![b',', b';', b'\t', b'|'], |delimiter| vec![delimiter]);
    let mut best: Option<(usize, Records, Columns)> = None;
    let mut missing = None;
    for delimiter in candidates {
        let mut records = records::read(source, FILE, delimiter, start);
        if delimiter == quotes::TAB && quotes::swallows(&records) {
            records = quotes::divide(source, FILE, start);
        }
        match columns::find(&records, &options.map) {
            // Use the delimiter that gives the most recognized titles.
            Ok(columns) if best.as_ref().is_none_or(|(score, ..)| columns.score() > *score) => {
                best = Some((columns.score(), records, columns));
            }
            Ok(_) => {}
            Err(column) => missing = Some(column.to_owned()),
        }
    }
    match (best, missing) {
        (Some((_, records, columns)), None) => Ok((records, columns)),
        (Some((_, records, columns)), Some(_)) if columns.has_address() => Ok((records, columns)),
        (_, Some(column)) => Err(column),
        (None, None) => Ok(Default::default()),
    }
}

/// Reports all columns that are not imported, in a single diagnostic.
fn unknown_columns(records: &Records, columns: &Columns, diagnostics: &mut Diagnostics) {
    let Some(header) = columns.header.and_then(|line| records.list.get(line)) else { return };
    let is_known = |at: usize| columns.list.iter().any(|column| column.at == at);
    let unknown: Vec<_> = header.filled().filter(|(at, _)| !is_known(*at)).map(|(_, cell)| cell).collect();
    let Some(first) = unknown.first() else { return };
    let titles: Vec<String> = unknown.iter().map(|cell| format!("`{}`", brief(&cell.text))).collect();
    let message = match titles.as_slice() {
        [one] => format!("the column {one} is not imported"),
        all => format!("the columns {} are not imported", all.join(", ")),
    };
    let help = format!("import it as documentation with `--map doc=\"{}\"`", brief(&first.text));
    diagnostics.push(Diagnostic::new(&codes::CSV_UNKNOWN_COLUMN, first.span, message).help(help));
}

/// Returns the data lines: those after the titles, except empty lines and repeated titles.
fn data<'r>(records: &'r Records, columns: &Columns) -> impl Iterator<Item = &'r Record> {
    let header = columns.header.and_then(|line| records.list.get(line));
    let texts = |record: &Record| record.cells.iter().map(|cell| cell.text.clone()).collect::<Vec<_>>();
    let titles = header.map(texts);
    let start = columns.header.map_or(0, |line| line + 1);
    let below = records.list.iter().skip(start);
    below.filter(move |record| record.filled().next().is_some() && Some(texts(record)) != titles)
}

/// Parses a command-line argument of the form `FIELD=COLUMN`.
///
/// # Errors
///
/// Returns a message if the text does not have this form or the field is unknown.
pub fn mapping(text: &str) -> Result<(Field, String), String> {
    let (field, column) = text.split_once('=').ok_or("write FIELD=TITLE or FIELD=#NUMBER")?;
    let (field, column) = (field.trim(), column.trim());
    if column.is_empty() {
        return Err("write FIELD=TITLE or FIELD=#NUMBER".to_owned());
    }
    let known = || Field::names().collect::<Vec<_>>().join(", ");
    let hint = || {
        Field::similar(field)
            .map_or_else(|| format!("use one of {}", known()), |name| format!("did you mean `{name}`?"))
    };
    Field::find(field)
        .map(|field| (field, column.to_owned()))
        .ok_or_else(|| format!("there is no field `{field}`: {}", hint()))
}

/// Parses a delimiter from the command line: a character, `tab`, `comma` or `semicolon`.
///
/// # Errors
///
/// Returns a message if the text is not a delimiter.
pub fn delimiter(text: &str) -> Result<u8, String> {
    match (text, text.as_bytes()) {
        ("tab" | "\\t", _) => Ok(b'\t'),
        ("comma", _) => Ok(b','),
        ("semicolon", _) => Ok(b';'),
        (_, &[byte]) if byte.is_ascii() && !matches!(byte, b'"' | b'\n' | b'\r') => Ok(byte),
        _ => Err("expected one character, or `tab`, `comma` or `semicolon`".to_owned()),
    }
}
