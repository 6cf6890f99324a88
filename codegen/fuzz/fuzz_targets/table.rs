//! Compiles any bytes as TOML. The seeds of this target are register tables.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| lexibus_codegen_fuzz::everything("fuzz.toml", bytes));
