//! Backups as TOML files. Each parameter has a line with its name, address and value.

use std::error::Error;
use std::fmt::{self, Write as _};

use lexibus_codegen::facts::encoding;
use lexibus_codegen::ir::{Type, Value};
use lexibus_codegen::text::printable;

use super::entry::{Backup, Entry};
use crate::description::Description;
use crate::parameter::Parameter;
use crate::quote::quoted;

/// Version of the format.
const VERSION: i64 = 1;

/// The reason why a file isn't a backup of the device.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TableError(String);

impl fmt::Display for TableError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl Error for TableError {}

impl Backup {
    /// Returns the backup as TOML.
    #[must_use]
    pub fn toml(&self, description: &Description) -> String {
        let mut text = format!("lexibus-backup = {VERSION}\ndevice = {}\n", quoted(&description.device().name));
        if let Some(node_id) = self.node_id {
            let _ = writeln!(text, "node-id = {node_id}");
        }
        text.push_str("\nparameters = [\n");
        for entry in &self.entries {
            let Some(parameter) = description.at(entry.address) else { continue };
            let shown = printable(&parameter.text(&entry.value)).into_owned();
            let value = written(&parameter, &entry.value);
            let comment = if shown == value || quoted(&shown) == value { String::new() } else { format!(" # {shown}") };
            let _ = writeln!(
                text,
                "    {{ address = {}, name = {}, value = {value} }},{comment}",
                quoted(&entry.address_text),
                quoted(&entry.name)
            );
        }
        text.push_str("]\n");
        text
    }

    /// Reads a backup from TOML.
    ///
    /// # Errors
    ///
    /// Fails if the text isn't a backup, or if an entry doesn't identify a parameter of the description. Also fails if a
    /// value is missing or cannot be parsed.
    pub fn from_toml(text: &str, description: &Description) -> Result<Self, TableError> {
        let table: toml::Table = text.parse().map_err(|error: toml::de::Error| TableError(error.to_string()))?;
        if table.get("lexibus-backup").and_then(toml::Value::as_integer) != Some(VERSION) {
            return Err(TableError(format!("the file is not a backup: `lexibus-backup = {VERSION}` is missing")));
        }
        let wrong = || TableError("`node-id` must be an integer from 1 to 255".to_owned());
        let node_id = table.get("node-id").map(|id| address(id).ok_or_else(wrong)).transpose()?;
        let rows = table.get("parameters").and_then(toml::Value::as_array);
        let rows = rows.ok_or_else(|| TableError("the file has no list `parameters`".to_owned()))?;
        let entries = rows.iter().map(|row| entry(row, description)).collect::<Result<_, _>>()?;
        Ok(Self { node_id, entries, skipped: Vec::new() })
    }
}

/// Returns a node-ID or a Modbus server address.
fn address(value: &toml::Value) -> Option<u8> {
    value.as_integer().and_then(|id| u8::try_from(id).ok()).filter(|id| *id > 0)
}

/// Returns a raw value in the notation of TOML.
fn written(parameter: &Parameter<'_>, value: &Value) -> String {
    match value {
        Value::Bool(value) => value.to_string(),
        Value::Int(value) if i64::try_from(*value).is_ok() => value.to_string(),
        Value::Int(value) => quoted(&format!("{value} raw")),
        Value::Real(value) if value.is_finite() => format!("{value:?}"),
        Value::Text(text) => quoted(text),
        Value::NodeId(_) => quoted(&value.to_string()),
        other => {
            let bytes = parameter.encode(other, None).unwrap_or_default();
            quoted(&lexibus_codegen::number::bytes(&bytes))
        }
    }
}

fn entry(row: &toml::Value, description: &Description) -> Result<Entry, TableError> {
    let text = |key: &str| row.get(key).and_then(toml::Value::as_str);
    let identifier = text("address").or_else(|| text("name"));
    let identifier =
        identifier.ok_or_else(|| TableError(format!("a parameter has neither an address nor a name: {row:?}")))?;
    let parameter = description.find(identifier).map_err(|error| TableError(error.to_string()))?;
    let is_named =
        |name: &str| parameter.path().eq_ignore_ascii_case(name) || parameter.name().eq_ignore_ascii_case(name);
    if let Some(name) = text("name").filter(|name| !is_named(name)) {
        return Err(TableError(format!("{parameter}: the backup states another name for this address: `{name}`")));
    }
    let value = row.get("value").ok_or_else(|| TableError(format!("{parameter}: the value is missing")))?;
    Ok(Entry::new(&parameter, parsed(&parameter, value)?))
}

fn parsed(parameter: &Parameter<'_>, value: &toml::Value) -> Result<Value, TableError> {
    let error = |message: &dyn fmt::Display| TableError(format!("{parameter}: {message}"));
    let is_real = matches!(parameter.basic(), Type::Real32 | Type::Real64);
    match value {
        toml::Value::Integer(number) if is_real => Ok(Value::Real(*number as f64)),
        toml::Value::Integer(number) => Ok(Value::Int((*number).into())),
        toml::Value::Boolean(value) => Ok(Value::Bool(*value)),
        toml::Value::Float(number) => Ok(Value::Real(*number)),
        toml::Value::String(text) => {
            let value = parameter.parse(text).map_err(|found| error(&found))?;
            match &value {
                Value::Bytes(bytes) => {
                    encoding::value(bytes, parameter.basic()).ok_or_else(|| error(&"the value has the wrong length"))
                }
                _ => Ok(value),
            }
        }
        _ => Err(error(&"the value has the wrong type")),
    }
}
