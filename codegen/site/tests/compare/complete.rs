//! A change of any leaf of the intermediate representation is reported by the comparison of versions, or the leaf is on a short list with a reason.
//!
//! Every leaf of the serialized representation is changed: numbers, texts, truth values, alternatives, elements of lists, and what may be
//! missing. Of the leaves with the same path, a few are changed: those of the smallest descriptions.

#[allow(dead_code)]
#[path = "../../../../tests/support/arbitrary_ir/mod.rs"]
mod arbitrary_ir;
#[path = "../../../../tests/support/lane.rs"]
mod lane;
#[path = "../../../../tests/support/seed.rs"]
mod seed;

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use crate::leaves::{Leaf, Mutator};
use arbitrary_ir::bytes::Bytes;
use lexibus_codegen::compile::{check, Options};
use lexibus_codegen::ir::Catalog;
use lexibus_codegen::source::Source;
use lexibus_site::compare::compare;
use serde::Deserialize;
use serde_json::Value;

use crate::root::root;

/// Facts that are not reported, with the reason: the end of the path of a field, in which `*` is any position.
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

/// The entry of the list that a leaf is, or is a part of.
fn unreported(pattern: &str) -> Option<&'static str> {
    let is_part = |end: &str| format!("{pattern}/").contains(&format!("{end}/"));
    UNREPORTED.iter().map(|(end, _)| *end).find(|end| is_part(end))
}

/// Whether nothing in a value is reported: all its parts are on the list, or state nothing.
fn is_unreported(value: &Value, pattern: &str) -> bool {
    let is_part_unreported = |own: &Value, pattern: &str| states_nothing(own) || is_unreported(own, pattern);
    match value {
        Value::Object(fields) => fields.iter().all(|(name, own)| is_part_unreported(own, &format!("{pattern}/{name}"))),
        Value::Array(list) => {
            !list.is_empty() && list.iter().all(|own| is_part_unreported(own, &format!("{pattern}/*")))
        }
        _ => unreported(pattern).is_some(),
    }
}

/// Whether a value is the default of its type.
fn states_nothing(value: &Value) -> bool {
    match value {
        Value::Null | Value::Bool(false) => true,
        Value::String(text) => text.is_empty() || text == "unknown",
        Value::Array(list) => list.is_empty(),
        _ => false,
    }
}

/// Names of alternatives whose others all have a content that nothing here makes; the others become these.
const ALONE: [&str; 5] =
    ["/axes/rules/*/step", "/groups/*/kind", "/shape/bit_field/fields/*/meaning", "/request/*", "/reply/*"];

/// A description, and its representation as JSON.
struct Description {
    name: String,
    length: usize,
    catalog: Catalog,
    json: Value,
}

impl Description {
    /// As it is read from its JSON. `None` if that has no number for one of its numbers.
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

/// Inputs of the cases, the dictionaries, catalogs of any bytes, and in the full lane a part of the corpus; the smallest first.
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
    all.sort_by_key(|own| (own.length, own.name.clone()));
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

/// Bytes of a catalog.
const BYTES: usize = 1500;

/// What came of the changes of leaves.
#[derive(Default)]
struct Tally {
    /// How many leaves of each path were changed.
    paths: BTreeMap<String, usize>,
    changes: usize,
    reported: usize,
    /// Entries of the list that a leaf belongs to.
    listed: BTreeSet<&'static str>,
    /// An example of each path that is not reported.
    missed: BTreeMap<String, String>,
    /// An example of each path whose changes are none of its type. A part that cannot be missing is none of them.
    invalid: BTreeMap<String, String>,
}

impl Tally {
    /// Changes the leaves of a description, of each path at most so many in all.
    fn add(&mut self, own: &Description, most: usize, mutator: &mut Mutator) {
        assert_eq!(compare(&own.catalog, &own.catalog), [], "{} differs from itself", own.name);
        let mut json = own.json.clone();
        for leaf in Leaf::all(&own.json) {
            let count = self.paths.entry(leaf.pattern()).or_default();
            *count += 1;
            if *count <= most {
                self.leaf(own, &leaf, &mut json, mutator);
            }
        }
    }

    fn leaf(&mut self, own: &Description, leaf: &Leaf, json: &mut Value, mutator: &mut Mutator) {
        let mut is_changed = false;
        for change in mutator.mutations(leaf, json) {
            let example = format!("{} to {change} at {} of {}", leaf.value(json), leaf.pointer(), own.name);
            let before = leaf.replace(json, change);
            let changed = Catalog::deserialize(&*json);
            leaf.replace(json, before);
            if let Ok(changed) = changed {
                is_changed = true;
                // A value that the representation leaves out when it is written is equal.
                if changed != own.catalog {
                    self.compare(own, &changed, leaf, example);
                }
            }
        }
        if !is_changed && leaf.is_value(json) {
            self.invalid.insert(leaf.pattern(), format!("{} at {}", own.name, leaf.pointer()));
        }
    }

    fn compare(&mut self, own: &Description, changed: &Catalog, leaf: &Leaf, example: String) {
        let pattern = leaf.pattern();
        let is_reported = !compare(&own.catalog, changed).is_empty() && !compare(changed, &own.catalog).is_empty();
        self.changes += 1;
        self.reported += usize::from(is_reported);
        match unreported(&pattern) {
            Some(entry) => {
                assert!(!is_reported, "{example} is reported, and on the list");
                self.listed.insert(entry);
            }
            None if !is_reported && !is_unreported(leaf.value(&own.json), &pattern) => {
                self.missed.entry(pattern).or_insert(example);
            }
            None => {}
        }
    }
}

#[test]
fn a_change_of_every_leaf_is_reported() {
    let most = if lane::is_full() { 4 } else { 1 };
    let (mut tally, mut mutator) = (Tally::default(), Mutator::default());
    for own in descriptions() {
        tally.add(&own, most, &mut mutator);
    }
    let Tally { paths, changes, reported, listed, missed, invalid } = tally;
    println!("{} paths, {changes} changes, {reported} reported", paths.len());
    for (pattern, example) in &missed {
        println!("missed: {pattern}: {example}");
    }
    let invalid: Vec<_> = invalid.iter().filter(|(path, _)| !ALONE.iter().any(|end| path.ends_with(end))).collect();
    assert!(invalid.is_empty(), "no change was possible: {invalid:#?}");
    assert!(missed.is_empty(), "{} paths are missed", missed.len());
    assert_eq!(listed, UNREPORTED.iter().map(|(end, _)| *end).collect(), "the list has nothing that is not needed");
}
