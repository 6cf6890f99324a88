//! Runs the test cases in `tests/ui`. The folder of a case contains its input, expected diagnostics and expected
//! output.
//!
//!     cargo test -p lexibus-cli --test ui                       # all cases
//!     cargo test -p lexibus-cli --test ui e02                   # those with `e02` in their name
//!     LEXIBUS_BLESS=1 cargo test -p lexibus-cli --test ui e02   # writes the expected files; read the difference
//!
//! `tests/ui/README.md` describes the files of a test case.

mod case;
#[path = "../../../codegen/tests/compile_support/mod.rs"]
mod compile_support;
mod console;
#[path = "../../../codegen/tests/corpus_support/mod.rs"]
mod corpus_support;
mod forms;
mod outputs;
mod part;
mod registers;

use std::path::{Path, PathBuf};

use case::Case;
use corpus_support::fixes;
use libtest_mimic::{Arguments, Failed, Trial};

fn main() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../tests/ui");
    let bless = std::env::var_os("LEXIBUS_BLESS").is_some();
    assert!(!(bless && std::env::var_os("CI").is_some()), "CI compares expected files and never writes them");
    let cases: Vec<Case> = folders(&root).iter().flat_map(|area| folders(area)).map(Case::open).collect();
    assert!(!cases.is_empty(), "no case is in {}", root.display());

    let described: Vec<&Case> = cases.iter().filter(|case| !case.settings.network).collect();
    let mut trials = registers::rust_of_all_cases_compiles(&described);
    trials.push(registers::every_code_has_a_case(&cases));
    trials.push(registers::examples_are_those_of_the_cases(&cases, bless));
    trials.push(registers::every_quirk_has_a_case(&cases));
    trials.push(registers::lints_declare_their_codes(&described));
    trials.extend(cases.into_iter().map(|case| Trial::test(case.name(), move || run(&case, bless))));
    libtest_mimic::run(&Arguments::from_args(), trials).exit();
}

fn run(case: &Case, bless: bool) -> Result<(), Failed> {
    let actual = outputs::of(case)?;
    if bless {
        case.write_expected(&actual)?;
    } else {
        case.compare(&actual)?;
    }
    if case.settings.network {
        return Ok(());
    }
    fixes_hold(case)?;
    forms::all_say_the_same(case).map_err(Failed::from)
}

/// Checks that each suggested fix removes its diagnostic and causes no others. At most two fixes are tested per code.
fn fixes_hold(case: &Case) -> Result<(), String> {
    let options = case.options();
    for input in case.inputs() {
        let (name, text) = (input.name().to_owned(), input.text().to_owned());
        fixes::all_hold(&text, &options, 2, |text| case.source_of(&name, text.into_bytes()))
            .map_err(|message| format!("{name}: {message}"))?;
    }
    Ok(())
}

/// Returns the subfolders of `folder`, sorted by name.
fn folders(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
    let mut paths: Vec<PathBuf> = entries.map(|entry| entry.expect("a folder entry").path()).collect();
    paths.retain(|path| path.is_dir());
    paths.sort();
    paths
}
