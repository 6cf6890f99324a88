//! Exports all EDS files of the corpus and reads the exports. An export must have the same IR as its original.
//!
//! The comparison ignores positions in the file and facts about the file (name, digest). The exported file must have no
//! new diagnostics.

use std::collections::BTreeMap;

use crate::corpus_support::round_trip::{content, counts, difference, options, source};
use crate::corpus_support::{files, files_of, lane, File};
use lexibus_codegen::compile::{check as compile, read, Compilation};
use lexibus_codegen::diagnostics::Severity;
use lexibus_codegen::ir::{self, Catalog, Device, Type};
use lexibus_codegen::source::Source;
use lexibus_export::eds::{export, Export, Flavor};
use serde_json::Value;

/// Codes of diagnostics that the export of a file may cause although the original does not cause them, with the reason.
const MAY_APPEAR: [(&str, &str); 0] = [];

/// Removes facts that only a DCF can contain.
fn without_configuration(value: &mut Value) {
    match value {
        Value::Object(fields) => {
            for name in ["commissioning", "configured", "serial_number"] {
                fields.entry(name).and_modify(|value| *value = Value::Null);
            }
            fields.entry("last_eds").and_modify(|value| *value = "".into());
            fields.values_mut().for_each(without_configuration);
        }
        Value::Array(list) => {
            let key = |value: &Value| value["key"].as_str().unwrap_or_default().to_owned();
            list.retain(|value| !key(value).starts_with("DeviceComissioning/"));
            list.retain(|value| !key(value).starts_with("ConnectedModules/"));
            list.iter_mut().for_each(without_configuration);
        }
        _ => {}
    }
}

fn exported(compilation: &Compilation, flavor: Flavor) -> Export {
    let catalog = compilation.catalog.as_ref().expect("a catalog");
    export(catalog, &catalog.devices[0], flavor).expect("a CANopen device has an EDS")
}

/// Compares the export of a file as EDS or DCF with its original. Returns the differences.
fn check(file: &File, original: &Compilation, flavor: Flavor) -> Vec<String> {
    let options = options();
    let Export { text, .. } = exported(original, flavor);
    let ending = if flavor == Flavor::Dcf { "dcf" } else { "eds" };
    let name = format!("export.{ending}");
    let again = read(Source::new(name.as_str(), text.clone().into()), &options);
    let mut wrong = Vec::new();
    let mut say = |message: String| wrong.push(format!("{} as {ending}: {message}", file.name));
    let Some(catalog) = &again.catalog else {
        say("the export cannot be read".into());
        return wrong;
    };
    let mut before = content(&without_swapped_limits(original.catalog.as_ref().expect("a catalog")));
    if flavor == Flavor::Eds {
        without_configuration(&mut before);
    }
    if let Some(difference) = difference(&before, &content(catalog), "") {
        say(difference);
    }
    let known = counts(original);
    for (code, count) in counts(&again) {
        let was = known.get(code).copied().unwrap_or(0);
        if count > was && !MAY_APPEAR.iter().any(|(may, _)| *may == code) {
            let first = again.diagnostics.list().iter().find(|found| found.code.id == code).expect("a finding");
            say(format!("{code} {was} times before, {count} times now: {}", again.one_line(first)));
        }
    }
    if exported(&again, flavor).text != text {
        say("the second export differs".into());
    }
    for line in text.split_inclusive('\n').filter(|line| !line.ends_with("\r\n")) {
        say(format!("a line does not end with CR LF: {line:?}"));
    }
    if flavor == Flavor::Dcf {
        wrong.extend(check_passes(file, &text));
    }
    wrong
}

/// Removes swapped limits, which an export leaves out.
fn without_swapped_limits(catalog: &Catalog) -> Catalog {
    let mut catalog = catalog.clone();
    let lists = catalog.devices.iter_mut().map(|device| &mut device.groups);
    for item in lists.flatten().flat_map(|group| &mut group.items) {
        if item.limits.are_swapped(item.ty) {
            (item.limits.low, item.limits.high) = (None, None);
        }
    }
    catalog
}

/// Checks that a file and its export cause the same diagnostics, and that exporting either of them gives the same text.
fn check_passes(file: &File, text: &str) -> Vec<String> {
    let options = options();
    let (first, second) = (compile(source(file), &options), compile(Source::new("export.dcf", text.into()), &options));
    let findings = |compilation: &Compilation| -> Vec<String> {
        // Ignore diagnostics about the notation of the original text, because the IR and therefore the export do not
        // contain the notation.
        let is_of_the_text = |id: &str| id.starts_with("EDS") || id == "TAB012";
        let findings = compilation.diagnostics.list().iter().filter(|found| !is_of_the_text(found.code.id));
        let mut findings: Vec<String> = findings.map(|found| format!("{} {}", found.code.id, found.message)).collect();
        findings.sort();
        findings
    };
    let mut wrong = Vec::new();
    if findings(&first) != findings(&second) {
        wrong.push(format!("{}: {:?} and {:?}", file.name, findings(&first), findings(&second)));
    }
    if exported(&first, Flavor::Dcf).text != exported(&second, Flavor::Dcf).text {
        wrong.push(format!("{}: the export of the checked device differs", file.name));
    }
    wrong
}

#[test]
fn eds_to_ir_to_eds_to_ir_is_the_identity() {
    let Some(files) = files() else { return };
    let (mut total, mut identical, mut wrong) = (0, 0, Vec::new());
    for file in files.iter().filter(|file| !file.is_xml()) {
        let original = read(source(file), &options());
        if original.catalog.is_none() {
            continue;
        }
        total += 1;
        let before = wrong.len();
        wrong.extend(check(file, &original, Flavor::Dcf));
        wrong.extend(check(file, &original, Flavor::Eds));
        identical += usize::from(wrong.len() == before);
    }
    eprintln!("{identical} of {total} files are identical after export");
    assert!(total > lane::at_least(200), "only {total} files");
    assert!(wrong.is_empty(), "{} wrong:\n{}", wrong.len(), wrong.join("\n"));
}

/// Compares the entries of a device with those of its exported DCF, except for facts that a DCF cannot express.
fn compare_items(device: &Device, again: &Device, wrong: &mut Vec<String>) {
    for item in device.groups.iter().flat_map(|group| &group.items) {
        let Some((index, sub)) = item.object() else { continue };
        let Some(found) = again.entry(index, sub) else {
            wrong.push(format!("{index:04X}:{sub:02X} is lost"));
            continue;
        };
        let mut check = |what: &str, holds: bool| {
            if !holds {
                wrong.push(format!("{index:04X}:{sub:02X}: {what}: {item:?} became {found:?}"));
            }
        };
        let (access, as_before) = (found.access, item.access);
        check("access", access.readable() == as_before.readable() && access.writable() == as_before.writable());
        check("mapping", !item.mappable.any() || found.mappable.any() || !as_before.writable());
        let is_kept = item.ty == found.ty && !matches!(item.ty, Type::Opaque(_) | Type::Domain);
        check("default", !is_kept || item.default == found.default);
        let is_whole = |value: &Option<ir::Value>| !matches!(value, Some(ir::Value::Real(_)));
        check("low", !is_kept || !is_whole(&item.limits.low) || item.limits.low == found.limits.low);
        check("high", !is_kept || !is_whole(&item.limits.high) || item.limits.high == found.limits.high);
    }
}

#[test]
fn devices_of_other_formats_have_the_same_entries() {
    let (Some(files), Some(esi)) = (files(), files_of("esi")) else { return };
    let xml = files.into_iter().filter(File::is_xml).chain(esi);
    let (mut devices, mut kinds, mut wrong) = (0, BTreeMap::new(), Vec::new());
    for file in xml {
        let compilation = compile(source(&file), &options());
        let Some(catalog) = &compilation.catalog else { continue };
        // Files with hundreds of devices repeat the same objects, so a few devices are sufficient.
        for device in catalog.devices.iter().filter(|device| !device.groups.is_empty()).take(3) {
            let Some(exported) = export(catalog, device, Flavor::Dcf) else { continue };
            devices += 1;
            let again = read(Source::new("export.dcf", exported.text.into()), &options());
            let mut found = Vec::new();
            if again.diagnostics.has_errors() {
                let errors = again.diagnostics.list().iter().filter(|found| found.severity == Severity::Error);
                found.extend(errors.map(|error| again.one_line(error)));
            }
            compare_items(device, &again.catalog.as_ref().expect("a device").devices[0], &mut found);
            wrong.extend(found.into_iter().map(|found| format!("{}: {}: {found}", file.name, device.name)));
            exported.notes.iter().for_each(|note| *kinds.entry(note.kind.name()).or_default() += note.count);
        }
    }
    let kinds: BTreeMap<&str, usize> = kinds;
    eprintln!("{devices} devices of other formats; left out or changed: {kinds:?}");
    assert!(devices > lane::at_least(150), "only {devices} devices");
    assert!(wrong.is_empty(), "{} wrong:\n{}", wrong.len(), wrong[..wrong.len().min(40)].join("\n"));
}
