//! Exports all GSDML files of the corpus and reads the exports. An export must have the same IR as its original, with
//! the exceptions in this test. The export of a valid file must be valid against PI's schema.

use std::collections::BTreeMap;

use crate::corpus_support::round_trip::{content, difference, each_object, options, source, take_extensions};
use crate::corpus_support::xsd::Schema;
use crate::corpus_support::{files_of, lane, File};
use lexibus_codegen::compile::read;
use lexibus_codegen::ir::Catalog;
use lexibus_codegen::source::Source;
use lexibus_export::gsdml::{export, file_name, NoteKind, Options};
use lexibus_export::Export;
use serde_json::Value;

/// Normalizes facts whose differences the comparison ignores. The comments in the function state the reasons.
fn comparable(value: &mut Value) {
    // Sort the diagnosis lists, because the export writes them in the order of the schema.
    if let Some(tables) = value["code_tables"].as_array_mut() {
        tables.sort_by_key(|table| table["name"].to_string());
    }
    each_object(value, &mut |fields| {
        // The order of attributes, and of the elements that contain them, has no meaning.
        if let Some(Value::Array(list)) = fields.get_mut("attributes") {
            list.sort_by_key(ToString::to_string);
        }
        // The export declares a schema version even if the source does not.
        if let Some(version) = fields.get_mut("format_version").filter(|version| version.as_str() == Some("")) {
            *version = "2.35".into();
        }
    });
}

fn noted(exported: &Export, kind: NoteKind) -> usize {
    exported.notes.iter().filter(|note| note.kind == kind).map(|note| note.count).sum()
}

/// Returns the first difference between `catalog` and its reread export, or `None` if there is none.
fn check(catalog: &Catalog, exported: &Export) -> Option<String> {
    let name = file_name(catalog, &Options::default()).unwrap_or_else(|| "export".into()) + ".xml";
    let again = read(Source::new(name.as_str(), exported.text.clone().into()), &options());
    let Some(found) = &again.catalog else { return Some("the export cannot be read".into()) };
    let [mut before, mut after] = [catalog, found].map(content);
    let (original_keys, exported_keys) = (take_extensions(&mut before), take_extensions(&mut after));
    comparable(&mut before);
    comparable(&mut after);
    take_added_header(&before["profile_header"], &mut after["profile_header"]);
    if let Some(difference) = difference(&before, &after, "") {
        return Some(difference);
    }
    let missing: usize = original_keys
        .iter()
        .map(|(key, count)| count.saturating_sub(exported_keys.get(key).copied().unwrap_or(0)))
        .sum();
    let new = exported_keys.iter().find(|(key, count)| original_keys.get(key).is_none_or(|before| before < count));
    if let Some((key, _)) = new {
        return Some(format!("{key:?} wasn't there before"));
    }
    let count = noted(exported, NoteKind::Extension);
    if missing != count {
        return Some(format!("{missing} extension attributes are lost, and the notes count {count}"));
    }
    match export(found, &Options::default()) {
        Ok(second) if second.text == exported.text => None,
        _ => Some("the second export differs".into()),
    }
}

/// Removes the parts of the header that the export adds because the schema requires them. They are equal in all files.
fn take_added_header(before: &Value, after: &mut Value) {
    for (name, text) in after.as_object_mut().into_iter().flatten() {
        if before[name.as_str()] == "" {
            *text = "".into();
        }
    }
}

/// Returns all files that Lexibus can export, with their exports.
fn exports() -> Option<Vec<(File, Catalog, Export)>> {
    let mut exports = Vec::new();
    for file in files_of("gsdml")? {
        let Some(catalog) = read(source(&file), &options()).catalog else { continue };
        // One file of the corpus describes neither devices nor modules.
        if catalog.devices.is_empty() && catalog.modules.is_empty() {
            continue;
        }
        let exported = export(&catalog, &Options::default());
        let exported = exported.unwrap_or_else(|refusal| panic!("{}: {refusal}", file.name));
        exports.push((file, catalog, exported));
    }
    assert!(exports.len() > lane::at_least(70), "only {} files of the corpus are exported", exports.len());
    Some(exports)
}

#[test]
fn gsdml_to_ir_to_gsdml_to_ir_is_the_identity() {
    let Some(exports) = exports() else { return };
    let mut kinds: BTreeMap<&str, usize> = BTreeMap::new();
    let mut wrong = Vec::new();
    for (file, catalog, exported) in &exports {
        exported.notes.iter().for_each(|note| *kinds.entry(note.kind.name()).or_default() += note.count);
        wrong.extend(check(catalog, exported).map(|message| format!("{}: {message}", file.name)));
    }
    eprintln!(
        "{} of {} files are the same; left out or changed: {kinds:?}",
        exports.len() - wrong.len(),
        exports.len()
    );
    assert!(wrong.is_empty(), "{} wrong:\n{}", wrong.len(), wrong.join("\n"));
}

#[test]
fn exports_of_valid_files_are_valid() {
    let (Some(exports), Some(schema)) = (exports(), Schema::new("gsdml/GSDML-DeviceProfile-v2.35.xsd")) else { return };
    let originals: Vec<String> = exports.iter().map(|(file, ..)| without_declaration(&file.text())).collect();
    let named = exports.iter().zip(&originals).map(|((file, ..), text)| (file.name.as_str(), text.as_bytes()));
    let violations = schema.violations("originals", named);
    let is_valid = |name: &str| !violations.iter().any(|line| line.starts_with(&format!("{name}: ")));
    let valid: Vec<&(File, Catalog, Export)> = exports.iter().filter(|(file, ..)| is_valid(&file.name)).collect();
    eprintln!("{} of {} files are valid by V2.35", valid.len(), exports.len());
    assert!(valid.len() > lane::at_least(20), "only {} files are valid", valid.len());
    let named = valid.iter().map(|(file, _, exported)| (file.name.as_str(), exported.text.as_bytes()));
    let violations = schema.violations("exports", named);
    assert!(violations.is_empty(), "{} violations:\n{}", violations.len(), violations.join("\n"));
}

/// Returns the text without its XML declaration. A decoded text is UTF-8, even if its declaration names another
/// encoding.
fn without_declaration(text: &str) -> String {
    let text = text.trim_start();
    match text.strip_prefix("<?xml").and_then(|rest| rest.split_once("?>")) {
        Some((_, rest)) => rest.to_owned(),
        None => text.to_owned(),
    }
}
