//! Imports arbitrary bytes as a register list and compiles the resulting table.
#![no_main]

use lexibus_codegen::source::Source;
use lexibus_import::{import, Options};

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    let made = import(Source::new("fuzz.csv", bytes.to_vec()), &Options::default());
    if let Some(table) = made.table {
        lexibus_codegen_fuzz::everything("fuzz.toml", table.as_bytes());
    }
});
