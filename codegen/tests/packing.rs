//! Tests that generated code packs and unpacks data without changing it. The tests use random bits for the process data,
//! process images, records and messages of all corpus files and dictionaries.
//!
//! The tests compile the bindings to programs and run them. `packing/program.rs` contains the checks for each kind of type. The
//! intermediate representation determines the expected bit positions (`packing/layouts.rs`) and whether requests contain a
//! device number.

mod compile_support;
mod corpus_support;
#[path = "packing/found.rs"]
mod found;
#[path = "packing/layouts.rs"]
mod layouts;
#[path = "packing/messages.rs"]
mod messages;
#[path = "packing/odd.rs"]
mod odd;
#[path = "packing/views.rs"]
mod views;

use std::collections::HashSet;
use std::path::Path;
use std::sync::Mutex;

use corpus_support::bindings::{body, catalogs, on_all_processors};
use corpus_support::lane;
use found::Counts;
use lexibus_codegen::backend::rust::emit_catalog;
use lexibus_codegen::compile::{check, Options};
use lexibus_codegen::ir::Catalog;
use lexibus_codegen::source::Source;
use lexibus_codegen::{Presence, RustOptions};

/// Source text at the start of each test program.
const CHECKS: &str = include_str!("packing/program.rs");

/// Number of lines of bindings after which a new program starts. A higher number needs more memory, and a lower number needs more
/// time.
const MAX_LINES: usize = 60_000;

fn options() -> Options {
    let rust = RustOptions { accessors: false, table: Presence::Never, ..RustOptions::default() };
    Options { rust, ..Options::default() }
}

/// Bindings, with the statements that check their types.
struct Bindings {
    name: String,
    text: String,
    checks: Vec<String>,
}

impl Bindings {
    /// Returns the bindings of a catalog, and the number of types of each kind. Returns `None` if there is nothing to generate, or
    /// if `seen` contains the same bindings with the same checks.
    fn new(name: &str, catalog: &Catalog, seen: &Mutex<HashSet<String>>) -> Option<(Self, Counts)> {
        let text = emit_catalog(catalog, &options().rust)?;
        let (checks, counts) = found::checks(name, &text, catalog);
        // For equal bindings, the checks depend only on the IR. If different IRs wrongly gave equal bindings, their checks would
        // differ, and both would run.
        let key = body(&text).to_owned() + &checks.concat().replace(name, "");
        let is_new = seen.lock().expect("the seen keys").insert(key);
        is_new.then(|| (Bindings { name: name.to_owned(), checks, text: found::needed(&text) }, counts))
    }
}

/// A program that checks several bindings. The program contains the modules of these bindings and a function for each
/// type.
#[derive(Default)]
struct Program {
    text: String,
    calls: String,
    lines: usize,
    names: Vec<String>,
}

impl Program {
    fn add(&mut self, bindings: &Bindings) {
        let module = format!("m{}", self.names.len());
        self.text += &format!("#[allow(unused)]\nmod {module} {{\n{}\n}}\n", bindings.text);
        for (at, statements) in bindings.checks.iter().enumerate() {
            let statements = statements.replace("MODULE::", &format!("{module}::"));
            self.text += &format!("fn {module}_{at}() {{\n    {statements}\n}}\n");
            self.calls += &format!("    {module}_{at}();\n");
        }
        self.lines += bindings.text.lines().count();
        self.names.push(bindings.name.clone());
    }

    fn run(&self) -> Result<(), String> {
        let main = format!("fn main() {{\n{}}}\n", self.calls);
        compile_support::run(&self.names.join(", "), &format!("{CHECKS}\n{}\n{main}", self.text))
    }
}

/// Checks all bindings in `sources`, using all processors. Returns the number of types of each kind.
fn run_all(sources: Vec<Source>) -> Counts {
    let (all, seen) = (Mutex::new(Vec::new()), Mutex::default());
    on_all_processors(sources, |source| {
        let name = source.name().to_owned();
        let compilation = check(source, &options());
        let actual = catalogs(&compilation).filter_map(|catalog| Bindings::new(&name, &catalog, &seen));
        let checks: Vec<_> = actual.filter(|(bindings, _)| !bindings.checks.is_empty()).collect();
        all.lock().expect("the bindings").extend(checks);
    });
    run(all.into_inner().expect("the bindings"))
}

/// Runs programs that check all bindings. Returns the number of types of each kind.
fn run(mut all: Vec<(Bindings, Counts)>) -> Counts {
    all.sort_by(|(one, _), (other, _)| (&one.name, &one.text).cmp(&(&other.name, &other.text)));
    let (mut programs, mut counts) = (vec![Program::default()], Counts::default());
    for (entry, of_bindings) in &all {
        if programs.last().is_some_and(|program| program.lines > MAX_LINES) {
            programs.push(Program::default());
        }
        programs.last_mut().expect("a program").add(entry);
        counts.add(of_bindings);
    }
    let failures = Mutex::new(Vec::new());
    on_all_processors(programs, |program| {
        let outcome = program.run();
        failures.lock().expect("the failures").extend(outcome.err());
    });
    let failures = failures.into_inner().expect("the failures");
    assert!(failures.is_empty(), "{}", failures.join("\n\n"));
    counts
}

#[test]
fn every_layout_of_the_corpus() {
    let Some(files) = corpus_support::all_files() else { return };
    let counts = run_all(files.into_iter().map(|file| Source::new(file.name.as_str(), file.bytes)).collect());
    eprintln!("{counts:?}");
    let has = |found: usize, full| found > lane::at_least(full);
    assert!(has(counts.process_data, 3_000) && has(counts.records, 300) && has(counts.views, 2_500), "{counts:?}");
}

#[test]
fn every_layout_of_the_dictionaries() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../dictionaries");
    let names = ["demo-drive.eds", "aec-vector-step.toml", "kollmorgen-akd.toml", "hsd-sm137-sm140.toml", "eco.toml"];
    let sources = names.map(|name| Source::read(&folder.join(name)).expect("a dictionary"));
    let counts = run_all(sources.into());
    eprintln!("{counts:?}");
    assert!(counts.process_data >= 37 && counts.messages >= 41 && counts.views >= 33, "{counts:?}");
}

#[test]
fn layouts_that_no_shared_file_has() {
    let bindings = Bindings::new("odd", &odd::catalog(), &Mutex::default());
    let counts = run(bindings.into_iter().collect());
    assert_eq!((counts.process_data, counts.views), (10, 10), "four PDOs and an image in each direction: {counts:?}");
}
