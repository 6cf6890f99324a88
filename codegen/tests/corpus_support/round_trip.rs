//! Compares the IR of an exported file with the IR of the original file.

use std::collections::BTreeMap;

use lexibus_codegen::compile::{Compilation, Options};
use lexibus_codegen::ir::Catalog;
use lexibus_codegen::source::Source;
use serde_json::Value;

use super::File;

/// Returns options for reading a file without the facts that profiles add.
pub fn options() -> Options {
    Options { no_profiles: true, ..Options::default() }
}

pub fn source(file: &File) -> Source {
    Source::new(file.name.as_str(), file.bytes.clone())
}

/// Returns the IR as JSON, without positions and without the list of files. Also removes each origin that is a rule for missing
/// keys, compact sub-indices or object types. An export writes these facts as keys, so they lose this origin.
pub fn content(catalog: &Catalog) -> Value {
    let mut value = serde_json::to_value(catalog).expect("JSON");
    value["files"] = Value::Null;
    each_object(&mut value, &mut |fields| {
        fields.retain(|name, _| !matches!(name.as_str(), "origin" | "span" | "at" | "name_at"));
        if let Some(origins) = fields.get_mut("origins").and_then(Value::as_array_mut) {
            let is_written =
                |rule: &Value| matches!(rule.as_str(), Some("missing_key" | "compact_object" | "object_contents"));
            origins.retain(|origin| !is_written(&origin[1]["rule"]));
        }
        fields.retain(|name, value| name != "origins" || value.as_array().is_none_or(|origins| !origins.is_empty()));
    });
    value
}

/// Calls `change` for all JSON objects. Outer objects come before inner objects.
pub fn each_object(value: &mut Value, change: &mut impl FnMut(&mut serde_json::Map<String, Value>)) {
    match value {
        Value::Object(fields) => {
            change(fields);
            fields.values_mut().for_each(|value| each_object(value, change));
        }
        Value::Array(list) => list.iter_mut().for_each(|value| each_object(value, change)),
        _ => {}
    }
}

/// Returns a description of the first difference between two JSON values.
pub fn difference(left: &Value, right: &Value, path: &str) -> Option<String> {
    match (left, right) {
        (Value::Object(a), Value::Object(b)) if a.keys().eq(b.keys()) => {
            a.iter().find_map(|(key, value)| difference(value, &b[key], &format!("{path}.{key}")))
        }
        (Value::Array(a), Value::Array(b)) => {
            let pairs = a.iter().zip(b).enumerate();
            let inner = pairs.into_iter().find_map(|(at, (a, b))| difference(a, b, &format!("{path}[{at}]")));
            inner.or_else(|| (a.len() != b.len()).then(|| format!("{path}: {} and {} elements", a.len(), b.len())))
        }
        _ if left == right => None,
        _ => {
            let short = |value: &Value| value.to_string().chars().take(300).collect::<String>();
            Some(format!("{path}: {} became {}", short(left), short(right)))
        }
    }
}

/// Returns the number of diagnostics with each code.
pub fn counts(compilation: &Compilation) -> BTreeMap<&'static str, usize> {
    let mut counts = BTreeMap::new();
    compilation.diagnostics.list().iter().for_each(|found| *counts.entry(found.code.id).or_default() += 1);
    counts
}

/// Removes all extension attributes. Returns how often each attribute occurred.
pub fn take_extensions(value: &mut Value) -> BTreeMap<(String, String), usize> {
    let mut removed = BTreeMap::new();
    each_object(value, &mut |fields| {
        let Some(Value::Array(list)) = fields.insert("extensions".into(), Value::Null).filter(|old| !old.is_null())
        else {
            fields.remove("extensions");
            return;
        };
        for extension in list {
            let text = |name: &str| extension[name].as_str().unwrap_or_default().to_owned();
            *removed.entry((text("key"), text("value"))).or_default() += 1;
        }
    });
    removed
}
