//! Numbers of diagnostics by code.

use std::borrow::Cow;
use std::collections::BTreeMap;

use lexibus_codegen::diagnostics::render::marked::MarkedSource;
use lexibus_codegen::diagnostics::{Diagnostic, Severity};
use lexibus_codegen::source::{FileId, Source};
use lexibus_codegen::text::printable;
use serde::Serialize;

use super::json_line;
use crate::Failure;

/// Numbers of diagnostics by code, with the first position of each code.
#[derive(Default)]
pub(super) struct Statistics(BTreeMap<&'static str, Row>);

/// The diagnostics with one code, as a JSON object.
#[derive(Serialize)]
struct Row {
    code: &'static str,
    name: &'static str,
    severity: Severity,
    count: usize,
    files: usize,
    first: Location,
}

/// Location of a diagnostic. A diagnostic about a whole file has no line and no column.
#[derive(Serialize)]
struct Location {
    file: Option<String>,
    line: Option<u32>,
    column: Option<u32>,
}

impl Statistics {
    /// Adds the diagnostics of one input.
    pub(super) fn add(&mut self, diagnostics: &[Cow<Diagnostic>], sources: &[Source]) {
        let mut last: BTreeMap<&str, FileId> = BTreeMap::new();
        for diagnostic in diagnostics {
            let code = diagnostic.code;
            let row = self.0.entry(code.id).or_insert_with(|| {
                let first = Location::of(diagnostic, sources);
                Row { code: code.id, name: code.name, severity: diagnostic.severity, count: 0, files: 0, first }
            });
            row.count += diagnostic.occurrences();
            // Diagnostics are sorted by file.
            if last.insert(code.id, diagnostic.span.file) != Some(diagnostic.span.file) {
                row.files += 1;
            }
        }
    }

    /// Returns the rows by descending number of diagnostics.
    fn rows(&self) -> Vec<&Row> {
        let mut rows: Vec<&Row> = self.0.values().collect();
        rows.sort_by_key(|row| std::cmp::Reverse(row.count));
        rows
    }

    /// Returns a table with aligned columns, or an empty text if there are no diagnostics.
    pub(super) fn text(&self) -> String {
        let cells = |row: &&Row| {
            let [code, severity, name] = [row.code, row.severity.name(), row.name].map(str::to_owned);
            [row.count.to_string(), row.files.to_string(), code, severity, name, row.first.text()]
        };
        let rows: Vec<[String; 6]> = self.rows().iter().map(cells).collect();
        if rows.is_empty() {
            return String::new();
        }
        let titles = ["count", "files", "code", "severity", "name", "first"].map(str::to_owned);
        let table: Vec<&[String; 6]> = std::iter::once(&titles).chain(&rows).collect();
        let width = |column: usize| table.iter().map(|row| row[column].len()).max().unwrap_or_default();
        let [count, files, code, severity, name] = [0, 1, 2, 3, 4].map(width);
        let line = |row: &&[String; 6]| {
            let [a, b, c, d, e, f] = row;
            format!("{a:>count$}  {b:>files$}  {c:code$}  {d:severity$}  {e:name$}  {f}\n")
        };
        table.iter().map(line).collect::<String>() + "\n"
    }

    /// Returns one JSON object per line.
    pub(super) fn json(&self) -> Result<String, Failure> {
        self.rows().into_iter().map(json_line).collect()
    }
}

impl Location {
    fn of(diagnostic: &Diagnostic, sources: &[Source]) -> Self {
        let marked = MarkedSource::of(diagnostic.span, sources);
        let from = marked.and_then(|marked| marked.mark).map(|mark| mark.from);
        Location {
            // In all output formats, replace control characters in paths, because a terminal would interpret them.
            file: marked.map(|marked| printable(marked.source.name()).into_owned()),
            line: from.map(|from| from.line),
            column: from.map(|from| from.column),
        }
    }

    fn text(&self) -> String {
        let file = self.file.as_deref().unwrap_or_default();
        match (self.line, self.column) {
            (Some(line), Some(column)) => format!("{file}:{line}:{column}"),
            _ => file.to_owned(),
        }
    }
}
