//! Checks that a comparison reports changes to all facts in the intermediate representation. [`UNREPORTED`] lists the
//! exceptions, with reasons.
//!
//! The test changes the leaves of the serialized representation: numbers, texts, truth values, alternatives, list
//! elements and optional parts. If many leaves have the same path, the test changes only some of them, in the smallest
//! descriptions.

#[allow(dead_code)]
#[path = "../../../../tests/support/arbitrary_ir/mod.rs"]
mod arbitrary_ir;
#[path = "../../../../tests/support/lane.rs"]
mod lane;
#[path = "../../../../tests/support/seed.rs"]
mod seed;

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use crate::leaves::{mutations, Leaf};
use arbitrary_ir::bytes::Bytes;
use lexibus_codegen::compile::{check, Options};
use lexibus_codegen::ir::Catalog;
use lexibus_codegen::source::Source;
use lexibus_site::compare::compare;
use serde::Deserialize;
use serde_json::Value;

use crate::root::root;

/// Facts whose changes are not reported, with the reason. The key is the end of a path, in which `*` is any list
/// position.
const UNREPORTED: [(&str, &str); 12] = [
    ("/files", "the files that are compared"),
    ("/origin", "a position in the file"),
    ("/at", "positions in the file"),
    ("/span", "a position in the file"),
    ("/name_at", "a position in the file"),
    ("/step_spans", "positions in the file"),
    ("/request_at", "a position in the file"),
    ("/reply_at", "a position in the file"),
    ("/overlay/line", "a position in the file"),
    ("/cite", "a position in the manual"),
    ("/manual/counts", "the unit of positions in the manual"),
    ("/manual/sections/*/start", "a position in the manual"),
];

/// Returns the key in [`UNREPORTED`] that matches a leaf or an element that contains the leaf. Returns `None` if
/// changes to the leaf must be reported.
fn unreported(pattern: &str) -> Option<&'static str> {
    let is_part = |end: &str| format!("{pattern}/").contains(&format!("{end}/"));
    UNREPORTED.iter().map(|(end, _)| *end).find(|end| is_part(end))
}

/// Returns whether no part of a value is reported, because each part is in [`UNREPORTED`] or equal to its default.
fn is_unreported(value: &Value, pattern: &str) -> bool {
    let is_part_unreported = |part: &Value, pattern: &str| is_default(part) || is_unreported(part, pattern);
    match value {
        Value::Object(fields) => {
            fields.iter().all(|(name, part)| is_part_unreported(part, &format!("{pattern}/{name}")))
        }
        Value::Array(list) => {
            !list.is_empty() && list.iter().all(|part| is_part_unreported(part, &format!("{pattern}/*")))
        }
        _ => unreported(pattern).is_some(),
    }
}

/// Returns whether a value equals the default of its type.
fn is_default(value: &Value) -> bool {
    match value {
        Value::Null | Value::Bool(false) => true,
        Value::String(text) => text.is_empty() || text == "unknown",
        Value::Array(list) => list.is_empty(),
        _ => false,
    }
}

/// Ends of the paths at which an enumeration can be a variant without content, although other variants have content. The
/// test can replace a variant with content by one without content, but not the reverse.
const ALONE: [&str; 5] =
    ["/axes/rules/*/step", "/groups/*/kind", "/shape/bit_field/fields/*/meaning", "/request/*", "/reply/*"];

/// A device description and its JSON representation.
struct Description {
    name: String,
    length: usize,
    catalog: Catalog,
    json: Value,
}

impl Description {
    /// Creates a description from a catalog that was converted to JSON and back. Returns `None` if JSON cannot express
    /// a number of the catalog.
    fn of(name: String, length: usize, catalog: &Catalog) -> Option<Self> {
        let json = serde_json::to_value(catalog).ok()?;
        let catalog = Catalog::deserialize(&json).ok()?;
        Some(Description { name, length, catalog, json })
    }

    fn read(path: &Path) -> Option<Self> {
        let source = Source::read(path).ok()?;
        let (name, length) = (path.display().to_string(), source.text().len());
        Description::of(name, length, &check(source, &Options::default()).catalog?)
    }
}

/// Returns descriptions sorted by size: inputs of the UI cases, dictionaries, and catalogs from random bytes. The full
/// lane adds a part of the corpus.
fn descriptions() -> Vec<Description> {
    let root = root();
    let mut paths = Vec::new();
    for folder in ["tests/ui", "tests/data", "dictionaries"] {
        find(&root.join(folder), &mut paths);
    }
    if lane::is_full() {
        let sample = include_str!("../../../../tests/corpus-sample.txt").lines().filter(|line| !line.starts_with('#'));
        paths.extend(sample.map(|name| root.join("../shared/corpus").join(name)).filter(|path| path.is_file()));
    }
    let mut all: Vec<Description> = paths.iter().filter_map(|path| Description::read(path)).collect();
    let drawn = if lane::is_full() { 120 } else { 8 };
    all.extend((0..drawn).filter_map(|seed| {
        let catalog = arbitrary_ir::catalog(&mut Bytes::new(&seed::bytes(seed, BYTES)));
        Description::of(format!("seed {seed}"), BYTES, &catalog)
    }));
    all.sort_by_key(|description| (description.length, description.name.clone()));
    all
}

fn find(folder: &Path, paths: &mut Vec<PathBuf>) {
    let entries = std::fs::read_dir(folder).expect("a folder").map(|entry| entry.expect("an entry").path());
    for path in entries {
        let ending = path.extension().map(|ending| ending.to_string_lossy().into_owned()).unwrap_or_default();
        match ending.as_str() {
            _ if path.is_dir() => find(&path, paths),
            "eds" | "dcf" | "xdd" | "xdc" | "xpd" | "xml" => paths.push(path),
            "toml" if !path.ends_with("case.toml") && !path.ends_with("output.toml") => paths.push(path),
            _ => {}
        }
    }
}

/// Number of random bytes that determine a catalog.
const BYTES: usize = 1500;

/// Results of comparing descriptions with changed leaves.
#[derive(Default)]
struct Tally {
    /// Number of changed leaves for each path.
    paths: BTreeMap<String, usize>,
    changes: usize,
    reported: usize,
    /// Keys in [`UNREPORTED`] that match a changed leaf.
    listed: BTreeSet<&'static str>,
    /// For each path without a reported change, an example of a change.
    missed: BTreeMap<String, String>,
    /// For each path whose changes are all invalid, an example of a change. Removals of required parts are not included.
    invalid: BTreeMap<String, String>,
}

impl Tally {
    /// Changes the leaves of a description, but no more than `most` leaves per path in all descriptions together.
    fn add(&mut self, description: &Description, most: usize) {
        assert_eq!(compare(&description.catalog, &description.catalog), [], "{} differs from itself", description.name);
        let mut json = description.json.clone();
        for leaf in Leaf::all(&description.json) {
            let count = self.paths.entry(leaf.pattern()).or_default();
            *count += 1;
            if *count <= most {
                self.leaf(description, &leaf, &mut json);
            }
        }
    }

    fn leaf(&mut self, description: &Description, leaf: &Leaf, json: &mut Value) {
        let mut is_changed = false;
        for change in mutations(leaf, json) {
            let example = format!("{} to {change} at {} of {}", leaf.value(json), leaf.pointer(), description.name);
            let before = leaf.replace(json, change);
            let changed = Catalog::deserialize(&*json);
            leaf.replace(json, before);
            if let Ok(changed) = changed {
                is_changed = true;
                // Ignore a change that results in an equal catalog, because there is nothing to report.
                if changed != description.catalog {
                    self.compare(description, &changed, leaf, example);
                }
            }
        }
        if !is_changed && leaf.is_value(json) {
            self.invalid.insert(leaf.pattern(), format!("{} at {}", description.name, leaf.pointer()));
        }
    }

    fn compare(&mut self, description: &Description, changed: &Catalog, leaf: &Leaf, example: String) {
        let pattern = leaf.pattern();
        let is_reported =
            !compare(&description.catalog, changed).is_empty() && !compare(changed, &description.catalog).is_empty();
        self.changes += 1;
        self.reported += usize::from(is_reported);
        match unreported(&pattern) {
            Some(entry) => {
                assert!(!is_reported, "{example} is reported although it is on the list");
                self.listed.insert(entry);
            }
            None if !is_reported && !is_unreported(leaf.value(&description.json), &pattern) => {
                self.missed.entry(pattern).or_insert(example);
            }
            None => {}
        }
    }
}

#[test]
fn a_change_of_every_leaf_is_reported() {
    let most = if lane::is_full() { 4 } else { 1 };
    let mut tally = Tally::default();
    for description in descriptions() {
        tally.add(&description, most);
    }
    let Tally { paths, changes, reported, listed, missed, invalid } = tally;
    println!("{} paths, {changes} changes, {reported} reported", paths.len());
    for (pattern, example) in &missed {
        println!("missed: {pattern}: {example}");
    }
    let invalid: Vec<_> = invalid.iter().filter(|(path, _)| !ALONE.iter().any(|end| path.ends_with(end))).collect();
    assert!(invalid.is_empty(), "no valid change of: {invalid:#?}");
    assert!(missed.is_empty(), "{} paths have no report", missed.len());
    assert_eq!(listed, UNREPORTED.iter().map(|(end, _)| *end).collect(), "the list has unused entries");
}
