//! Compares the results for all GSDML files of the corpus with independent counts (`oracle.json`). Also compares the names in
//! these files with the text lists that a simple scanner reads.

use crate::corpus_support;

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use corpus_support::decode;
use lexibus_codegen::compile::{check, Compilation, Options};
use lexibus_codegen::diagnostics::Severity;
use lexibus_codegen::ir::{
    self, Catalog, Device, Group, GroupKind, IoData, Module, PdoEntryKind, Shape, Submodule, SubmoduleId,
    SubmoduleKind, SubmoduleUse,
};
use lexibus_codegen::source::Source;
use serde_json::Value;

/// A file with the results of the oracle and the compiler.
struct Case {
    name: String,
    text: String,
    oracle: Value,
    compilation: Compilation,
}

impl Case {
    fn catalog(&self) -> &Catalog {
        self.compilation.catalog.as_ref().unwrap_or_else(|| panic!("{}: no catalog", self.name))
    }

    fn count(&self, key: &str) -> usize {
        number(&self.oracle["counts"][key]).unwrap_or_else(|| panic!("{}: no count of {key}", self.name)) as usize
    }

    /// Returns whether the file is the mock file, whose structure differs from GSDML. The oracle reads almost nothing from this
    /// file.
    fn is_mock(&self) -> bool {
        self.name == "richenapedro__pnio-validator__sample_gsdml.xml"
    }
}

fn folder() -> Option<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../shared/corpus/gsdml");
    if folder.is_dir() {
        return Some(folder);
    }
    eprintln!("skipped: there is no corpus at {}", folder.display());
    None
}

/// Returns the corpus files that are well-formed according to the oracle, or those that are not if `well_formed` is
/// false. If there is no corpus, prints a message and returns `None`.
fn cases(well_formed: bool) -> Option<Vec<Case>> {
    let folder = folder()?;
    let text = std::fs::read_to_string(folder.join("oracle.json")).expect("the oracle");
    let oracle: BTreeMap<String, Value> = serde_json::from_str(&text).expect("JSON");
    assert!(oracle.len() >= 78, "only {} files are in the corpus", oracle.len());
    let of_kind = oracle.into_iter().filter(|(_, entry)| entry["wellformed"] == well_formed);
    Some(of_kind.map(|(name, entry)| case(&folder, name, entry)).collect())
}

fn case(folder: &Path, name: String, oracle: Value) -> Case {
    let bytes = std::fs::read(folder.join(&name)).expect("a file of the corpus");
    let text = decode(&bytes);
    let compilation = check(Source::new(name.as_str(), bytes), &Options::default());
    Case { name, text, oracle, compilation }
}

fn number(value: &Value) -> Option<u64> {
    value.as_u64()
}

fn list(value: &Value) -> &[Value] {
    value.as_array().map_or(&[], Vec::as_slice)
}

#[test]
fn well_formed_files_are_read_without_errors() {
    let Some(cases) = cases(true) else { return };
    for case in &cases {
        let errors = case.compilation.diagnostics.list().iter().filter(|found| found.severity == Severity::Error);
        let errors: Vec<String> = errors.map(|found| case.compilation.one_line(found)).collect();
        assert!(errors.is_empty(), "{errors:#?}");
        assert!(case.compilation.is_usable(), "{}", case.name);
    }
}

#[test]
fn malformed_files_have_one_error_with_its_place() {
    let Some(cases) = cases(false) else { return };
    // The first file has a surplus end tag. The second file ends inside an element, so the error is reported at the last
    // character of the file.
    let places: BTreeMap<&str, u32> = [
        ("vformi__PLC.Commissioning.Lib.Siemens__MalformedGSDML.xml", 5085),
        ("vformi__PLC.Commissioning.Lib.Siemens__invalid.xml", 5585),
    ]
    .into();
    for case in &cases {
        assert!(case.compilation.catalog.is_none(), "{}", case.name);
        let [error] = case.compilation.diagnostics.list() else { panic!("{}: not one diagnostic", case.name) };
        assert_eq!((error.code.id, error.severity), ("XML001", Severity::Error), "{}", case.name);
        let place = case.compilation.sources[0].position(error.span.start);
        assert_eq!(Some(&place.line), places.get(case.name.as_str()), "{}", case.name);
    }
    assert_eq!(cases.len(), places.len());
}

#[test]
fn identity_and_header() {
    let Some(cases) = cases(true) else { return };
    for case in cases.iter().filter(|case| !case.is_mock()) {
        let devices = &case.catalog().devices;
        assert_eq!(devices.len(), list(&case.oracle["daps"]).len(), "{}", case.name);
        for device in devices {
            let (identity, header) = (&device.identity, &device.header);
            assert_eq!(identity.vendor_id.map(u64::from), number(&case.oracle["vendor_id"]), "{}", case.name);
            assert_eq!(identity.product_code.map(u64::from), number(&case.oracle["device_id"]), "{}", case.name);
            assert_eq!(identity.vendor_name, vendor_name(case), "{}", case.name);
            assert_eq!(header.format_version, case.oracle["schema_version"].as_str().unwrap_or(""), "{}", case.name);
        }
    }
}

/// Returns the vendor name from the oracle. The oracle uses the declared encoding, so the function corrects names from
/// UTF-8 files that declare ISO 8859-1.
fn vendor_name(case: &Case) -> String {
    let name = case.oracle["vendor_name"].as_str().unwrap_or("");
    let misdeclared = case.compilation.diagnostics.list().iter().any(|found| found.code.id == "XML003");
    let bytes: Option<Vec<u8>> = name.chars().map(|letter| u8::try_from(u32::from(letter)).ok()).collect();
    let again = bytes.filter(|_| misdeclared).and_then(|bytes| String::from_utf8(bytes).ok());
    again.unwrap_or_else(|| name.to_owned())
}

/// Tests attributes such as `VendorId`, whose names have a different case in the schema. The oracle ignores such attributes.
#[test]
fn attributes_in_another_case() {
    let Some(cases) = cases(true) else { return };
    let case = cases.iter().find(|case| case.is_mock()).expect("the file");
    let identity = &case.catalog().devices[0].identity;
    assert_eq!((identity.vendor_id, identity.product_code), (Some(0x1234), Some(0x5678)));
    assert!(case.compilation.diagnostics.list().iter().any(|found| found.code.id == "GSD007"));
}

/// Returns the total input and output lengths of submodules, including the trailers of PROFIsafe messages.
fn lengths<'s>(submodules: impl Iterator<Item = &'s Submodule>) -> (u64, u64) {
    let bytes = |data: &Option<Box<IoData>>| data.as_ref().map_or(0, |data| data.image.length + data.image.overhead);
    let add = |(input, output), submodule: &Submodule| {
        (input + u64::from(bytes(&submodule.input)), output + u64::from(bytes(&submodule.output)))
    };
    submodules.fold((0, 0), add)
}

/// Returns the index, length and number of parameters of each record.
fn records<'s>(submodules: impl Iterator<Item = &'s Submodule>) -> Vec<(u64, u64, u64)> {
    let of = |group: &Group| match &group.kind {
        GroupKind::Record(record) => (record.index.into(), record.length.into(), group.items.len() as u64),
        other => panic!("{other:?} is not a record"),
    };
    let mut records: Vec<_> = submodules.flat_map(|submodule| &submodule.records).map(of).collect();
    records.sort_unstable();
    records
}

fn expected_records(value: &Value) -> Vec<(u64, u64, u64)> {
    let of = |record: &Value| {
        let [index, length, refs] = list(record) else { panic!("{record} is not a record") };
        (number(index).unwrap(), number(length).unwrap(), number(refs).unwrap())
    };
    let mut records: Vec<_> = list(value).iter().map(of).collect();
    records.sort_unstable();
    records
}

fn submodule(catalog: &Catalog, SubmoduleId(id): SubmoduleId) -> &Submodule {
    &catalog.submodules[id as usize]
}

/// Returns the built-in submodules of a device or module: the virtual submodules if `is_virtual` is true, otherwise interfaces and
/// ports.
fn built_in<'c>(
    catalog: &'c Catalog,
    uses: &'c [SubmoduleUse],
    is_virtual: bool,
) -> Vec<(&'c Submodule, &'c SubmoduleUse)> {
    let uses = uses.iter().map(|usage| (submodule(catalog, usage.submodule), usage));
    uses.filter(|(found, entry)| {
        let built_in = !entry.places.fixed.is_empty() && found.kind != SubmoduleKind::Pluggable;
        built_in && (found.kind == SubmoduleKind::Virtual) == is_virtual
    })
    .collect()
}

fn check_submodule(name: &str, found: &Submodule, expected: &Value) {
    assert_eq!(found.id, expected["id"].as_str().unwrap_or(""), "{name}");
    let at = format!("{name}: {}", found.id);
    assert_eq!(Some(u64::from(found.ident)), number(&expected["ident"]), "{at}");
    assert_eq!(Some(u64::from(found.api)), number(&expected["api"]), "{at}");
    let (input, output) = lengths(std::iter::once(found));
    assert_eq!(
        (Some(input), Some(output)),
        (number(&expected["input_bytes"]), number(&expected["output_bytes"])),
        "{at}"
    );
    assert_eq!(records(std::iter::once(found)), expected_records(&expected["records"]), "{at}");
}

fn check_built_in(case: &Case, uses: &[SubmoduleUse], expected: &Value) {
    let catalog = case.catalog();
    let (found, actual) = (built_in(catalog, uses, true), list(&expected["virtual_submodules"]));
    assert_eq!(found.len(), actual.len(), "{}", case.name);
    for ((found, _), expected) in found.iter().zip(actual) {
        check_submodule(&case.name, found, expected);
    }
    let (found, uses) = (built_in(catalog, uses, false), list(&expected["system_submodules"]));
    assert_eq!(found.len(), uses.len(), "{}", case.name);
    for ((found, place), expected) in found.iter().zip(uses) {
        assert_eq!(found.id, expected["id"].as_str().unwrap_or(""), "{}", case.name);
        assert_eq!(Some(u64::from(found.ident)), number(&expected["ident"]), "{}", case.name);
        let subslots: Vec<u64> = place.places.fixed.iter().map(u64::from).collect();
        assert_eq!(
            Some(&subslots[..]),
            number(&expected["subslot"]).as_ref().map(std::slice::from_ref),
            "{}",
            case.name
        );
        let kind = if found.kind == SubmoduleKind::Interface { "InterfaceSubmoduleItem" } else { "PortSubmoduleItem" };
        assert_eq!(expected["kind"], kind, "{}", case.name);
    }
}

fn check_device(case: &Case, device: &Device, expected: &Value) {
    let settings = device.profinet.as_ref().expect("settings");
    let at = format!("{}: {}", case.name, device.id);
    assert_eq!(device.id, expected["id"].as_str().unwrap_or(""), "{at}");
    assert_eq!(Some(u64::from(settings.ident)), number(&expected["ident"]), "{at}");
    assert_eq!(settings.min_device_interval.map(u64::from), number(&expected["min_device_interval"]), "{at}");
    assert_eq!(settings.pnio_version, expected["pnio_version"].as_str().unwrap_or(""), "{at}");
    assert_eq!(settings.vendor_blocks.len() as u64, number(&expected["ar_vendor_block_requests"]).unwrap(), "{at}");
    assert_eq!(device.modules.len() as u64, number(&expected["useable_modules"]).unwrap(), "{at}");
    if let Some(name) = expected["name"].as_str() {
        assert_eq!(device.name, name, "{at}");
    }
    for (found, key) in [(&settings.slots, "physical_slots"), (&settings.places.fixed, "fixed_in_slots")] {
        let Some(slots) = expected[key].as_str() else { continue };
        assert_eq!(found.iter().collect::<Vec<_>>(), slots_of(slots), "{at}");
    }
    check_built_in(case, &device.submodules, expected);
    let pluggable = device.submodules.len()
        - built_in(case.catalog(), &device.submodules, true).len()
        - built_in(case.catalog(), &device.submodules, false).len();
    assert_eq!(pluggable as u64, number(&expected["useable_submodules"]).unwrap(), "{at}");
}

/// Parses a list of numbers and ranges such as `0..3 7`, without the code under test.
fn slots_of(text: &str) -> Vec<u16> {
    let mut slots = Vec::new();
    for part in text.split(' ').filter(|part| !part.is_empty()) {
        let (first, last) = part.split_once("..").unwrap_or((part, part));
        slots.extend(first.parse::<u16>().unwrap()..=last.parse::<u16>().unwrap());
    }
    slots
}

#[test]
fn devices_and_their_built_in_submodules() {
    let Some(cases) = cases(true) else { return };
    let mut count = 0;
    for case in &cases {
        for (device, expected) in case.catalog().devices.iter().zip(list(&case.oracle["daps"])) {
            check_device(case, device, expected);
            count += 1;
        }
    }
    assert_eq!(count, 117);
}

fn check_module(case: &Case, module: &Module, expected: &Value) {
    let at = format!("{}: {}", case.name, module.id);
    assert_eq!(module.id, expected["id"].as_str().unwrap_or(""), "{at}");
    assert_eq!(Some(u64::from(module.number)), number(&expected["ident"]), "{at}");
    if let Some(name) = expected["name"].as_str() {
        assert_eq!(module.name, name, "{at}");
    }
    check_built_in(case, &module.submodules, expected);
    let submodules = built_in(case.catalog(), &module.submodules, true);
    let (input, output) = lengths(submodules.iter().map(|(found, _)| *found));
    assert_eq!(
        (Some(input), Some(output)),
        (number(&expected["input_bytes"]), number(&expected["output_bytes"])),
        "{at}"
    );
    assert_eq!(records(submodules.iter().map(|(found, _)| *found)), expected_records(&expected["records"]), "{at}");
}

#[test]
fn modules_and_submodules() {
    let Some(cases) = cases(true) else { return };
    let (mut modules, mut submodules) = (0, 0);
    for case in &cases {
        let result = list(&case.oracle["modules"]);
        assert_eq!(case.catalog().modules.len(), result.len(), "{}", case.name);
        for (module, expected) in case.catalog().modules.iter().zip(result) {
            check_module(case, module, expected);
            modules += 1;
        }
        let pluggable = case.catalog().submodules.iter().filter(|found| found.kind == SubmoduleKind::Pluggable);
        let actual = list(&case.oracle["submodules"]);
        assert_eq!(pluggable.clone().count(), actual.len(), "{}", case.name);
        for (found, expected) in pluggable.zip(actual) {
            check_submodule(&case.name, found, expected);
            submodules += 1;
        }
    }
    assert_eq!((modules, submodules), (835, 48));
}

fn data(catalog: &Catalog) -> impl Iterator<Item = &IoData> {
    catalog.submodules.iter().flat_map(|found| found.input.iter().chain(&found.output)).map(|data| &**data)
}

/// Returns the number of data items: the items in `data.items`, and the fields outside of these items.
fn data_items(data: &IoData) -> usize {
    let within: u32 = data.items.iter().map(|item| item.fields).sum();
    data.image.fields.len() - within as usize + data.items.len()
}

fn parameter_records(catalog: &Catalog) -> impl Iterator<Item = &Group> {
    let of_submodules = catalog.submodules.iter().flat_map(|found| &found.records);
    let settings = catalog.devices.iter().filter_map(|device| device.profinet.as_ref());
    of_submodules.chain(settings.flat_map(|settings| &settings.vendor_blocks).map(|block| &block.record))
}

/// Returns the number of elements of each kind in the IR. The kinds have the names that the oracle uses.
fn counts(catalog: &Catalog) -> Vec<(&'static str, usize)> {
    let kinds = |kind| catalog.submodules.iter().filter(|found| found.kind == kind).count();
    let of_devices = catalog.devices.iter().flat_map(|device| &device.submodules);
    let uses = of_devices.chain(catalog.modules.iter().flat_map(|module| &module.submodules));
    let pluggable = uses.filter(|usage| submodule(catalog, usage.submodule).kind == SubmoduleKind::Pluggable);
    vec![
        ("daps", catalog.devices.len()),
        ("modules", catalog.modules.len()),
        ("virtual_submodules", kinds(SubmoduleKind::Virtual)),
        ("submodule_items", kinds(SubmoduleKind::Pluggable)),
        ("interface_submodules", kinds(SubmoduleKind::Interface)),
        ("port_submodule_items", kinds(SubmoduleKind::Port)),
        ("module_item_refs", catalog.devices.iter().map(|device| device.modules.len()).sum()),
        ("submodule_item_refs", pluggable.count()),
        ("categories", catalog.families.len()),
        ("graphics", catalog.graphics.len()),
        ("unit_diag_types", catalog.unit_diagnoses.len()),
        ("channel_diag_items", channel_errors(catalog)),
    ]
}

/// Returns the number of data items, records and related elements of each kind in the IR.
fn counts_of_data(catalog: &Catalog) -> Vec<(&'static str, usize)> {
    let constants = parameter_records(catalog).map(|group| match &group.kind {
        GroupKind::Record(record) => record.constants.len(),
        _ => 0,
    });
    let values = enumerations(catalog);
    vec![
        ("data_items", data(catalog).map(data_items).sum()),
        ("bit_data_items", data(catalog).map(bits).sum()),
        ("records", catalog.submodules.iter().map(|found| found.records.len()).sum()),
        ("f_records", catalog.submodules.iter().filter(|found| found.f_parameters.is_some()).count()),
        ("refs", parameter_records(catalog).map(|group| group.items.len()).sum()),
        ("consts", constants.sum()),
        ("menu_items", catalog.submodules.iter().map(|found| found.menus.len()).sum()),
        ("value_items", values.len()),
        ("assigns", values.values().sum()),
    ]
}

/// Returns the number of ChannelDiagItem elements, whose codes have API 0. The oracle does not count
/// ProfileChannelDiagItem elements, whose codes have other API numbers.
fn channel_errors(catalog: &Catalog) -> usize {
    let tables = catalog.code_tables.iter().filter(|table| table.name == "channel_diagnosis");
    tables.flat_map(|table| &table.rows).filter(|row| row.cells[1] == ir::Value::Int(0)).count()
}

/// Returns the number of named bits: one-bit fields of the data items in `data.items`, without padding.
fn bits(data: &IoData) -> usize {
    let fields = data.items.iter().flat_map(|item| {
        let first = item.first_field as usize;
        &data.image.fields[first..first + item.fields as usize]
    });
    fields.filter(|field| field.bits == 1 && field.kind == PdoEntryKind::Item).count()
}

/// Returns the number of values in each value list. The compiler can create several types from one list.
fn enumerations(catalog: &Catalog) -> BTreeMap<&str, usize> {
    let types = catalog.types.iter().filter_map(|def| match &def.shape {
        Shape::Enumeration { values, .. } => Some((def.name.as_str(), values.len())),
        _ => None,
    });
    types.collect()
}

#[test]
fn counts_agree() {
    let Some(cases) = cases(true) else { return };
    for case in &cases {
        for (key, found) in counts(case.catalog()).into_iter().chain(counts_of_data(case.catalog())) {
            assert_eq!(found, case.count(key), "{}: {key}", case.name);
        }
    }
}

/// Returns the values of the attribute `name` in all elements called `element`, in file order. Uses a minimal scanner.
fn attributes<'t>(text: &'t str, element: &str, name: &str) -> Vec<&'t str> {
    let (open, key) = (format!("<{element}"), format!("{name}="));
    let tags = text.match_indices(&open).filter_map(|(at, _)| {
        let rest = &text[at + open.len()..];
        rest.starts_with(|c: char| c.is_whitespace() || c == '/' || c == '>').then(|| rest.split('>').next())?
    });
    tags.filter_map(|tag| {
        let at = tag.match_indices(&key).find(|(at, _)| tag[..*at].ends_with(char::is_whitespace))?.0;
        let rest = &tag[at + key.len()..];
        rest[1..].split(rest.chars().next()?).next()
    })
    .collect()
}

/// Removes XML comments, because they can contain any text.
fn without_comments(text: &str) -> String {
    let mut parts = text.split("<!--");
    let mut rest = parts.next().unwrap_or("").to_owned();
    rest.extend(parts.map(|part| part.split_once("-->").map_or("", |(_, rest)| rest)));
    rest
}

fn unescaped(text: &str) -> String {
    let text = text.replace("&lt;", "<").replace("&gt;", ">").replace("&quot;", "\"").replace("&apos;", "'");
    let text = text.replace("&#10;", "\n").replace("&#13;", "\r").replace("&#xA;", "\n");
    text.replace("&amp;", "&")
}

/// Returns the texts of each language by their identifiers. The key `""` means the primary language.
fn text_lists(text: &str) -> BTreeMap<&str, BTreeMap<&str, String>> {
    let mut lists: BTreeMap<&str, BTreeMap<&str, String>> = BTreeMap::new();
    for (open, close) in [("<PrimaryLanguage", "</PrimaryLanguage"), ("<Language", "</Language")] {
        for part in text.split(open).skip(1) {
            let part = part.split(close).next().unwrap_or("");
            let language = if open == "<Language" { part.split(['"', '\'']).nth(1).unwrap_or("") } else { "" };
            let (ids, values) = (attributes(part, "Text", "TextId"), attributes(part, "Text", "Value"));
            let list = lists.entry(language).or_default();
            for (id, value) in ids.into_iter().zip(values) {
                list.entry(id).or_insert_with(|| unescaped(value));
            }
        }
    }
    lists
}

/// Each parameter must have the name from the text list, in all languages of the list.
#[test]
fn parameters_have_the_names_of_the_text_list() {
    let Some(cases) = cases(true) else { return };
    let mut compared = 0;
    for case in &cases {
        let text = without_comments(&case.text);
        let lists = text_lists(&text);
        let mut found = Vec::new();
        for item in parameter_records(case.catalog()).flat_map(|group| &group.items) {
            found.push((item.origin.span.start, item.name.as_str(), &item.names));
        }
        found.sort_by_key(|&(start, ..)| start);
        let source = &case.compilation.sources[0];
        for (start, name, names) in found {
            let tag = source.text()[start as usize..].split('>').next().unwrap();
            let tag = format!("{tag}>");
            let [id] = attributes(&tag, "Ref", "TextId")[..] else { panic!("{}: {tag}", case.name) };
            let expected = lists[""].get(id).map_or(id, String::as_str);
            assert_eq!(name, expected, "{}: {tag}", case.name);
            let others: BTreeMap<&str, &str> =
                names.iter().map(|local| (local.language.as_str(), local.text.as_str())).collect();
            let lists = lists.iter().filter(|(language, _)| !language.is_empty());
            let expected: BTreeMap<&str, &str> =
                lists.filter_map(|(language, list)| Some((*language, list.get(id)?.as_str()))).collect();
            assert_eq!(others, expected, "{}: {tag}", case.name);
            compared += 1;
        }
    }
    assert_eq!(compared, 2622);
}

/// Compares the languages of each file with the languages of its names.
#[test]
fn languages_agree() {
    let Some(cases) = cases(true) else { return };
    for case in &cases {
        let languages = case.oracle["counts"]["languages"].as_object().expect("languages");
        let expected: BTreeSet<&str> =
            languages.keys().map(String::as_str).filter(|language| *language != "primary").collect();
        let catalog = case.catalog();
        let names = catalog.devices.iter().flat_map(|device| device.names.iter());
        let names = names.chain(catalog.modules.iter().flat_map(|module| module.names.iter()));
        let found: BTreeSet<&str> = names.map(|local| local.language.as_str()).collect();
        assert_eq!(found, expected, "{}", case.name);
    }
}

/// Checks the diagnostics of real files: the number of files with each code.
#[test]
fn findings_are_as_expected() {
    let Some(cases) = cases(true) else { return };
    let mut codes: BTreeMap<&str, BTreeSet<&str>> = BTreeMap::new();
    for case in &cases {
        for found in case.compilation.diagnostics.list() {
            codes.entry(found.code.id).or_default().insert(&case.name);
        }
    }
    let counts: Vec<(&str, usize)> = codes.iter().map(|(code, files)| (*code, files.len())).collect();
    let expected = [
        // Two test files of a library are truncated before the list of device access points.
        ("GSD002", 2),
        // The mock file has ApplicationProcess inside DeviceFunction, has no ModuleInfo, and writes VendorId instead of
        // VendorID.
        ("GSD005", 1),
        ("GSD006", 1),
        ("GSD007", 1),
        // A test file has no text list. In another file, the languages differ in one identifier.
        ("GSD008", 2),
        ("GSD009", 1),
        // Interfaces and ports in several device access points have the same ID.
        ("GSD010", 8),
        // The files are UTF-8 but declare ISO 8859-1.
        ("XML003", 3),
    ];
    assert_eq!(counts, expected);
}
