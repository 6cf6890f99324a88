//! Exports all ESI files of the corpus and reads the exports. An export must have the same IR as its original, with the
//! exceptions in this test. All exports must be valid against ETG's schema, even if the original is not.

use std::collections::BTreeMap;
use std::sync::OnceLock;

use crate::corpus_support::round_trip::{content, difference, each_object, options, source, take_extensions};
use crate::corpus_support::xsd::Schema;
use crate::corpus_support::{files, files_of, lane};
use lexibus_codegen::compile::read;
use lexibus_codegen::ir::{Catalog, Device, Item};
use lexibus_codegen::source::Source;
use lexibus_export::esi::{export, NoteKind, Options, Refusal};
use lexibus_export::Export;
use serde_json::Value;

/// Removes differences that the comparison ignores. The comments in the function state the reasons.
fn comparable(before: &mut Value, after: &mut Value) {
    for value in [&mut *before, &mut *after] {
        each_object(value, &mut |fields| {
            // `described` counts the items that are described in the object and not in its data type. An export may
            // move a description between the object and its data type.
            fields.remove("described");
            // The exported file stores a REAL as 32 bits, but its text in the original can have more digits.
            if let Some(real) = fields.get_mut("real").filter(|real| real.is_f64()) {
                *real = Value::from(real.as_f64().unwrap_or_default() as f32);
            }
        });
    }
    // An export can add types, because the schema requires a definition of each used type and a record type for each
    // object with sub-indices.
    for list in ["devices", "modules"] {
        let (Some(before), Some(after)) = (before[list].as_array_mut(), after[list].as_array_mut()) else { continue };
        for (one, other) in before.iter_mut().zip(after) {
            let count = one["types"].as_array().map_or(0, Vec::len);
            if let Some(types) = other["types"].as_array_mut() {
                types.truncate(count);
            }
        }
    }
}

fn noted(exported: &Export, kind: NoteKind) -> usize {
    exported.notes.iter().filter(|note| note.kind == kind).map(|note| note.count).sum()
}

/// Removes differences that the notes count: units for which ESI has no code, and numeric suffixes that make the names
/// of types and sub-items unique. Returns how many units and names were changed.
fn take_noted(before: &mut Value, after: &mut Value) -> (usize, usize) {
    let add = |sum: (usize, usize), more: (usize, usize)| (sum.0 + more.0, sum.1 + more.1);
    match (before, after) {
        (Value::Object(one), Value::Object(other)) => {
            let is_lost = one.get("quantity").is_some_and(|quantity| !quantity.is_null())
                && other.get("quantity").is_some_and(Value::is_null);
            if is_lost {
                one.insert("quantity".into(), Value::Null);
            }
            let names = [&*one, &*other].map(|fields| fields.get("name").and_then(Value::as_str).map(str::to_owned));
            let is_numbered =
                matches!(&names, [Some(original), Some(name)] if name.starts_with(&format!("{original} (")));
            if is_numbered {
                other.insert("name".into(), names[0].clone().into());
            }
            let inner = one.iter_mut().filter_map(|(key, value)| Some(take_noted(value, other.get_mut(key)?)));
            inner.fold((usize::from(is_lost), usize::from(is_numbered)), add)
        }
        (Value::Array(one), Value::Array(other)) => {
            one.iter_mut().zip(other).map(|(one, other)| take_noted(one, other)).fold((0, 0), add)
        }
        _ => (0, 0),
    }
}

/// Removes devices of other vendors. An export leaves them out because a file can have only one vendor.
fn take_other_vendors(before: &mut Value) -> usize {
    let Some(devices) = before["devices"].as_array_mut() else { return 0 };
    let vendor = devices.first().map_or(Value::Null, |device| device["identity"]["vendor_id"].clone());
    let count = devices.len();
    devices.retain(|device| device["identity"]["vendor_id"] == vendor);
    count - devices.len()
}

/// Reads the export of `catalog`, compares the result with `catalog`, and exports the result again. Returns a message about
/// the first check that fails, or `None` if all checks pass. Losses that the notes count are expected.
fn check(catalog: &Catalog, exported: &Export) -> Option<String> {
    let again = read(Source::new("export.xml", exported.text.clone().into()), &options());
    let Some(found) = &again.catalog else { return Some("the export cannot be read".into()) };
    let [mut before, mut after] = [catalog, found].map(content);
    let vendors = take_other_vendors(&mut before);
    let (original_keys, exported_keys) = (take_extensions(&mut before), take_extensions(&mut after));
    comparable(&mut before, &mut after);
    let (units, names) = take_noted(&mut before, &mut after);
    let counts = [NoteKind::Quantity, NoteKind::Renamed, NoteKind::OtherVendor].map(|kind| noted(exported, kind));
    if units != counts[0] || names > counts[1] || vendors != counts[2] {
        return Some(format!(
            "{units} units, {names} names and {vendors} devices are lost, but the notes count {counts:?}"
        ));
    }
    if let Some(difference) = difference(&before, &after, "") {
        return Some(difference);
    }
    // The exported file must contain each extension attribute, or a note must count it.
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

/// Returns the name, catalog and export of each ESI file of the corpus that can be read. Returns `None` if the corpus
/// is missing.
fn exports() -> Option<&'static Vec<(String, Catalog, Export)>> {
    static EXPORTS: OnceLock<Option<Vec<(String, Catalog, Export)>>> = OnceLock::new();
    EXPORTS.get_or_init(make_exports).as_ref()
}

fn make_exports() -> Option<Vec<(String, Catalog, Export)>> {
    let mut exports = Vec::new();
    for file in files_of("esi")? {
        let Some(catalog) = read(source(&file), &options()).catalog else { continue };
        let exported = export(&catalog, &Options::default());
        exports.push((
            file.name.clone(),
            catalog,
            exported.unwrap_or_else(|refusal| panic!("{}: {refusal}", file.name)),
        ));
    }
    assert!(exports.len() > lane::at_least(130), "only {} files of the corpus are exported", exports.len());
    Some(exports)
}

#[test]
fn esi_to_ir_to_esi_to_ir_is_the_identity() {
    let Some(exports) = exports() else { return };
    let mut kinds: BTreeMap<&str, usize> = BTreeMap::new();
    let mut wrong = Vec::new();
    for (name, catalog, exported) in exports {
        exported.notes.iter().for_each(|note| *kinds.entry(note.kind.name()).or_default() += note.count);
        wrong.extend(check(catalog, exported).map(|message| format!("{name}: {message}")));
    }
    eprintln!(
        "{} of {} files are the same; left out or changed: {kinds:?}",
        exports.len() - wrong.len(),
        exports.len()
    );
    assert!(wrong.is_empty(), "{} wrong:\n{}", wrong.len(), wrong.join("\n"));
}

/// Returns facts that an ESI requires and the description of a CANopen device can lack.
fn of_a_slave() -> Options {
    let mut options = Options::default();
    let facts = [
        ("vendor-id", "0x1"),
        ("vendor-name", "Example"),
        ("product-code", "1"),
        ("revision", "1"),
        ("order-code", "X"),
        ("physics", "YY"),
        ("group", "Devices"),
        ("mailbox-out", "0x1000:128"),
        ("mailbox-in", "0x1080:128"),
        ("outputs", "0x1100"),
        ("inputs", "0x1180"),
        ("coe", "sdo-info"),
    ];
    facts.iter().for_each(|(key, value)| options.set(key, value).expect("an option"));
    options
}

/// Returns the entries of a CANopen device that its ESI omits or changes. If `kinds` contains [`NoteKind::CanObject`],
/// ignores objects that the ESI omits completely.
fn lost_entries(before: &Device, after: &Device, kinds: &[NoteKind]) -> Vec<String> {
    let mut lost = Vec::new();
    for item in before.groups.iter().flat_map(|group| &group.items) {
        let Some((index, sub)) = item.object() else { continue };
        let Some(found) = after.entry(index, sub) else {
            if after.object(index).is_some() || !kinds.contains(&NoteKind::CanObject) {
                lost.push(format!("{index:04X}:{sub:02X} is lost"));
            }
            continue;
        };
        let access = |item: &Item| (item.access.readable(), item.access.writable(), item.mappable);
        // In the ESI, an entry without a name gets the name that its data type defines.
        let is_same = (item.name.is_empty() || found.name == item.name) && access(found) == access(item);
        let is_whole = matches!(item.default, Some(lexibus_codegen::ir::Value::Int(_))) && found.ty == item.ty;
        if !is_same || is_whole && found.default != item.default {
            lost.push(format!("{index:04X}:{sub:02X}: {item:?} became {found:?}"));
        }
    }
    lost
}

#[test]
fn canopen_devices_have_valid_dictionaries() {
    let Some(files) = files() else { return };
    let (mut texts, mut wrong) = (Vec::new(), Vec::new());
    for file in files {
        let Some(catalog) = read(source(&file), &options()).catalog else { continue };
        let exported = match export(&catalog, &of_a_slave()) {
            Ok(exported) => exported,
            Err(Refusal::Nothing) => continue,
            Err(refusal) => panic!("{}: {refusal}", file.name),
        };
        let again = read(Source::new("export.xml", exported.text.clone().into()), &options());
        let kinds: Vec<NoteKind> = exported.notes.iter().map(|note| note.kind).collect();
        match again.catalog.as_ref().and_then(|catalog| catalog.devices.first()) {
            Some(device) => {
                let lost = lost_entries(&catalog.devices[0], device, &kinds);
                wrong.extend(lost.into_iter().map(|lost| format!("{}: {lost}", file.name)));
            }
            None => wrong.push(format!("{}: the export cannot be read", file.name)),
        }
        texts.push((file.name, exported.text));
    }
    eprintln!("{} CANopen devices have an ESI", texts.len());
    assert!(
        texts.len() > lane::at_least(250) && wrong.is_empty(),
        "{} wrong:\n{}",
        wrong.len(),
        wrong[..wrong.len().min(40)].join("\n")
    );
    let Some(schema) = Schema::new("esi/EtherCATInfo.xsd") else { return };
    let named = texts.iter().map(|(name, text)| (name.as_str(), text.as_bytes()));
    let violations = schema.violations("canopen", named);
    assert!(
        violations.is_empty(),
        "{} violations:\n{}",
        violations.len(),
        violations[..violations.len().min(40)].join("\n")
    );
}

#[test]
fn exports_are_valid() {
    let Some(exports) = exports() else { return };
    for (root, schema) in [
        ("<EtherCATInfo", "esi/EtherCATInfo.xsd"),
        ("<EtherCATDict", "esi/EtherCATDict.xsd"),
        ("<EtherCATDiag", "esi/EtherCATDiag.xsd"),
    ] {
        let Some(schema) = Schema::new(schema) else { return };
        let has_root = |text: &str| text.lines().nth(1).is_some_and(|line| line.starts_with(root));
        let with_root = exports.iter().filter(|(_, _, exported)| has_root(&exported.text));
        let with_root: Vec<(&str, &[u8])> =
            with_root.map(|(name, _, exported)| (name.as_str(), exported.text.as_bytes())).collect();
        assert!(!with_root.is_empty() || !lane::is_full(), "no export has the root {root}>");
        let violations = schema.violations(&root[1..], with_root.iter().copied());
        eprintln!("{} files with the root {root}>", with_root.len());
        assert!(violations.is_empty(), "{} violations:\n{}", violations.len(), violations.join("\n"));
    }
}
