//! Tests exported files with an independent library: `canopen` for Python.
//!
//! If the library can load a file, it must also load the export of the file with the same entries. If Python does not
//! have the library, the tests print a message and pass.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::corpus_support::{files, files_of, python, File};
use lexibus_codegen::compile::{check, read, Compilation, Options};
use lexibus_codegen::diagnostics::Diagnostic;
use lexibus_codegen::ir::{self, Device, Item, Type};
use lexibus_codegen::source::{Source, Span};
use lexibus_export::eds::{export, Flavor};
use serde_json::Value;

/// Files that the library can load neither before nor after the export, with the reason.
const NOT_LOADABLE: [(&str, &str); 3] = [
    ("KITmedical__kacanopen__301__87d58e93.eds", "0x1023 has no DataType"),
    ("bggardner__canopen-rpi__node__root.eds", "0x1018 has no DataType"),
    ("starnus-software__ros2_canopen__master.dcf.em", "a template with loops that look like repeated keys"),
];

/// The result of loading a file: its entries, or an error.
type Loaded = Result<BTreeMap<(u16, u8), Entry>, String>;

/// An entry of a loaded file: its data type, access type and default value.
#[derive(Clone, Debug, PartialEq)]
struct Entry {
    data_type: u64,
    access: String,
    default: Option<String>,
}

/// Creates an empty temporary folder.
fn folder(name: &str) -> PathBuf {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _ = std::fs::remove_dir_all(&path);
    std::fs::create_dir_all(&path).expect("a folder for temporary files");
    path
}

/// Loads `paths` with the library.
fn load(python: &Path, paths: &[PathBuf]) -> Vec<Loaded> {
    const SCRIPT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/corpus_exports/dump.py");
    let output = Command::new(python).arg(SCRIPT).args(paths).output().expect("Python runs");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let text = String::from_utf8(output.stdout).expect("UTF-8");
    let loaded: Vec<Loaded> = text.lines().map(loaded).collect();
    assert_eq!(loaded.len(), paths.len());
    loaded
}

fn loaded(line: &str) -> Loaded {
    let line: Value = serde_json::from_str(line).expect("JSON");
    if let Some(error) = line["error"].as_str() {
        return Err(error.to_owned());
    }
    let number = |value: &Value| value.as_u64().expect("a number");
    let entry = |entry: &Value| {
        let at = (number(&entry[0]) as u16, number(&entry[1]) as u8);
        let access = entry[3].as_str().expect("an access type").to_owned();
        let default = entry[4].as_str().map(str::to_owned);
        (at, Entry { data_type: number(&entry[2]), access, default })
    };
    Ok(line["entries"].as_array().expect("entries").iter().map(entry).collect())
}

/// An original file, its export, and the compilation of the original.
struct Pair {
    name: String,
    compilation: Compilation,
    original: PathBuf,
    exported: PathBuf,
}

fn pair(folder: &Path, file: File, number: usize) -> Option<Pair> {
    let File { name, bytes } = file;
    let compilation = read(Source::new(name.as_str(), bytes.clone()), &Options::default());
    let catalog = compilation.catalog.as_ref()?;
    let text = export(catalog, &catalog.devices[0], Flavor::Dcf)?.text;
    let (original, exported) =
        (folder.join(format!("{number}-before.eds")), folder.join(format!("{number}-after.eds")));
    std::fs::write(&original, bytes).expect("a temporary file");
    std::fs::write(&exported, text).expect("a temporary file");
    Some(Pair { name, compilation, original, exported })
}

impl Pair {
    fn device(&self) -> &Device {
        &self.compilation.catalog.as_ref().expect("a catalog").devices[0]
    }

    fn item(&self, at: (u16, u8)) -> Option<&Item> {
        self.device().entry(at.0, at.1)
    }

    /// Returns whether the compiler reported a diagnostic within `span` of the original. The export can then contain a
    /// repaired text.
    fn is_repaired(&self, span: Span) -> bool {
        let is_within = |found: &Diagnostic| span.start <= found.span.start && found.span.end <= span.end;
        !span.is_empty() && self.compilation.diagnostics.list().iter().any(is_within)
    }
}

/// Returns the reason why an export may change an entry. Returns `None` if the entry must not change.
fn reason(pair: &Pair, at: (u16, u8), before: Option<&Entry>, after: Option<&Entry>) -> Option<&'static str> {
    let item = pair.item(at)?;
    let Some((before, after)) = before.zip(after) else {
        // The library supports CompactSubObj only for ARRAY objects. For such an object, the library creates only the
        // first element and the elements that have names.
        let follows = pair.device().object(at.0).is_some_and(|object| object.origin == item.origin);
        return (before.is_none() && follows).then_some("follows from CompactSubObj");
    };
    let is_empty = before.default.as_deref() == Some("") && after.default.is_none();
    if before.default.is_none() && item.default == Some(ir::Value::NodeId(0)) {
        return Some("the library reads $NODEID only if a number follows");
    }
    let is_alike = (before.data_type == after.data_type || pair.is_repaired(item.at.ty))
        && (before.access == after.access || pair.is_repaired(item.at.access))
        && (before.default == after.default || is_empty || pair.is_repaired(item.at.default));
    match is_alike {
        true if is_empty => Some("an empty entry equals a missing one"),
        true => Some("repaired"),
        false => None,
    }
}

#[test]
fn exported_files_load_if_their_originals_do() {
    let (Some(python), Some(files)) = (python::with(&["canopen"]), files()) else { return };
    let folder = folder("eds-in-canopen");
    let originals = files.into_iter().filter(|file| !file.is_xml()).enumerate();
    let pairs: Vec<Pair> = originals.filter_map(|(number, file)| pair(&folder, file, number)).collect();
    let before = load(&python, &pairs.iter().map(|pair| pair.original.clone()).collect::<Vec<_>>());
    let after = load(&python, &pairs.iter().map(|pair| pair.exported.clone()).collect::<Vec<_>>());
    let (mut same, mut newly, mut never, mut excused, mut wrong) = (0, 0, 0, BTreeMap::new(), Vec::new());
    for (pair, (before, after)) in pairs.iter().zip(before.iter().zip(&after)) {
        match (before, after) {
            (Ok(before), Ok(after)) => {
                let found = compare(pair, before, after, &mut excused);
                same += usize::from(found.is_empty());
                wrong.extend(found);
            }
            (Ok(_), Err(error)) => wrong.push(format!("{}: cannot be loaded after export: {error}", pair.name)),
            (Err(_), Ok(_)) => newly += 1,
            (Err(_), Err(_)) if NOT_LOADABLE.iter().any(|(name, _)| *name == pair.name) => never += 1,
            (Err(_), Err(error)) => wrong.push(format!("{}: cannot be loaded: {error}", pair.name)),
        }
    }
    eprintln!("{same} files are equal, {newly} load only after export, {never} do not load; excused: {excused:?}");
    assert!(wrong.is_empty(), "{} wrong:\n{}", wrong.len(), wrong[..wrong.len().min(200)].join("\n"));
}

fn compare(
    pair: &Pair,
    before: &BTreeMap<(u16, u8), Entry>,
    after: &BTreeMap<(u16, u8), Entry>,
    excused: &mut BTreeMap<&'static str, usize>,
) -> Vec<String> {
    let mut wrong = Vec::new();
    let all: std::collections::BTreeSet<(u16, u8)> = before.keys().chain(after.keys()).copied().collect();
    for at in all {
        let (old, new) = (before.get(&at), after.get(&at));
        if old == new {
            continue;
        }
        match reason(pair, at, old, new) {
            Some(reason) => *excused.entry(reason).or_default() += 1,
            None => wrong.push(format!("{}: {:04X}:{:02X}: {old:?} became {new:?}", pair.name, at.0, at.1)),
        }
    }
    wrong
}

/// The library must load the exports of files in other formats, with all their entries.
#[test]
fn devices_of_other_formats_load() {
    let Some(python) = python::with(&["canopen"]) else { return };
    let xdd = files().into_iter().flatten().filter(File::is_xml);
    let esi = files_of("esi").into_iter().flatten();
    let options = Options { no_profiles: true, ..Options::default() };
    let folder = folder("others-in-canopen");
    let (mut paths, mut expected) = (Vec::new(), Vec::new());
    for File { name, bytes } in xdd.chain(esi) {
        let compilation = check(Source::new(name.as_str(), bytes), &options);
        let Some(catalog) = &compilation.catalog else { continue };
        let devices = catalog.devices.iter().filter(|device| !device.groups.is_empty() && !device.dictionary_only);
        for device in devices.take(2) {
            let Some(file) = export(catalog, device, Flavor::Eds) else { continue };
            let path = folder.join(format!("{}.eds", paths.len()));
            std::fs::write(&path, file.text).expect("a temporary file");
            paths.push(path);
            expected.push((name.clone(), addresses(device)));
        }
    }
    let mut wrong = Vec::new();
    for ((name, expected), loaded) in expected.iter().zip(load(&python, &paths)) {
        match loaded {
            Err(error) => wrong.push(format!("{name}: {error}")),
            Ok(entries) => {
                let missing = expected.iter().find(|at| !entries.contains_key(at));
                wrong.extend(missing.map(|at| format!("{name}: {:04X}:{:02X} is missing", at.0, at.1)));
            }
        }
    }
    eprintln!("{} devices of other formats", paths.len());
    assert!(wrong.is_empty(), "{} wrong:\n{}", wrong.len(), wrong.join("\n"));
}

/// The library must load the exports of the repository's dictionaries, including register tables.
#[test]
fn dictionaries_load() {
    let Some(python) = python::with(&["canopen"]) else { return };
    let folder = folder("dictionaries-in-canopen");
    let dictionaries = crate::corpus_support::root::root().join("dictionaries");
    let mut sources: Vec<PathBuf> = std::fs::read_dir(dictionaries)
        .expect("the dictionaries")
        .map(|entry| entry.expect("an entry").path())
        .filter(|path| path.extension().is_some_and(|ending| ending == "toml" || ending == "eds"))
        .collect();
    sources.sort();
    let (mut paths, mut names) = (Vec::new(), Vec::new());
    for source in &sources {
        let bytes = std::fs::read(source).expect("a dictionary");
        let compilation = check(Source::new(source.to_string_lossy(), bytes), &Options::default());
        let catalog = compilation.catalog.as_ref().expect("a catalog");
        for device in &catalog.devices {
            let Some(file) = export(catalog, device, Flavor::Eds) else { continue };
            let path = folder.join(format!("{}.eds", paths.len()));
            std::fs::write(&path, file.text).expect("a temporary file");
            paths.push(path);
            names.push(device.name.clone());
        }
    }
    assert!(!paths.is_empty());
    for (name, loaded) in names.iter().zip(load(&python, &paths)) {
        let entries = loaded.unwrap_or_else(|error| panic!("{name}: {error}"));
        assert!(!entries.is_empty(), "{name}");
        eprintln!("{name}: {} entries", entries.len());
    }
}

/// Returns the addresses of the entries that the library must load: those with a data type. The library skips objects
/// that define types.
fn addresses(device: &Device) -> Vec<(u16, u8)> {
    let objects = device.groups.iter().filter(|group| group.index().is_some_and(|index| index >= 0x1000));
    let typed = objects.flat_map(|group| &group.items).filter(|item| item.ty != Type::Opaque(None));
    typed.filter_map(Item::object).collect()
}
