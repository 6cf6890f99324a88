//! Compiles arbitrary bytes as an XDD.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| lexibus_codegen_fuzz::everything("fuzz.xdd", bytes));
