//! JSON Schema of the format, which editors use to complete and check tables.
//!
//! The module is compiled for unit tests only, so that the compiler does not depend on `schemars`. The test below
//! compares the schema with [`super::SCHEMA`].
//!
//! The schema is derived from the types in `format`. This module adds the allowed words, the grammars of keys, and
//! options in place of values.

use std::path::Path;

use schemars::generate::SchemaSettings;
use schemars::transform::{transform_subschemas, RecursiveTransform};
use schemars::{json_schema, Schema};
use serde_json::{json, Map, Value};

use super::format::Document;
use crate::output::write_if_changed;

/// Grammar of an integer in a key.
const NUMBER: &str = r"(0[xX][0-9A-Fa-f_]+|0[bB][01_]+|0[oO][0-7_]+|[0-9][0-9_]*)";

/// Grammar of an option (`$name`) in place of a value.
const OPTION: &str = r"^\$[a-z]";

/// Returns the schema of the format as JSON text.
fn text() -> String {
    let mut settings = SchemaSettings::draft07();
    settings.transforms.insert(0, Box::new(RecursiveTransform(without_null)));
    settings.transforms.push(Box::new(RecursiveTransform(with_options)));
    let mut schema = settings.into_generator().into_root_schema_for::<Document>();
    schema.insert("title".into(), "Lexibus register table".into());
    schema.insert("required".into(), json!(["lexibus"]));
    let roots = ["device", "overlay", "profile"].map(|root| json!({ "required": [root] }));
    schema.insert("oneOf".into(), json!(roots));
    format!("{:#}\n", schema.as_value())
}

/// Removes `null` from a schema. TOML has no `null`: a table omits an optional key instead.
fn without_null(schema: &mut Schema) {
    let null = json!("null");
    if schema.get("default") == Some(&Value::Null) {
        schema.remove("default");
    }
    if let Some(Value::Array(types)) = schema.get_mut("type") {
        types.retain(|ty| *ty != null);
        if let [only] = types.as_slice() {
            let only = only.clone();
            schema.insert("type".into(), only);
        }
    }
    let Some(Value::Array(alternatives)) = schema.get_mut("anyOf") else { return };
    alternatives.retain(|alternative| alternative.get("type") != Some(&null));
    if let [Value::Object(only)] = alternatives.as_slice() {
        let only = only.clone();
        schema.remove("anyOf");
        for (key, value) in only {
            schema.ensure_object().entry(key).or_insert(value);
        }
    }
}

/// Allows an option (`"$name"`) in place of a number or Boolean.
fn with_options(schema: &mut Schema) {
    let Some(Value::String(ty)) = schema.get("type") else { return };
    let is_fixed = schema.get("const").is_some();
    if is_fixed || !matches!(ty.as_str(), "integer" | "number" | "boolean") {
        return;
    }
    let types = json!([ty, "string"]);
    schema.insert("type".into(), types);
    schema.insert("pattern".into(), OPTION.into());
}

/// Applies `change` to the schema of a text, or of the texts in a list.
fn texts(schema: &mut Schema, change: &mut dyn FnMut(&mut Map<String, Value>)) {
    let is_text = match schema.get("type") {
        Some(Value::String(ty)) => ty == "string",
        Some(Value::Array(types)) => types.iter().any(|ty| ty == "string"),
        _ => false,
    };
    if is_text {
        schema.remove("type");
        change(schema.ensure_object());
    } else {
        transform_subschemas(&mut |inner: &mut Schema| texts(inner, change), schema);
    }
}

/// Allows only the words in `words`, and options (`$name`). The words are one text, because the derive macro of `schemars` cannot
/// parse a list of texts.
pub(super) fn words(words: &'static str) -> impl FnMut(&mut Schema) {
    let words: Vec<&str> = words.split(' ').collect();
    move |schema| {
        texts(schema, &mut |text| {
            text.insert("anyOf".into(), json!([{ "enum": words }, { "type": "string", "pattern": OPTION }]));
        });
    }
}

/// Allows only names of data types, and options (`$name`).
pub(super) fn types(schema: &mut Schema) {
    let grammar = concat!(
        r"^((bool|[ui]([1-9]|[1-5][0-9]|6[0-4])|f32|f64|(str|wstr|bytes)( *\( *[0-9]+ *\))?",
        r"|time_of_day|time_difference|domain|\?)( *\[ *[1-9][0-9]* *\])?|\$[a-z].*)$"
    );
    texts(schema, &mut |text| {
        text.insert("anyOf".into(), json!([{ "enum": super::types::NAMES }, { "type": "string", "pattern": grammar }]));
    });
}

/// Allows a non-negative integer, a text that matches `grammar`, or a text that begins with `$` and a lower-case
/// letter. In the grammar, `#` means a number.
pub(super) fn notation(grammar: &'static str) -> impl FnMut(&mut Schema) {
    move |schema| {
        let grammar = format!(r"^ *({}|\$[a-z].*) *$", grammar.replace('#', NUMBER));
        let alternatives = json_schema!({ "anyOf": [
            { "type": "integer", "minimum": 0 },
            { "type": "string", "pattern": grammar },
        ]});
        let description = schema.remove("description");
        *schema = alternatives;
        if let Some(description) = description {
            schema.insert("description".into(), description);
        }
    }
}

/// Allows only keys that match `grammar`. In the grammar, `#` means a number.
pub(super) fn keys(grammar: &'static str) -> impl FnMut(&mut Schema) {
    move |schema| grammar_of_keys(schema, &format!("^{}$", grammar.replace('#', NUMBER)))
}

fn grammar_of_keys(schema: &mut Schema, grammar: &str) {
    match schema.get("type") {
        Some(Value::String(ty)) if ty == "object" => {
            if let Some(entry) = schema.remove("additionalProperties") {
                schema.insert("patternProperties".into(), json!({ grammar: entry }));
                schema.insert("additionalProperties".into(), false.into());
            }
        }
        _ => {
            let alternatives = schema.get_mut("anyOf").and_then(Value::as_array_mut);
            for alternative in alternatives.into_iter().flatten() {
                if let Ok(alternative) = <&mut Schema>::try_from(alternative) {
                    grammar_of_keys(alternative, grammar);
                }
            }
        }
    }
}

/// Grammar of keys that name objects.
pub(super) const OBJECTS: &str = r"#(\.\.=?#)?(:#(\.\.=?#)?)?";
pub(super) const BITS: &str = r"\[?#((\.\.|-)#)?\]?";
pub(super) const BITS_OF_BYTES: &str = r"(#:)?\[?#((\.\.|-)#)?\]?";
pub(super) const VALUES: &str = r"[-+]?#(\.\.=?[-+]?#)?";

/// Names of the buses, separated by spaces.
pub(super) const BUSES: &str = "canopen ethercat modbus profinet serial";
pub(super) const PURPOSES: &str = "mailbox_out mailbox_in outputs inputs";
pub(super) const CHECKS: &str = "xor sum lrc crc8 crc16";
pub(super) const TRIGGERS: &str = "rising falling toggle self_clearing";

/// Compares the derived schema with the file. Writes the file instead if the environment variable `LEXIBUS_BLESS` is `1`.
#[test]
fn the_file_has_the_derived_schema() {
    let derived = text();
    if std::env::var_os("LEXIBUS_BLESS").is_some_and(|value| value == "1") {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("schema/table.json");
        write_if_changed(&path, &derived).expect("the file of the schema");
    } else {
        assert!(derived == super::SCHEMA, "codegen/schema/table.json is stale: tests/bindings.sh writes it again");
    }
}
