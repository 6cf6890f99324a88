//! The JSON Schema of the format, by which editors complete and check tables.
//!
//! The module is compiled for unit tests only: [`super::SCHEMA`] is the file that the test below compares with the schema, so
//! that the compiler doesn't depend on `schemars`.
//!
//! `format` derives it; here is what `serde` can't tell: words, grammars of keys, and that options stand anywhere.

use std::path::Path;

use schemars::generate::SchemaSettings;
use schemars::transform::{transform_subschemas, RecursiveTransform};
use schemars::{json_schema, Schema};
use serde_json::{json, Map, Value};

use super::format::Document;
use crate::output::write_if_changed;

/// An integer as keys have it.
const NUMBER: &str = r"(0[xX][0-9A-Fa-f_]+|0[bB][01_]+|0[oO][0-7_]+|[0-9][0-9_]*)";

/// A value that an option gives.
const OPTION: &str = r"^\$[a-z]";

/// The schema, as text.
fn text() -> String {
    let mut settings = SchemaSettings::draft07();
    settings.transforms.insert(0, Box::new(RecursiveTransform(without_null)));
    settings.transforms.push(Box::new(RecursiveTransform(with_options)));
    let mut schema = settings.into_generator().into_root_schema_for::<Document>();
    schema.insert("title".into(), "Lexibus register table".into());
    schema.insert("required".into(), json!(["lexibus"]));
    let kinds = ["device", "overlay", "profile"].map(|kind| json!({ "required": [kind] }));
    schema.insert("oneOf".into(), json!(kinds));
    format!("{:#}\n", schema.as_value())
}

/// TOML has no null: what may be left out is left out.
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
    let Some(Value::Array(kinds)) = schema.get_mut("anyOf") else { return };
    kinds.retain(|kind| kind.get("type") != Some(&null));
    if let [Value::Object(only)] = kinds.as_slice() {
        let only = only.clone();
        schema.remove("anyOf");
        for (key, value) in only {
            schema.ensure_object().entry(key).or_insert(value);
        }
    }
}

/// `"$name"` stands for the choice of an option, wherever a number or a truth value does.
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

/// Applies `change` to the schema of a text, or of the texts of a list.
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

/// One of a few words.
pub(super) fn words(words: &'static [&'static str]) -> impl FnMut(&mut Schema) {
    move |schema| {
        texts(schema, &mut |text| {
            text.insert("anyOf".into(), json!([{ "enum": words }, { "type": "string", "pattern": OPTION }]));
        });
    }
}

/// The names of types.
pub(super) fn types(schema: &mut Schema) {
    let grammar = concat!(
        r"^((bool|[ui]([1-9]|[1-5][0-9]|6[0-4])|f32|f64|(str|wstr|bytes)( *\( *[0-9]+ *\))?",
        r"|time_of_day|time_difference|domain|\?)( *\[ *[1-9][0-9]* *\])?|\$[a-z].*)$"
    );
    texts(schema, &mut |text| {
        text.insert("anyOf".into(), json!([{ "enum": super::types::NAMES }, { "type": "string", "pattern": grammar }]));
    });
}

/// A number or a text of this grammar, in which `#` stands for a number.
pub(super) fn place(grammar: &'static str) -> impl FnMut(&mut Schema) {
    move |schema| {
        let grammar = format!(r"^ *({}|\$[a-z].*) *$", grammar.replace('#', NUMBER));
        let own = json_schema!({ "anyOf": [
            { "type": "integer", "minimum": 0 },
            { "type": "string", "pattern": grammar },
        ]});
        let description = schema.remove("description");
        *schema = own;
        if let Some(description) = description {
            schema.insert("description".into(), description);
        }
    }
}

/// Keys of this grammar, in which `#` stands for a number.
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
            let kinds = schema.get_mut("anyOf").and_then(Value::as_array_mut);
            for kind in kinds.into_iter().flatten() {
                if let Ok(kind) = <&mut Schema>::try_from(kind) {
                    grammar_of_keys(kind, grammar);
                }
            }
        }
    }
}

/// What keys of objects, bits and values look like.
pub(super) const OBJECTS: &str = r"#(\.\.=?#)?(:#(\.\.=?#)?)?";
pub(super) const BITS: &str = r"\[?#((\.\.|-)#)?\]?";
pub(super) const BITS_OF_BYTES: &str = r"(#:)?\[?#((\.\.|-)#)?\]?";
pub(super) const VALUES: &str = r"[-+]?#(\.\.=?[-+]?#)?";

/// The words of longer lists.
pub(super) const BUSES: &[&str] = &["canopen", "ethercat", "modbus", "profinet", "serial"];
pub(super) const PURPOSES: &[&str] = &["mailbox_out", "mailbox_in", "outputs", "inputs"];
pub(super) const CHECKS: &[&str] = &["xor", "sum", "lrc", "crc8", "crc16"];
pub(super) const TRIGGERS: &[&str] = &["rising", "falling", "toggle", "self_clearing"];

/// Compares the schema with the file, or writes the file if the environment variable `LEXIBUS_BLESS` is `1`.
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
