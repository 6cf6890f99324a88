//! `lexibus import`: converts a list of registers to a register table.

use std::io::Write;

use lexibus_codegen::diagnostics::{Level, Levels};
use lexibus_import::Options;

use super::args::Import;
use super::files::{create, read};
use super::report::Reporter;
use super::Failure;

pub(super) fn run(import: &Import) -> Result<bool, Failure> {
    let mut levels = if import.strict { Levels::strict() } else { Levels::lenient() };
    for code in &import.allow {
        levels.set(code, Level::Allow).map_err(|error| Failure::Usage(error.to_string()))?;
    }
    let source = read(&import.path)?;
    let options = Options { levels, map: import.map.clone(), delimiter: import.delimiter, name: import.name.clone() };
    let imported = lexibus_import::import(source, &options);
    let mut reporter = Reporter::with(&import.printing, false)?;
    reporter.report(&imported.compilation)?;
    if let Some(text) = &imported.table {
        match &import.out {
            Some(path) => create(path, text.as_bytes())?,
            None => std::io::stdout().lock().write_all(text.as_bytes())?,
        }
    }
    reporter.finish()
}
