//! Tests that diagnostic levels change only which diagnostics are reported, not how the input is read.

use std::path::Path;

use lexibus_codegen::compile::{check, Options};
use lexibus_codegen::diagnostics::codes::CODES;
use lexibus_codegen::diagnostics::Level;
use lexibus_codegen::source::Source;

#[test]
fn a_lint_does_not_change_what_is_read() {
    let mut every_lint = Options::default();
    for code in CODES {
        every_lint.levels.set(code.id, Level::Warn).unwrap();
    }
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../tests/ui/codes-eds/eds062-missing-entry");
    for name in ["complete.dcf", "missing.dcf"] {
        let source = || Source::new(name, std::fs::read(folder.join(name)).expect("an input of the case"));
        let default = check(source(), &Options::default());
        let linted = check(source(), &every_lint);
        assert!(default.catalog.is_some(), "{name}");
        assert_eq!(default.catalog, linted.catalog, "{name}");
    }
}
