//! Compiles arbitrary bytes as XML. The seed inputs of this target are ESI files.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| lexibus_codegen_fuzz::everything("fuzz.xml", bytes));
