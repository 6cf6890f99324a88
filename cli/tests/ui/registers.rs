//! Checks the test cases as a whole: each code and each quirk must have a case, and the generated code must compile.

use std::collections::BTreeSet;
use std::path::Path;

use lexibus_codegen::check::LINTS;
use lexibus_codegen::compile::{check, Options};
use lexibus_codegen::diagnostics::codes::CODES;
use lexibus_codegen::diagnostics::{Diagnostics, Level, Levels};
use lexibus_codegen::source::Source;
use lexibus_codegen::{Presence, RustOptions};
use libtest_mimic::{Failed, Trial};

use crate::case::{ending, Case};
use crate::compile_support::compile_modules;

/// Codes that no test case can cause. IO001 reports an unreadable file, and a test of the command line covers it.
const WITHOUT_INPUT: [&str; 1] = ["IO001"];

/// Each diagnostic code must have a test case that is named after the code and reports it.
pub fn every_code_has_a_case(cases: &[Case]) -> Trial {
    let cases: Vec<(String, String)> =
        cases.iter().map(|case| (case.folder_name(), case.expected_diagnostics())).collect();
    Trial::test("every code has a case", move || {
        let is_shown = |id: &str, name: &str| {
            let folder = format!("{}-{name}", id.to_lowercase());
            cases.iter().any(|(name, diagnostics)| *name == folder && diagnostics.contains(&format!("[{id}]")))
        };
        let missing = CODES.iter().filter(|code| !is_shown(code.id, code.name)).map(|code| code.id);
        let missing: Vec<&str> = missing.filter(|id| !WITHOUT_INPUT.contains(id)).collect();
        none_missing("a case `<code>-<name>` whose `diagnostics` have the code", &missing)
    })
}

/// `lexibus explain` and the catalog must show the shortest diagnostic from the test case of each code.
pub fn examples_are_those_of_the_cases(cases: &[Case], bless: bool) -> Trial {
    let cases: Vec<(String, String)> =
        cases.iter().map(|case| (case.folder_name(), case.expected_diagnostics())).collect();
    Trial::test("examples of codes", move || {
        let example = |id: &str, name: &str| {
            let folder = format!("{}-{name}", id.to_lowercase());
            let (_, diagnostics) = cases.iter().find(|(case, _)| *case == folder)?;
            let shown = diagnostics.split("\n\n").map(str::trim_end);
            let shown = shown.filter(|text| text.lines().next().is_some_and(|line| line.contains(&format!("[{id}]"))));
            shown.min_by_key(|text| (text.lines().count(), text.len())).map(|text| format!("=== {id}\n{text}\n\n"))
        };
        let examples: String = CODES.iter().filter_map(|code| example(code.id, code.name)).collect();
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/explain/examples.txt");
        if bless {
            return Ok(std::fs::write(path, examples)?);
        }
        let is_same = std::fs::read_to_string(path)? == examples;
        is_same.then_some(()).ok_or_else(|| "cli/src/explain/examples.txt is stale: bless it like a case".into())
    })
}

/// Each row of `QUIRKS.md` must have a test case whose name starts with the identifier of the row.
pub fn every_quirk_has_a_case(cases: &[Case]) -> Trial {
    let names: Vec<String> = cases.iter().map(Case::folder_name).collect();
    Trial::test("every quirk has a case", move || {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../shared/QUIRKS.md");
        let Ok(text) = std::fs::read_to_string(&path) else {
            eprintln!("skipped: there is no list of quirks at {}", path.display());
            return Ok(());
        };
        let rows: Vec<&str> = text.lines().filter_map(row).collect();
        assert!(rows.len() > 100, "the list has only {} rows", rows.len());
        let is_shown = |row: &str| {
            let row = row.to_lowercase();
            names.iter().any(|name| name.strip_prefix(&row).is_some_and(|rest| rest.starts_with('-')))
        };
        let missing: Vec<&str> = rows.into_iter().filter(|row| !is_shown(row)).collect();
        none_missing("a case `<row>-…`", &missing)
    })
}

/// Returns the identifier of a table row, such as `E01` in `| E01 | …`.
fn row(line: &str) -> Option<&str> {
    let row = line.strip_prefix("| ")?.split(' ').next()?;
    let digits = row.strip_prefix(['E', 'X', 'G'])?;
    (digits.len() == 2 && digits.bytes().all(|digit| digit.is_ascii_digit())).then_some(row)
}

fn none_missing(what: &str, missing: &[&str]) -> Result<(), Failed> {
    if missing.is_empty() {
        return Ok(());
    }
    Err(format!("{what} is missing for {}", missing.join(", ")).into())
}

/// Number of inputs that are compiled as one crate. Compiling more crates would take longer, and compiling a single crate
/// would need too deep a stack.
const INPUTS: usize = 50;

/// The Rust code of all inputs without errors must compile without warnings. Each crate with up to 50 inputs is a
/// separate trial.
pub fn rust_of_all_cases_compiles(cases: &[&Case]) -> Vec<Trial> {
    let mut inputs = Vec::new();
    for case in cases {
        let rust = RustOptions { table: Presence::Always, ..RustOptions::default() };
        let options = Options { rust, ..case.options() };
        let name = case.name().replace(|letter: char| !letter.is_ascii_alphanumeric(), "_");
        let described = case.inputs().into_iter().filter(|input| ending(input.name()) != "csv").enumerate();
        inputs.extend(described.map(|(number, input)| (format!("{name}_{number}"), input, options.clone())));
    }
    let trial = |(number, inputs): (usize, &[(String, Source, Options)])| {
        let inputs = inputs.to_vec();
        Trial::test(format!("rust of all cases compiles, part {number}"), move || {
            let rust = |(name, input, options): (String, Source, Options)| {
                let text = check(input, &options).rust(&options.rust)?;
                Some((name, text))
            };
            let modules: Vec<(String, String)> = inputs.into_iter().filter_map(rust).collect();
            assert!(!modules.is_empty(), "no case generates Rust");
            compile_modules(&modules).map_err(Failed::from)
        })
    };
    inputs.chunks(INPUTS).enumerate().map(trial).collect()
}

/// Each lint must report a diagnostic in at least one test case, and may only report codes that it declares.
pub fn lints_declare_their_codes(cases: &[&Case]) -> Trial {
    let mut levels = Levels::lenient();
    CODES.iter().for_each(|code| levels.set(code.id, Level::Warn).expect("a code"));
    let of = |case: &&Case| -> Vec<(Source, Options)> {
        let options = Options { levels: levels.clone(), no_profiles: true, ..case.options() };
        let described = case.inputs().into_iter().filter(|input| ending(input.name()) != "csv");
        described.map(|input| (input, options.clone())).collect()
    };
    let inputs: Vec<(Source, Options)> = cases.iter().flat_map(of).collect();
    Trial::test("every lint declares its codes", move || {
        let mut reported: BTreeSet<(&str, &str)> = BTreeSet::new();
        for (source, options) in &inputs {
            let Some(catalog) = check(source.clone(), options).catalog else { continue };
            for lint in LINTS {
                let mut diagnostics = Diagnostics::new(options.levels.clone());
                lint.check(&catalog, &mut diagnostics);
                reported.extend(diagnostics.list().iter().map(|found| (lint.name, found.code.id)));
            }
        }
        let declared = LINTS.iter().flat_map(|lint| lint.codes.iter().map(|code| (lint.name, code.id)));
        let declared: BTreeSet<(&str, &str)> = declared.collect();
        let unknown: Vec<_> = declared.iter().filter(|(_, id)| CODES.iter().all(|code| code.id != *id)).collect();
        let undeclared: Vec<_> = reported.difference(&declared).collect();
        let silent = LINTS.iter().map(|lint| lint.name).filter(|name| reported.iter().all(|(lint, _)| lint != name));
        let silent: Vec<&str> = silent.collect();
        if unknown.is_empty() && undeclared.is_empty() && silent.is_empty() {
            return Ok(());
        }
        Err(format!("not in the catalog: {unknown:?}; not declared: {undeclared:?}; no case: {silent:?}").into())
    })
}
