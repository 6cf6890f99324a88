//! Compares Lexibus with alternatives in one run. `benches/README.md` describes the method and the results.

mod compile;
mod generate;
mod growth;
mod input;
mod lexer;
mod measure;
mod memory;
mod python;
mod read;
mod registers;
mod report;

use std::cell::RefCell;
use std::path::{Path, PathBuf};

use report::Table;
use serde_json::{json, Value};

const USAGE: &str = "usage: lexibus-peers [read] [generate] [compile] [growth] [--json] [FILE...]

Without a stage, all of them. With files, these are read instead of the inputs that are made.";

const STAGES: [&str; 4] = ["read", "generate", "compile", "growth"];

/// Command-line arguments.
#[derive(Default)]
struct Arguments {
    stages: Vec<String>,
    files: Vec<PathBuf>,
    json: bool,
}

impl Arguments {
    fn parse() -> Option<Self> {
        let mut arguments = Arguments::default();
        for argument in std::env::args().skip(1) {
            match argument.as_str() {
                "--json" => arguments.json = true,
                stage if STAGES.contains(&stage) => arguments.stages.push(argument),
                option if option.starts_with('-') => return None,
                _ => arguments.files.push(argument.into()),
            }
        }
        if arguments.stages.is_empty() {
            let stages = if arguments.files.is_empty() { &STAGES[..] } else { &STAGES[..1] };
            arguments.stages = stages.iter().map(|stage| (*stage).to_owned()).collect();
        }
        Some(arguments)
    }

    fn has(&self, stage: &str) -> bool {
        self.stages.iter().any(|wanted| wanted == stage)
    }
}

fn main() {
    let Some(arguments) = Arguments::parse() else {
        eprintln!("{USAGE}");
        std::process::exit(2);
    };
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("target/inputs");
    std::fs::create_dir_all(&folder).expect("a folder for inputs");
    let mut tables = Tables { json: arguments.json, made: Vec::new() };
    if arguments.has("read") {
        read(&arguments.files, &folder, &mut tables);
    }
    if arguments.has("generate") {
        generate::compare().into_iter().for_each(|table| tables.add(&table));
    }
    if arguments.has("compile") {
        tables.add(&compile::compare(&folder));
    }
    let growth = if arguments.has("growth") { growth::report(!arguments.json) } else { Vec::new() };
    if arguments.json {
        println!("{:#}", json!({ "tables": tables.made, "growth": growth }));
    }
}

fn read(files: &[PathBuf], folder: &Path, tables: &mut Tables) {
    let inputs = match files {
        [] => input::of_three_sizes(folder),
        files => files.iter().filter_map(|path| input::Input::of_file(path)).collect(),
    };
    let python = RefCell::new(python::Python::start());
    for input in &inputs {
        tables.add(&read::compare(input, &python));
    }
}

/// Prints tables immediately or collects them, depending on the output format.
struct Tables {
    json: bool,
    made: Vec<Value>,
}

impl Tables {
    fn add(&mut self, table: &Table) {
        match self.json {
            true => self.made.push(table.json()),
            false => table.print(),
        }
    }
}
