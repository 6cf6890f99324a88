//! Measures how fast Lexibus and other generators write Rust code.

use device_driver_core::{CodegenTarget, CompileOptions, GeneralOptions, MirOptions};
use lexibus_codegen::backend::rust;
use lexibus_codegen::RustOptions;
use svd2rust::{Config, Target};

use crate::input::{growing, InputFormat};
use crate::measure::{in_turns, Contestant};
use crate::read::check;
use crate::registers::{registers, Registers};
use crate::report::{Line, Table};

pub const REGISTERS: usize = 1_000;

/// Measures code generation and returns the tables of results.
pub fn compare() -> Vec<Table> {
    vec![generators(), alone()]
}

/// Measures how long each generator needs to convert the bytes of a description to Rust text.
fn generators() -> Table {
    let input = registers(REGISTERS);
    let mut contestants = [
        Contestant::new("Lexibus", || (), |()| lexibus(&input)),
        Contestant::new("svd2rust 0.37, not formatted", || (), |()| svd2rust(&input)),
        Contestant::new("svd2rust 0.37 and prettyplease", || (), |()| formatted(&svd2rust(&input)?)),
        Contestant::new("device-driver 2.2", || (), |()| device_driver(&input)),
    ];
    let outcomes = in_turns(&mut contestants);
    let targets = [None, Some(10.0), Some(10.0), Some(10.0)];
    let lines = contestants.iter().zip(outcomes).zip(targets);
    let lines = lines.map(|((one, outcome), target)| Line { name: one.name.clone(), outcome, target }).collect();
    Table { title: format!("Generation: {REGISTERS} registers of 6 fields, bytes to Rust"), bytes: None, lines }
}

/// Measures how long Lexibus needs to convert the IR of an EDS with 9,990 entries to Rust text.
fn alone() -> Table {
    // The EDS has 1,110 records with nine entries each.
    let bytes = growing(InputFormat::Eds, 111);
    let compilation = check("bench.eds".to_owned(), bytes);
    let catalog = compilation.catalog.as_ref().expect("a catalog");
    let options = RustOptions::default();
    let emit = |()| Ok(rust::emit(&catalog.devices[0], &catalog.files[0], &options));
    let outcome = in_turns(&mut [Contestant::new("Lexibus", || (), emit)]).remove(0);
    let line = Line { name: "Lexibus (at most 200 ms)".to_owned(), outcome, target: None };
    Table { title: "Generation: checked IR of 9,990 entries to Rust".to_owned(), bytes: None, lines: vec![line] }
}

pub fn lexibus(input: &Registers) -> Result<String, String> {
    let compilation = check("bench.toml".to_owned(), input.table.clone().into_bytes());
    compilation.rust(&RustOptions::default()).ok_or_else(|| "nothing was generated".to_owned())
}

pub fn svd2rust(input: &Registers) -> Result<String, String> {
    let mut config = Config::default();
    config.target = Target::None;
    svd2rust::generate(&input.svd, &config).map(|made| made.lib_rs).map_err(|error| format!("{error:#}"))
}

/// Formats Rust code with `prettyplease`, because svd2rust does not format its output. Returns an error if the code
/// cannot be parsed.
pub fn formatted(code: &str) -> Result<String, String> {
    syn::parse_file(code).map(|file| prettyplease::unparse(&file)).map_err(|error| error.to_string())
}

pub fn device_driver(input: &Registers) -> Result<String, String> {
    let options = CompileOptions {
        general_options: GeneralOptions::default(),
        mir_options: MirOptions::default(),
        target: CodegenTarget::Rust(Default::default()),
    };
    let (code, diagnostics) =
        device_driver_core::compile(&input.ddsl, options).map_err(|error| error.to_report_string())?;
    match diagnostics.has_error() {
        true => Err("it has errors".to_owned()),
        false => Ok(code),
    }
}
