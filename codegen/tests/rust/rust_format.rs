//! Tests that the Rust code for all corpus files has the format of `prettyplease`.

use crate::corpus_support;
use crate::form_support;

use std::path::Path;

use corpus_support::lane;
use form_support::canonical;
use lexibus_codegen::compile::{check, Options};
use lexibus_codegen::source::Source;
use lexibus_codegen::Presence;

#[test]
fn output_is_as_prettyplease_prints_it() {
    let Some(mut files) = corpus_support::all_files() else { return };
    // Skip long files, because parsing is slow in a debug build.
    files.retain(|file| lane::is_full() || file.bytes.len() < 60_000);
    let mut options = Options::default();
    options.rust.table = Presence::Feature("table".into());
    let compared = corpus_support::bindings::each(files, &options, canonical);
    assert!(compared > lane::at_least(500), "only {compared} different devices");
}

/// Tests files with several devices and modules, which become nested modules, and a register table with features that
/// no corpus file has.
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
