//! The generated Rust has the form that `prettyplease` would give it, for every file of the corpus.

mod corpus_support;

use std::path::Path;

use corpus_support::lane;
use lexibus_codegen::compile::{check, Options};
use lexibus_codegen::source::Source;
use lexibus_codegen::Presence;

/// `prettyplease` drops comments that are no documentation: the header is all that we have of them.
fn without_header(text: &str) -> String {
    text.lines()
        .skip_while(|line| line.starts_with("//"))
        .skip_while(|line| line.is_empty())
        .map(|line| format!("{line}\n"))
        .collect()
}

/// The first line that isn't as `prettyplease` prints it.
fn canonical(name: &str, text: &str) -> Result<(), String> {
    let text = without_header(text);
    let parsed = syn::parse_file(&text).map_err(|error| format!("{name}: {error}"))?;
    let expected = prettyplease::unparse(&parsed);
    for (line, (ours, theirs)) in text.lines().zip(expected.lines()).enumerate() {
        if ours != theirs {
            return Err(format!("{name}, line {}:\n    {ours}\n    {theirs}", line + 1));
        }
    }
    (text.len() == expected.len()).then_some(()).ok_or_else(|| format!("{name}: not of the same length"))
}

#[test]
fn output_is_as_prettyplease_prints_it() {
    let Some(mut files) = corpus_support::all_files() else { return };
    // Parsing is slow in a build for tests.
    files.retain(|file| lane::is_full() || file.bytes.len() < 60_000);
    let mut options = Options::default();
    options.rust.table = Presence::Feature("table".into());
    let compared = corpus_support::bindings::each(files, &options, canonical);
    assert!(compared > lane::at_least(500), "only {compared} different devices");
}

/// Several devices and modules of one file are modules of one another; a register table has what no file of the corpus has.
#[test]
fn nested_modules_and_tables_are_as_prettyplease_prints_them() {
    let coupler = concat!(env!("CARGO_MANIFEST_DIR"), "/../tests/data/coupler.esi.xml");
    let gateway = concat!(env!("CARGO_MANIFEST_DIR"), "/../tests/data/gateway.esi.xml");
    let press = concat!(env!("CARGO_MANIFEST_DIR"), "/../tests/data/press.toml");
    for path in [coupler, gateway, press] {
        let compilation = check(Source::read(Path::new(path)).expect("the example"), &Options::default());
        let text = compilation.rust(&Options::default().rust).expect("bindings");
        assert_eq!(canonical(path, &text), Ok(()));
    }
}
