//! Reads the dictionaries of the repository and their `doubt` entries.

#[allow(clippy::duplicate_mod, reason = "a program may load several modules that look for the repository")]
#[path = "../../../tests/support/root.rs"]
mod root;

use std::collections::BTreeSet;

use lexibus_codegen::compile::{check, Options};
use lexibus_codegen::ir::{Catalog, Doubt};
use lexibus_codegen::source::Source;
use serde_json::Value;

/// Compiles the dictionary with this file name.
pub fn catalog(file: &str) -> Catalog {
    let path = root::root().join("dictionaries").join(file);
    let bytes = std::fs::read(path).expect("the dictionary");
    check(Source::new(file, bytes), &Options::default()).catalog.expect("a catalog")
}

/// Returns all `doubt` entries in the intermediate representation.
pub fn doubts(catalog: &Catalog) -> Vec<Doubt> {
    let mut found = Vec::new();
    collect(&serde_json::to_value(catalog).expect("JSON"), &mut found);
    found
}

fn collect(value: &Value, found: &mut Vec<Doubt>) {
    match value {
        Value::Object(fields) => {
            for (key, field) in fields {
                if key == "doubts" {
                    let doubts: Vec<Doubt> = serde_json::from_value(field.clone()).expect("doubts");
                    found.extend(doubts);
                } else {
                    collect(field, found);
                }
            }
        }
        Value::Array(list) => list.iter().for_each(|element| collect(element, found)),
        _ => {}
    }
}

/// Returns the line numbers in a citation such as `12, 40-44`.
pub fn lines(cite: &str) -> BTreeSet<usize> {
    let mut lines = BTreeSet::new();
    for part in cite.split(',') {
        let mut ends = part.split('-').map(|number| number.trim().parse::<usize>().ok());
        if let Some(Some(first)) = ends.next() {
            lines.extend(first..=ends.next().flatten().unwrap_or(first));
        }
    }
    lines
}
