//! Compares the results for the ESI files of the corpus with the counts that a simple script has determined (`oracle.json`).
//!
//! The corpus is not part of the repository. If the corpus is missing, the tests print a message and pass.

use crate::corpus_support;

use corpus_support::{folder_of, lane};
use lexibus_codegen::compile::{check, read, Compilation, Options};
use lexibus_codegen::diagnostics::{Diagnostic, Severity};
use lexibus_codegen::ir::{
    Catalog, Device, Direction, EtherCatSettings, Group, Module, Pdo, ProcessData, Shape, TypeDef,
};
use lexibus_codegen::source::Source;
use serde_json::Value;

/// A file with the results of the script and the compiler.
struct Case {
    name: String,
    oracle: Value,
    read: Compilation,
}

impl Case {
    fn catalog(&self) -> &Catalog {
        self.read.catalog.as_ref().unwrap_or_else(|| panic!("{}: no catalog", self.name))
    }

    fn errors(&self) -> Vec<&Diagnostic> {
        self.read.diagnostics.list().iter().filter(|found| found.severity == Severity::Error).collect()
    }

    fn line(&self, found: &Diagnostic) -> u32 {
        self.read.sources[found.span.file.0 as usize].position(found.span.start).line
    }

    fn one_line(&self, found: &Diagnostic) -> String {
        self.read.one_line(found)
    }
}

/// Compiles the files of the current lane from memory, so that the compiler does not find the files to which they refer.
fn cases() -> Option<Vec<Case>> {
    let folder = folder_of("esi")?;
    let text = std::fs::read_to_string(folder.join("oracle.json")).expect("the oracle");
    let oracle: Value = serde_json::from_str(&text).expect("JSON");
    let oracle = oracle.as_object().expect("an object");
    assert!(oracle.len() >= 138, "only {} files are in the corpus", oracle.len());
    let is_read = |(name, _): &(&String, &Value)| corpus_support::is_read("esi", name);
    let case = |(name, oracle): (&String, &Value)| {
        let bytes = std::fs::read(folder.join(name)).expect("a file of the corpus");
        let read = read(Source::new(name.as_str(), bytes), &Options::default());
        Case { name: name.clone(), oracle: oracle.clone(), read }
    };
    Some(oracle.iter().filter(is_read).map(case).collect())
}

#[test]
fn files_are_read_without_errors() {
    let Some(cases) = cases() else { return };
    for case in &cases {
        let errors: Vec<String> = case.errors().iter().map(|error| case.one_line(error)).collect();
        assert!(errors.is_empty() && case.read.is_usable(), "{}: {errors:#?}", case.name);
    }
}

/// The script's parser rejects three files that the compiler repairs. The files contain text after the root element, a `&` that
/// does not start a reference, or a byte that the declared encoding lacks. The compiler must report the same lines as the parser.
#[test]
fn what_is_not_well_formed_is_reported_at_its_line() {
    let Some(cases) = cases() else { return };
    let mut found = Vec::new();
    for case in cases.iter().filter(|case| case.oracle["wellformed"] == Value::Bool(false)) {
        let error = case.oracle["error"].as_str().expect("a message of the parser");
        let line = error.split("line ").nth(1).and_then(|rest| rest.split(',').next()).expect("a line");
        let repairs = case.read.diagnostics.list().iter().filter(|found| found.code.id.starts_with("XML"));
        let repairs: Vec<_> = repairs.map(|found| (found.code.id, case.line(found).to_string())).collect();
        let [(code, repaired)] = &repairs[..] else { panic!("{}: {repairs:?}", case.name) };
        assert_eq!(repaired, line, "{}", case.name);
        found.push(*code);
    }
    assert_eq!(found, ["XML004", "XML003", "XML002"]);
}

/// A truncated file must cause an error with a position. The compiler must not return a catalog for a truncated file.
#[test]
fn files_that_are_cut_off_are_errors() {
    let Some(cases) = cases() else { return };
    for case in cases.iter().filter(|case| case.read.sources[0].text().len() < 20_000) {
        let text = case.read.sources[0].text().trim_end();
        let end = (0..text.len() * 2 / 3).rev().find(|&end| text.is_char_boundary(end)).unwrap_or(0);
        let cut = read(Source::new("cut.xml", text.as_bytes()[..end].to_vec()), &Options::default());
        assert!(cut.catalog.is_none(), "{}", case.name);
        let errors = cut.diagnostics.list().iter().filter(|found| found.severity == Severity::Error);
        let errors: Vec<_> = errors.map(|error| (error.code.id, error.span.is_empty())).collect();
        assert_eq!(errors, [("XML001", false)], "{}", case.name);
    }
}

/// Compares a text from the script with a text from the compiler. The script keeps surrounding whitespace and does not decode
/// characters outside the declared encoding.
fn same_text(oracle: &Value, value: &Value) -> bool {
    let (Some(oracle), Some(value)) = (oracle.as_str(), value.as_str()) else { return false };
    let same = |(one, other): (char, char)| one == other || one == char::REPLACEMENT_CHARACTER;
    oracle.trim().chars().count() == value.chars().count() && oracle.trim().chars().zip(value.chars()).all(same)
}

/// The script's names and counts for an element of a file, and all mismatches with the compiler.
struct Counts<'c> {
    oracle: &'c Value,
    /// Descriptions of all mismatches, which are reported together.
    wrong: Vec<String>,
}

impl Counts<'_> {
    fn same(&mut self, key: &str, actual: impl Into<Value>) {
        let actual = actual.into();
        if !same_text(&self.oracle[key], &actual) && self.oracle[key] != actual {
            self.wrong.push(format!("{key}: {} in the oracle, {actual} in the compiler", self.oracle[key]));
        }
    }

    fn dictionary(&mut self, groups: &[Group], types: &[TypeDef], twice: Twice) {
        // Types that are derived from a name and types that `check` adds have no line.
        let types = types.iter().filter(|def| def.origin.line > 0);
        self.same("n_objects", groups.len() + twice.objects);
        self.same("n_datatypes", types.clone().count());
        let fields = types.map(|def| match &def.shape {
            Shape::Record(fields) => fields.len(),
            _ => 0,
        });
        self.same("n_datatype_subitems", fields.sum::<usize>());
        self.same("n_subitems", groups.iter().map(|group| group.described as usize).sum::<usize>() + twice.subs);
    }

    fn pdos(&mut self, data: &ProcessData) {
        for (key, direction) in [("rx_pdos", Direction::Receive), ("tx_pdos", Direction::Transmit)] {
            let pdos = data.pdos.iter().filter(|pdo| pdo.direction == direction);
            let triple = |pdo: &Pdo| serde_json::json!([pdo.mapping_index, pdo.entries.len(), pdo.bits()]);
            self.same(key, pdos.map(triple).collect::<Vec<_>>());
        }
    }

    fn device(&mut self, device: &Device, twice: Twice) {
        let default = EtherCatSettings::default();
        let settings = device.ethercat.as_deref().unwrap_or(&default);
        self.same("name", device.name.as_str());
        self.same("type", device.id.as_str());
        self.same("product_code", device.identity.product_code);
        self.same("revision", device.identity.revision_number);
        self.dictionary(&device.groups, &device.types, twice);
        self.pdos(&device.process_data);
        self.same("n_sm", device.process_data.sync_managers.len());
        self.same("n_fmmu", settings.fmmus.len());
        self.same("n_slots", device.slots.len());
        let modes = settings.clocks.iter().flat_map(|clocks| &clocks.modes).map(|mode| mode.name.as_str());
        self.same("dc_opmodes", modes.collect::<Vec<_>>());
        let mailbox = settings.mailbox.as_deref();
        let coe = mailbox.and_then(|mailbox| mailbox.coe.as_ref());
        let others = mailbox.map(|mailbox| [&mailbox.aoe, &mailbox.eoe, &mailbox.foe, &mailbox.soe, &mailbox.voe]);
        let others = others.into_iter().flatten().flatten().map(|protocol| protocol.init_commands.len());
        self.same("n_initcmd", coe.map_or(0, |coe| coe.init_commands.len()) + others.sum::<usize>());
    }

    fn module(&mut self, module: &Module, twice: Twice) {
        self.same("name", module.name.as_str());
        self.same("type", module.id.as_str());
        self.same("module_ident", module.number);
        self.same("module_class", Some(module.class.as_str()).filter(|class| !class.is_empty()));
        self.dictionary(&module.groups, &module.types, twice);
        self.pdos(&module.process_data);
    }
}

/// Number of objects that a file declares a second time, and the number of their sub-items. The compiler keeps the first object and
/// reports the second one; the script counts both.
#[derive(Clone, Copy, Default)]
struct Twice {
    objects: usize,
    subs: usize,
}

fn twice(case: &Case) -> Twice {
    let found = case.read.diagnostics.list().iter();
    let left_out = found.filter(|found| found.code.id == "ESI032" && found.message.starts_with("object"));
    let text = |found: &Diagnostic| {
        let rest = &case.read.sources[0].text()[found.span.start as usize..];
        rest.split("</Object>").next().unwrap_or("").matches("<SubItem>").count()
    };
    left_out.fold(Twice::default(), |sum, found| Twice { objects: sum.objects + 1, subs: sum.subs + text(found) })
}

#[test]
fn the_ir_has_what_the_oracle_counts() {
    let Some(cases) = cases() else { return };
    let (mut devices, mut modules, mut wrong) = (0, 0, Vec::new());
    for case in &cases {
        let catalog = case.catalog();
        let actual = catalog.devices.iter().filter(|device| !device.dictionary_only);
        let expected = case.oracle["devices"].as_array().expect("devices");
        assert_eq!(actual.clone().count(), expected.len(), "{}: devices", case.name);
        let mut check = |what: String, oracle: &Value, compare: &dyn Fn(&mut Counts<'_>)| {
            let mut counts = Counts { oracle, wrong: Vec::new() };
            compare(&mut counts);
            wrong.extend(counts.wrong.into_iter().map(|wrong| format!("{} {what}: {wrong}", case.name)));
        };
        for (device, oracle) in actual.zip(expected) {
            check(format!("device {}", device.id), oracle, &|counts| counts.device(device, twice(case)));
            devices += 1;
        }
        let expected = case.oracle["modules"].as_array().map_or(&[][..], Vec::as_slice);
        assert_eq!(catalog.modules.len(), case.oracle["n_modules"].as_u64().expect("a number") as usize);
        for (module, oracle) in catalog.modules.iter().zip(expected) {
            check(format!("module {}", module.id), oracle, &|counts| counts.module(module, Twice::default()));
            modules += 1;
        }
        if let (Some(dictionary), [device]) = (case.oracle.get("dictionary"), &catalog.devices[..]) {
            assert!(device.dictionary_only);
            check("dictionary".into(), dictionary, &|counts| {
                counts.dictionary(&device.groups, &device.types, Twice::default())
            });
        }
        check("file".into(), &case.oracle, &|counts| {
            if let Some(device) = catalog.devices.iter().find(|device| !device.dictionary_only) {
                counts.same("vendor_id", device.identity.vendor_id);
            }
        });
    }
    eprintln!("{devices} devices and {modules} modules");
    assert!(wrong.is_empty(), "{} of them: {:#?}", wrong.len(), &wrong[..wrong.len().min(60)]);
    let (least_devices, least_modules) = (lane::at_least(385), lane::at_least(134));
    assert!(devices >= least_devices && modules >= least_modules, "only {devices} devices and {modules} modules");
}

/// Checks completed devices: objects are sorted, mapped objects exist, and diagnostics have positions in their files.
#[test]
fn checked_files_are_consistent() {
    let Some(folder) = folder_of("esi") else { return };
    let Some(cases) = cases() else { return };
    let mut findings = 0;
    for case in &cases {
        let checked = check(Source::read(&folder.join(&case.name)).expect("a file"), &Options::default());
        let catalog = checked.catalog.as_ref().expect("a catalog");
        for device in &catalog.devices {
            let indices: Vec<_> = device.groups.iter().map(Group::index).collect();
            assert!(indices.is_sorted_by(|one, other| one < other), "{}: {}", case.name, device.name);
            for entry in device.process_data.pdos.iter().flat_map(|pdo| &pdo.entries) {
                let exists = device.entry(entry.index, entry.sub_index).is_some();
                assert!(exists || entry.index == 0 || entry.depends_on_slot, "{}: {entry:?}", case.name);
            }
        }
        for module in catalog.modules.iter().flat_map(|module| &module.groups) {
            assert!(module.index().is_some());
        }
        for found in checked.diagnostics.list() {
            let source = &checked.sources[found.span.file.0 as usize];
            assert!(source.text().get(found.span.range()).is_some_and(|text| !text.is_empty()), "{found:?}");
            findings += 1;
        }
    }
    eprintln!("{findings} findings");
}
