//! Creates IR from arbitrary bytes. Creating any output must not panic, and the Rust code generated from IR without
//! errors must be syntactically valid.
#![no_main]

use lexibus_codegen::compile::Options;
use lexibus_codegen::RustOptions;

#[allow(dead_code)]
#[path = "../../../tests/support/arbitrary_ir/mod.rs"]
mod arbitrary_ir;
#[allow(dead_code)]
#[path = "../../../cli/tests/arbitrary/outputs.rs"]
mod outputs;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    let compilation = arbitrary_ir::compilation(bytes, &Options::default());
    outputs::others(&compilation);
    if let Some(text) = compilation.rust(&RustOptions::default()) {
        if let Err(error) = syn::parse_file(&text) {
            panic!("{error}\n{text}");
        }
    }
});
