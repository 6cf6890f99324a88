//! JSON Schema of `network.toml`, which editors use for completion and validation.

use std::fmt::Write as _;

use super::network_toml::FILE;
use super::section::{Form, Key, Section};

/// Returns the JSON Schema (draft 2020-12) of `network.toml`.
pub fn schema() -> String {
    let mut text = String::from("{\n  \"$schema\": \"https://json-schema.org/draft/2020-12/schema\",\n");
    text += "  \"title\": \"CANopen network or EtherCAT segment\",\n  \"description\": \"network.toml of Lexibus.\",\n";
    object(&mut text, &FILE, 1);
    text + "}\n"
}

/// Writes the members of a schema for a table.
fn object(text: &mut String, section: &Section, depth: usize) {
    let _ = writeln!(text, "{}\"type\": \"object\",", "  ".repeat(depth));
    properties(text, section, depth);
}

/// Writes the properties of a table.
fn properties(text: &mut String, section: &Section, depth: usize) {
    let indent = "  ".repeat(depth);
    let _ = writeln!(text, "{indent}\"additionalProperties\": false,\n{indent}\"properties\": {{");
    for (key, number) in section.keys.iter().zip(1..) {
        let _ = writeln!(text, "{indent}  \"{}\": {{", key.name);
        self::key(text, key, depth + 2);
        let _ = writeln!(text, "{indent}  }}{}", if number < section.keys.len() { "," } else { "" });
    }
    let _ = writeln!(text, "{indent}}}");
}

/// Writes the members of a schema for the value of a key.
fn key(text: &mut String, key: &Key, depth: usize) {
    let indent = "  ".repeat(depth);
    let _ = writeln!(text, "{indent}\"description\": \"{}\",", key.about.replace('\\', "\\\\").replace('"', "\\\""));
    let members = match key.form {
        Form::Integer(low, high) => format!("\"type\": \"integer\", \"minimum\": {low}, \"maximum\": {high}"),
        Form::Number => "\"type\": \"number\", \"exclusiveMinimum\": 0".to_owned(),
        Form::Flag => "\"type\": \"boolean\"".to_owned(),
        Form::Text => "\"type\": \"string\"".to_owned(),
        Form::ShortText(longest) => format!("\"type\": \"string\", \"minLength\": 1, \"maxLength\": {longest}"),
        Form::Texts | Form::Objects => "\"type\": \"array\", \"items\": { \"type\": \"string\" }".to_owned(),
        Form::Values => {
            "\"type\": \"object\", \"additionalProperties\": { \"type\": [\"number\", \"string\", \"boolean\"] }"
                .to_owned()
        }
        Form::ValuesOr(section) => {
            let _ = writeln!(text, "{indent}\"type\": \"object\",\n{indent}\"additionalProperties\": {{");
            let _ = writeln!(text, "{indent}  \"type\": [\"integer\", \"string\", \"object\"],");
            properties(text, section, depth + 1);
            let _ = writeln!(text, "{indent}}}");
            return;
        }
        Form::IntegerOrText => "\"type\": [\"integer\", \"string\"]".to_owned(),
        Form::Ignored => "\"type\": [\"number\", \"string\", \"boolean\", \"object\", \"array\"]".to_owned(),
        Form::Table(section) => return object(text, section, depth),
        Form::Named(section) => {
            let _ = writeln!(text, "{indent}\"type\": \"object\",\n{indent}\"additionalProperties\": {{");
            object(text, section, depth + 1);
            let _ = writeln!(text, "{indent}}}");
            return;
        }
    };
    let _ = writeln!(text, "{indent}{members}");
}
