//! `lexibus schema`: prints the JSON Schema of register tables. Editors use the schema for completion and validation.

use std::io::Write;

use lexibus_codegen::frontend::table;
use lexibus_codegen::output::write_if_changed;

use super::args::Schema;
use super::output;
use super::Failure;

pub(super) fn run(schema: &Schema) -> Result<bool, Failure> {
    print(schema, table::SCHEMA)
}

/// Writes a schema, or compares it with the existing file.
pub(super) fn print(schema: &Schema, text: &str) -> Result<bool, Failure> {
    match &schema.out {
        Some(path) if schema.check => {
            let stale = output::difference(path, text);
            if let Some(difference) = &stale {
                super::say(&format!("error: {}", difference.message));
                difference.lines(path, text).iter().for_each(|line| super::say(line));
            }
            return Ok(stale.is_none());
        }
        Some(path) => write_if_changed(path, text)?,
        None => std::io::stdout().lock().write_all(text.as_bytes())?,
    }
    Ok(true)
}
