//! Compiles arbitrary bytes as TOML. The seed inputs of this target are register tables.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| lexibus_codegen_fuzz::everything("fuzz.toml", bytes));
