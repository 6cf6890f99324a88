//! What generated code packs, it unpacks as the same, and the other way round: process data, process images, records and
//! messages of every file of the corpus and of every dictionary, on bits of any kind.
//!
//! The bindings become programs that are compiled and run; `packing/program.rs` is what such a program does with a type.

mod compile_support;
mod corpus_support;
#[path = "packing/found.rs"]
mod found;

use std::path::Path;
use std::sync::Mutex;

use found::Found;
use lexibus_codegen::compile::{check, Options};
use lexibus_codegen::source::Source;
use lexibus_codegen::{Presence, RustOptions};

/// What every program begins with.
const CHECKS: &str = include_str!("packing/program.rs");

/// Lines of bindings that one program has: more would need more memory, fewer more time.
const MAX_LINES: usize = 60_000;

fn options() -> Options {
    let rust = RustOptions { accessors: false, table: Presence::Never, ..RustOptions::default() };
    Options { rust, ..Options::default() }
}

/// A program of some bindings: the modules, and a call for each type that was found in them.
#[derive(Default)]
struct Program {
    modules: String,
    calls: String,
    lines: usize,
    names: Vec<String>,
}

impl Program {
    fn add(&mut self, name: &str, bindings: &str, found: &[Found]) {
        let module = format!("m{}", self.names.len());
        self.modules += &format!("#[allow(unused)]\nmod {module} {{\n{bindings}\n}}\n");
        for one in found {
            self.calls += &format!("    {}\n", one.call(&module, name));
        }
        self.lines += bindings.lines().count();
        self.names.push(name.to_owned());
    }

    fn run(&self) -> Result<(), String> {
        let main = format!("fn main() {{\n{}}}\n", self.calls);
        compile_support::run(&self.names.join(", "), &format!("{CHECKS}\n{}\n{main}", self.modules))
    }
}

/// Programs of all `bindings` (name and text), on all processors. Gives the number of types of each kind.
fn run_all(bindings: Vec<(String, String)>) -> found::Counts {
    let (mut programs, mut counts) = (vec![Program::default()], found::Counts::default());
    for (name, text) in &bindings {
        let found = found::all(text);
        counts.add(&found, text, name);
        if found.is_empty() {
            continue;
        }
        if programs.last().is_some_and(|program| program.lines > MAX_LINES) {
            programs.push(Program::default());
        }
        programs.last_mut().expect("a program").add(name, &found::needed(text), &found);
    }
    let failures = Mutex::new(Vec::new());
    corpus_support::bindings::on_all_processors(programs, |program| {
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
    let all = Mutex::new(Vec::new());
    corpus_support::bindings::each(files, &options(), |name, text| {
        all.lock().expect("the bindings").push((name.to_owned(), text.to_owned()));
        Ok(())
    });
    let mut bindings = all.into_inner().expect("the bindings");
    bindings.sort();
    let counts = run_all(bindings);
    eprintln!("{counts:?}");
    assert!(counts.process_data > 3_000 && counts.records > 300, "{counts:?}");
}

#[test]
fn every_layout_of_the_dictionaries() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../dictionaries");
    let mut bindings = Vec::new();
    for name in ["demo-drive.eds", "aec-vector-step.toml", "kollmorgen-akd.toml", "hsd-sm137-sm140.toml", "eco.toml"] {
        let source = Source::read(&folder.join(name)).expect("a dictionary");
        let compilation = check(source, &options());
        bindings.push((name.to_owned(), compilation.rust(&options().rust).expect("bindings")));
    }
    let counts = run_all(bindings);
    eprintln!("{counts:?}");
    assert!(counts.process_data >= 37 && counts.messages >= 41, "{counts:?}");
}
